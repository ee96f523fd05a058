"""design, extract, profiles, doctor and the virtual camera, each by what it prints and how it ends."""

import importlib
import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import jsonschema
import numpy as np
import pytest

from aadm_workbench.design import read
from aadm_workbench.design.model_design import ModelDesign, NotTaken
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.errors import PACKAGES
from aadm_workbench.extract import method
from aadm_workbench.model import AssemblyPoint, Extraction, Kind, Plane, Scan
from aadm_workbench.report.json import report_schema
from aadm_workbench.scan.write import write_depth_tiff, write_ply
from batch.main import main

Output = pytest.CaptureFixture[str]

T_MODEL_COLUMN = np.array([[0.0, -1.0, 0.0, 1000.0], [1.0, 0.0, 0.0, 2000.0], [0.0, 0.0, 1.0, 7200.0], [0, 0, 0, 1.0]])


def printed_json(capsys: Output) -> Any:
    """What a command printed, and that it said nothing else there."""
    return json.loads(capsys.readouterr().out)


@pytest.fixture
def model(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """Stands in for a model of one column turned by 90 degrees, and one sleeve that belongs to none."""
    table = {"centres": [[-90, -90], [90, -90], [90, 90]], "sleeve_diameter": 26.0, "rebar_diameter": 18.0}
    column = replace(
        inline_design("C-301", table),
        names=("C-301", "柱"),
        T_model_column=T_MODEL_COLUMN,
        storey="3F",
        warnings=("w1",),
    )
    up = np.array([0.0, 0.0, 1.0])
    loose = AssemblyPoint("", Kind.SLEEVE, np.array([1.0, 2.0, 3.0]), up, 36.0, global_id="L" * 22, why="a name")
    left = NotTaken("rebar", "IfcReinforcingBar", "N" * 22, "[bar]", "is a stirrup")
    calls: list[dict[str, Any]] = []

    def read_model(path: Path, **selectors: str | None) -> ModelDesign:
        calls.append(selectors)
        columns = () if selectors["columns"] == "IfcWall" else (column,)
        return ModelDesign(str(path), "f" * 64, "IFC4", columns, (loose,), (), ("w0",), (left,), "3 IfcWall")

    monkeypatch.setattr(read, "read_model", read_model)
    return calls


@pytest.mark.usefixtures("model")
def test_design_in_the_frame_of_the_model(capsys: Output) -> None:
    assert main(["design", "m.ifc", "--json"]) == 0
    document = printed_json(capsys)
    (column,) = document["columns"]
    assert (column["id"], column["storey"], column["warnings"]) == ("C-301", "3F", ["w1"])
    assert [point["label"] for point in column["sleeves"]] == ["S1", "S2", "S3"]
    # The centroid of the centres is the origin: S1 stands at (-120, -60).
    assert column["sleeves"][0] == {
        "label": "S1",
        "global_id": None,
        "centre_mm": [1060.0, 1880.0, 7200.0],
        "axis": [0.0, 0.0, 1.0],
        "diameter_mm": 26.0,
        "length_mm": None,
    }
    assert document["loose"]["sleeves"][0]["centre_mm"] == [1.0, 2.0, 3.0]
    assert document["loose"]["rebars"] == []
    assert "not_taken" not in document


@pytest.mark.usefixtures("model")
def test_design_says_why(capsys: Output) -> None:
    assert main(["design", "m.ifc", "--json", "--why"]) == 0
    document = printed_json(capsys)
    assert document["loose"]["sleeves"][0]["why"] == "a name"
    assert document["not_taken"][0]["reason"] == "is a stirrup"
    assert main(["design", "m.ifc", "--why"]) == 0
    captured = capsys.readouterr()
    assert "[bar]  is a stirrup" in captured.out
    assert "the job's text" in captured.out
    assert captured.err.splitlines() == ["warning: w0", "warning: w1"]


def test_design_of_one_column(model: list[dict[str, Any]], capsys: Output) -> None:
    assert main(["design", "m.ifc", "--column", "柱"]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("C-301: 3F\nPoint ")
    assert printed.endswith("1 column, 6 sleeves and rebars in m.ifc\n")
    assert "Loose" not in printed
    assert main(["design", "m.ifc", "--column", "C-302"]) == 2
    assert "has no column called 'C-302'" in capsys.readouterr().err
    assert main(["design", "m.ifc", "--column", "IfcWall", "--sleeves", "IfcPipe"]) == 11
    assert model[-1] == {"columns": "IfcWall", "sleeves": "IfcPipe", "rebars": None, "units": "mm", "only": None}
    assert "no column with grouting sleeves in its foot; it holds 3 IfcWall" in capsys.readouterr().err


def test_why_of_one_column_tells_of_that_alone(monkeypatch: pytest.MonkeyPatch, capsys: Output) -> None:
    """What lies under another column, another column itself, and the sleeves of none are not its own."""
    table = {"centres": [[-90, -90], [90, -90], [90, 90]], "sleeve_diameter": 26.0, "rebar_diameter": 18.0}
    column = replace(inline_design("C-301", table), T_model_column=T_MODEL_COLUMN)
    left = [
        NotTaken("rebar", "IfcReinforcingBar", name * 22, name, f"{name} is a stirrup", np.array(point))
        for name, point in (("near", [*T_MODEL_COLUMN[:3, 3]]), ("far", [90_000.0, 0.0, 0.0]))
    ]
    left.append(NotTaken("column", "IfcColumn", "C" * 22, "C-302", "C-302 has no sleeves"))
    model = ModelDesign("m.ifc", "f" * 64, "IFC4", (column,), (), (), (), tuple(left), "")
    monkeypatch.setattr(read, "read_model", lambda path, **selectors: model)
    assert main(["design", "m.ifc", "--column", "C-301", "--why"]) == 0
    printed = capsys.readouterr().out
    assert "near is a stirrup" in printed
    assert "far is a stirrup" not in printed
    assert "C-302" not in printed
    assert main(["design", "m.ifc", "--why"]) == 0
    printed = capsys.readouterr().out
    assert "far is a stirrup" in printed
    assert "C-302 has no sleeves" in printed


def test_design_of_no_model(tmp_path: Path, capsys: Output) -> None:
    (tmp_path / "m.doc").touch()
    assert main(["design", str(tmp_path / "m.doc")]) == 2
    assert capsys.readouterr().err.startswith(
        f"aadm: {tmp_path / 'm.doc'}: models of the format .doc are not supported"
    )


@pytest.fixture
def scan(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A cloud in which two sleeves are found."""
    write_ply(tmp_path / "foot.ply", np.random.default_rng(1).uniform(-150.0, 150.0, (600, 3)))
    up = np.array([0.0, 0.0, 1.0])

    def extract(cloud: Scan, kind: Kind, diameter_mm: float, name: str, rng: np.random.Generator) -> Extraction:
        points = tuple(
            AssemblyPoint("", kind, np.array([x, 0.0, -0.0]), up, diameter_mm, covariance, why=name)
            for x, covariance in ((1 / 3, np.diag([0.03**2, 0.04**2, 9.0])), (90.0, None))
        )
        return Extraction(kind, name, points, Plane(up, 0.0, 0.02), up, "foot face", quality={"nothing": np.nan})

    monkeypatch.setattr(method, "extract", extract)
    return str(tmp_path / "foot.ply")


def test_extract(scan: str, capsys: Output) -> None:
    words = ["extract", scan, "--kind", "sleeve", "--diameter", "26"]
    assert main([*words, "--json", "--method", "fusion"]) == 0
    document = printed_json(capsys)
    assert (document["kind"], document["method"], document["found"], document["expected"]) == (
        "sleeve",
        "fusion",
        2,
        None,
    )
    first, second = document["points"]
    assert first == {
        "centre_mm": [0.3333, 0.0, 0.0],
        "scan_mm": [0.3333, 0.0, 0.0],
        "axis": [0.0, 0.0, 1.0],
        "diameter_mm": 26.0,
        # Only what lies across the vertical counts: the root of the mean of 0.03² and 0.04².
        "u_mm": 0.0354,
        "evidence": "fusion",
    }
    assert second["u_mm"] is None
    assert document["plane"] == {"normal": [0.0, 0.0, 1.0], "offset_mm": 0.0, "residual_mm": 0.02}
    assert main([*words, "--expected", "2"]) == 0
    assert "2 sleeves of 2 expected in " in capsys.readouterr().out
    assert main([*words, "--expected", "3", "--quiet"]) == 11
    assert capsys.readouterr().out == ""


def test_extract_from_no_scan(scan: str, tmp_path: Path, capsys: Output) -> None:
    words = ["--kind", "rebar", "--diameter", "18"]
    assert main(["extract", str(tmp_path / "nowhere.ply"), *words]) == 2
    assert main(["extract", scan, *words, "--units", "m"]) == 2
    assert 'write units = "mm"' in capsys.readouterr().err
    assert main(["extract", scan, *words, "--camera", str(tmp_path / "nowhere.toml")]) == 2


def test_extract_takes_the_step_of_a_depth_map_from_the_file_of_the_camera(
    scan: str, tmp_path: Path, capsys: Output
) -> None:
    depth_mm = np.add.outer(np.arange(240.0), np.arange(320.0)) / 10 + 800
    write_depth_tiff(tmp_path / "depth.tiff", depth_mm, 0.02)
    camera = "fx = 600.0\nfy = 600.0\ncx = 160.0\ncy = 120.0\nwidth = 320\nheight = 240\n"
    (tmp_path / "camera.toml").write_text(f"[camera]\n{camera}# depth_scale_mm = 5.0\n")
    words = ["extract", str(tmp_path / "depth.tiff"), "--kind", "sleeve", "--diameter", "26", "--camera"]
    assert main([*words, str(tmp_path / "camera.toml")]) == 2
    assert "add depth_scale_mm" in capsys.readouterr().err
    (tmp_path / "job.toml").write_text(f'units = "mm"\n[camera]\n{camera}depth_scale_mm = 0.02\n')
    assert main([*words, str(tmp_path / "job.toml")]) == 0


def test_profiles(capsys: Output) -> None:
    assert main(["profiles", "--json"]) == 0
    named = {profile["name"]: profile for profile in printed_json(capsys)["profiles"]}
    assert {rule["upper_mm"] for rule in named["cn"]["rules"] if rule["limits"] == "sleeve_rebar_distance"} == {3.0}
    assert main(["profiles"]) == 0
    assert "cn-jgj1-2014" in capsys.readouterr().out
    assert main(["profiles", "cn"]) == 0
    printed = capsys.readouterr().out
    assert "-2 … +2" in printed
    assert "unverified" in printed
    assert main(["profiles", "din"]) == 2
    assert "Unknown tolerance profile 'din'" in capsys.readouterr().err


def test_doctor(capsys: Output, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("aadm_workbench.errors.PACKAGES", tuple(package for package in PACKAGES if not package.extra))
    assert main(["doctor"]) == 0
    assert "Ready to check columns" in capsys.readouterr().out
    monkeypatch.setitem(sys.modules, "ifcopenshell", None)
    assert main(["doctor", "--json"]) == 12
    found = {finding["package"]: finding for finding in printed_json(capsys)["packages"]}
    assert found["ifcopenshell"]["problem"] == "not installed"
    assert found["ifcopenshell"]["remedy"] == "pip install 'ifcopenshell'"
    assert found["numpy"]["version"] == np.__version__
    monkeypatch.setitem(sys.modules, "rich", None)
    assert main(["doctor"]) == 12
    printed = capsys.readouterr().out
    assert "Missing for every check: ifcopenshell, rich" in printed


def test_doctor_names_the_extra_of_what_is_missing(capsys: Output, monkeypatch: pytest.MonkeyPatch) -> None:
    # In brackets, which a terminal's library takes for a style and leaves out.
    monkeypatch.setitem(sys.modules, "lazrs", None)
    known = tuple(package for package in PACKAGES if not package.extra or package.module == "lazrs")
    monkeypatch.setattr("aadm_workbench.errors.PACKAGES", known)
    assert main(["doctor"]) == 0
    assert "pip install 'aadm-workbench[formats]'" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("library", "remedy"),
    [
        ("libusb-1.0.so.0", "apt-get install libusb-1.0-0"),
        ("libfoo.so.7", "the system's package that holds libfoo.so.7"),
    ],
)
def test_doctor_blames_the_system_for_its_library(
    capsys: Output, monkeypatch: pytest.MonkeyPatch, library: str, remedy: str
) -> None:
    """The package is there: nobody is told to install it again."""

    def loaded(name: str) -> Any:
        if name == "open3d":
            raise OSError(f"{library}: cannot open shared object file: No such file or directory")
        return importlib.import_module(name)

    known = tuple(package for package in PACKAGES if not package.extra or package.module == "open3d")
    monkeypatch.setattr("aadm_workbench.errors.PACKAGES", known)
    monkeypatch.setattr("batch.commands.doctor.import_module", loaded)
    assert main(["doctor", "--json"]) == 0
    (found,) = (one for one in printed_json(capsys)["packages"] if one["package"] == "open3d")
    assert found["problem"] == f"the system library {library} is missing"
    assert found["remedy"] == remedy


def test_simulate_without_the_ray_caster(tmp_path: Path, capsys: Output, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("batch.commands.simulate.find_spec", lambda name: None)
    assert main(["simulate", "pair", "--setting", "lab", "--out", str(tmp_path / "pair")]) == 2
    assert "pip install 'aadm-workbench[twin]'" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_simulate_without_the_renderer(tmp_path: Path, capsys: Output, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("batch.commands.simulate.find_spec", lambda name: name)
    monkeypatch.setitem(sys.modules, "mitsuba", None)
    command = ["simulate", "pair", "--setting", "lab", "--out", str(tmp_path / "pair"), "--camera", "fringe"]
    assert main(command) == 2
    assert "pip install 'aadm-workbench[physics]'" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("word", "says"), [("rings=9", "from 0 to 3"), ("ring=1", "no filter ring"), ("edge-mask=0.5", "--camera fringe")]
)
def test_simulate_refuses_filters_that_it_cannot_apply(
    tmp_path: Path, capsys: Output, monkeypatch: pytest.MonkeyPatch, word: str, says: str
) -> None:
    monkeypatch.setattr("batch.commands.simulate.find_spec", lambda name: name)
    assert main(["simulate", "pair", "--setting", "lab", "--out", str(tmp_path / "pair"), "--filter", word]) == 2
    assert says in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_filtered_pair_is_the_same_pair_with_less_of_its_edges(tmp_path: Path) -> None:
    pytest.importorskip("open3d")
    pytest.importorskip("manifold3d")
    depths = {}
    for name, more in (("plain", []), ("rings", ["--filter", "rings=1"])):
        folder = tmp_path / name
        assert main(["simulate", "pair", "--setting", "lab", "--out", str(folder), "--seed", "3", *more]) == 0
        depths[name] = cv2.imread(str(folder / "foot.tiff"), cv2.IMREAD_UNCHANGED)
    assert "--seed 3 --filter rings=1\n" in (tmp_path / "rings" / "job.toml").read_text("utf-8")
    kept = depths["rings"] > 0
    assert 0.8 < kept.sum() / (depths["plain"] > 0).sum() < 0.999
    np.testing.assert_array_equal(depths["rings"][kept], depths["plain"][kept])
    truths = [(tmp_path / name / "truth.json").read_bytes() for name in depths]
    assert truths[0] == truths[1]


def test_doctor_says_that_llvm_is_missing(capsys: Output, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("mitsuba")
    monkeypatch.setattr(
        "aadm_workbench.errors.PACKAGES", tuple(p for p in PACKAGES if not p.extra or p.module == "mitsuba")
    )
    monkeypatch.setattr("aadm_workbench.twin.fringe.renderer.llvm_found", lambda: 15)
    assert main(["doctor", "--json"]) == 0
    (found,) = (one for one in printed_json(capsys)["packages"] if one["package"] == "mitsuba")
    assert found["problem"] == "it finds LLVM 15 and needs 19 or newer"
    assert found["remedy"] == "apt-get install libllvm19"


def test_a_simulated_pair_is_checked_and_agrees_with_its_truth(tmp_path: Path, capsys: Output) -> None:
    pytest.importorskip("open3d")
    pytest.importorskip("manifold3d")
    folder = tmp_path / "pair"
    assert main(["simulate", "pair", "--setting", "lab", "--out", str(folder), "--seed", "7"]) == 0
    assert f"aadm check {folder / 'job.toml'}" in capsys.readouterr().out
    main(["check", str(folder / "job.toml"), "--quiet"])
    report = json.loads((folder / "job-report" / "report.json").read_text("utf-8"))
    jsonschema.Draft202012Validator(report_schema()).validate(report)
    (column,) = report["columns"]
    true = json.loads((folder / "truth.json").read_text("utf-8"))["columns"][column["id"]]
    for kind in ("sleeves", "rebars"):
        assert column[kind]["found"] == 12
        for found, expected in zip(column[kind]["points"], true[kind]["points"], strict=True):
            assert found["label"] == expected["label"]
            assert found["design_mm"][:2] == expected["design_mm"][:2]
            # Ten times worse than the method is: this asks whether truth and report speak of the same point.
            assert np.linalg.norm(np.subtract(found["scan_mm"], expected["scan_mm"])) < 0.6
    assert column["trial_assembly"]["minimax"]["max_mm"] == pytest.approx(true["minimax"]["max_mm"], abs=0.3)
