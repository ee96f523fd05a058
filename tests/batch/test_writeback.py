"""aadm writeback and aadm check --write-ifc: check, write, read again, the same numbers in every schema."""

from __future__ import annotations

import json
import shutil
import stat
from pathlib import Path
from typing import Any

import pytest

from batch.main import main
from tests.report.floor_schemas import SCHEMAS, converted
from tests.report.ifc_models import to_micrometres
from tests.report.ifc_results import read_ifc_results

FLOOR = Path(__file__).resolve().parents[2] / "samples" / "floor"
CHECKED = ("C-304", "C-307")
"""One sleeve of the first is plugged; two bars of the second are bent."""


def job_on(model: Path) -> Path:
    """The sample job with another model; its scans stay where they are."""
    text = (FLOOR / "job.toml").read_text(encoding="utf-8").replace('"floor3.ifc"', json.dumps(model.name))
    path = model.with_name("job.toml")
    path.write_text(text.replace('"scans/', f'"{(FLOOR / "scans").as_posix()}/'), encoding="utf-8")
    return path


def checked(model: Path, out: Path) -> dict[str, Any]:
    """The report of a real check that also writes its results into the model."""
    code = main(["check", str(job_on(model)), "--only", *CHECKED, "--out", str(out), "--write-ifc", "--quiet"])
    assert code == 10
    report: dict[str, Any] = json.loads((out / "report.json").read_text(encoding="utf-8"))
    return report


@pytest.mark.parametrize("schema", SCHEMAS)
def test_numbers_survive_the_round_trip_through_the_model(schema: str, tmp_path: Path) -> None:
    model = converted(FLOOR / "floor3.ifc", schema, tmp_path / "model.ifc")
    report = checked(model, tmp_path / "first")
    written = tmp_path / "first" / "model-checked.ifc"
    found = read_ifc_results(written)
    for column in report["columns"]:
        held = found[column["global_id"]]["AADM_ColumnCheck"]
        assert (held["Verdict"], held["GoesOn"]) == (column["verdict"], column["goes_on"])
        assert held["Reasons"] == "; ".join(column["reasons"])
        for kind in ("sleeves", "rebars"):
            for point in column[kind]["points"]:
                held = found[point["global_id"]][f"AADM_{kind[:-1].capitalize()}Check"]
                assert [held.get("Deviation"), held.get("Uncertainty")] == to_micrometres(
                    [point["deviation_mm"], point["u_mm"]]
                )
                assert [held.get("OffsetX"), held.get("OffsetY")] == to_micrometres(point["offset_mm"] or [None, None])
                assert held["Verdict"] == point["verdict"]
        for pair in ((column["trial_assembly"] or {}).get("best") or {"pairs": ()})["pairs"]:
            (sleeve,) = (point for point in column["sleeves"]["points"] if point["label"] == pair["sleeve"])
            held = found[sleeve["global_id"]]["AADM_SleeveCheck"]
            assert [held["PairDistance"], held["PairClearance"]] == to_micrometres(
                [pair["distance_mm"], pair["clearance_mm"]]
            )
    if schema == "IFC4":  # the results themselves must not disturb the next check
        again = checked(written, tmp_path / "second")
        assert again["columns"] == report["columns"]
        assert main(["writeback", str(written), "--remove", "--in-place", "--quiet"]) == 0
        assert written.read_bytes() == model.read_bytes()


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a model and the report of its check."""
    folder = tmp_path_factory.mktemp("finished")
    shutil.copy(FLOOR / "floor3.ifc", folder / "floor 3.ifc")
    checked(folder / "floor 3.ifc", folder / "report")
    return folder


def test_a_new_file_by_default_and_the_model_itself_on_request(
    finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report, model = finished / "report" / "report.json", finished / "floor 3.ifc"
    original = model.read_bytes()
    assert main(["writeback", str(report), str(model)]) == 0
    assert "2 columns: 52 property sets and 47 as-built marks in the model (IFC4)" in capsys.readouterr().out
    assert model.read_bytes() == original
    written = finished / "floor 3-checked.ifc"
    assert b"'report/report.json'" in written.read_bytes(), "the columns are linked to their report"
    assert main(["writeback", str(report), str(model), "--in-place", "--json"]) == 0
    done = json.loads(capsys.readouterr().out)
    assert model.read_bytes() == written.read_bytes()
    assert Path(done["backup"]).read_bytes() == original
    assert main(["writeback", str(report), str(model), "--in-place"]) == 0
    assert "was so already" in capsys.readouterr().out
    assert main(["writeback", str(report), str(model), "--remove"]) == 0
    assert "byte for byte" in capsys.readouterr().out
    assert (finished / "floor 3-restored.ifc").read_bytes() == original
    assert main(["writeback", str(model), "--remove", "--in-place", "--quiet"]) == 0
    assert capsys.readouterr().out == ""
    assert model.read_bytes() == original


def test_a_model_keeps_its_mode_and_one_that_may_only_be_read_stays(
    finished: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report, model = finished / "report" / "report.json", tmp_path / "floor.ifc"
    shutil.copyfile(finished / "floor 3.ifc", model)
    original = model.read_bytes()
    model.chmod(0o440)
    assert main(["writeback", str(report), str(model), "--in-place", "--quiet"]) == 2
    assert "may only be read" in capsys.readouterr().err
    assert (model.read_bytes(), sorted(tmp_path.iterdir())) == (original, [model]), "nor is there a backup"
    model.chmod(0o664)
    assert main(["writeback", str(report), str(model), "--in-place", "--quiet"]) == 0
    assert model.read_bytes() != original
    assert stat.S_IMODE(model.stat().st_mode) == 0o664
    checked_copy = tmp_path / "tower-checked.ifc"
    shutil.copyfile(model, checked_copy)
    assert main(["writeback", str(checked_copy), "--remove", "--quiet"]) == 0
    assert (tmp_path / "tower-restored.ifc").read_bytes() == original, "not tower-checked-restored.ifc"


def test_a_changed_model_is_refused_without_force(finished: Path, capsys: pytest.CaptureFixture[str]) -> None:
    report, model = finished / "report" / "report.json", finished / "changed.ifc"
    model.write_bytes((finished / "floor 3.ifc").read_bytes().replace(b"'3F'", b"'4F'"))
    assert main(["writeback", str(report), str(model)]) == 2
    assert "has changed since" in capsys.readouterr().err
    assert not (finished / "changed-checked.ifc").exists()
    ids = finished / "results.ids"
    assert main(["writeback", str(report), str(model), "--force", "--quiet", "--ids", str(ids)]) == 0
    assert (finished / "changed-checked.ifc").exists()
    assert "AADM_SleeveCheck" in ids.read_text(encoding="utf-8")


def test_bad_usage_ends_before_any_work(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["writeback", str(tmp_path / "report.json")]) == 2
    assert "name the report and the model" in capsys.readouterr().err
    job = tmp_path / "job.toml"
    job.write_text(
        'schema = 1\nname = "a"\nunits = "mm"\n[[columns]]\nid = "C-1"\nsleeves = "a.ply"\nup = "+y"\n'
        "[columns.design]\nsleeve_diameter = 36.0\nrebar_diameter = 20.0\nsize = [600.0, 600.0]\n"
        "centres = [[-240.0, -240.0], [240.0, -240.0], [240.0, 240.0]]\n",
        encoding="utf-8",
    )
    assert main(["check", str(job), "--write-ifc", "--out", str(tmp_path / "out")]) == 2
    assert "--write-ifc needs a [model]" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
