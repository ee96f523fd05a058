"""What the workbench asks: columns and scans in plain numbers, and designs that a job takes for its model."""

import hashlib
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.design_text import read_designs, write_model
from aadm_workbench.errors import DesignError
from batch.job.file import read_job
from batch.main import main

ROOT = Path(__file__).resolve().parents[2]
FLOOR = ROOT / "samples" / "floor" / "floor3.ifc"
LAB = ROOT / "samples" / "lab"


def asked(folder: Path, **question: Any) -> dict[str, Any]:
    (folder / "question.json").write_text(json.dumps(question), encoding="utf-8")
    assert main(["ask", str(folder / "question.json"), str(folder / "answer.json")]) == 0
    answer: dict[str, Any] = json.loads((folder / "answer.json").read_text(encoding="utf-8"))
    return answer


def scan_question(file: Path, **more: Any) -> dict[str, Any]:
    return {"about": "scan", "file": str(file), "units": "mm", "camera": None, "depth_scale_mm": None} | more


def test_scan_is_thinned_and_its_hash_is_that_of_the_file(tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    cloud = rng.uniform([-300.0, -300.0, 700.0], [300.0, 300.0, 900.0], (1000, 3)).round(3)
    file = tmp_path / "点 云.xyz"
    np.savetxt(file, cloud, fmt="%.3f")
    answer = asked(tmp_path, **scan_question(file, most_points=300))
    assert answer["count"] == 1000
    assert answer["sha256"] == hashlib.sha256(file.read_bytes()).hexdigest()
    np.testing.assert_allclose(answer["points"], cloud[::4], atol=1e-3)


def test_depth_scale_is_taken_from_the_camera_file(tmp_path: Path) -> None:
    import tomllib

    camera = tomllib.loads((FLOOR.parent / "job.toml").read_text(encoding="utf-8"))["camera"]
    named = tmp_path / "camera.toml"
    named.write_text("[camera]\n" + "".join(f"{key} = {value!r}\n" for key, value in camera.items()), encoding="utf-8")
    file = FLOOR.parent / "scans" / "C-301-foot.tiff"
    answer = asked(tmp_path, **scan_question(file, camera=str(named), most_points=1000))
    assert answer["depth_scale_mm"] == camera["depth_scale_mm"]
    assert answer["camera"] == {key: value for key, value in camera.items() if key != "depth_scale_mm"}
    far_mm = np.array(answer["points"])[:, 2]
    alone = asked(tmp_path, about="camera", file=str(named))
    assert alone == {"camera": answer["camera"], "depth_scale_mm": answer["depth_scale_mm"]}
    assert 1000.0 < np.median(far_mm) < 1700.0, "the camera of the sample stood 1.3 m away"


def test_columns_are_where_the_command_lists_them(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answer = asked(tmp_path, about="columns", path=str(FLOOR))
    assert answer["sha256"] == hashlib.sha256(FLOOR.read_bytes()).hexdigest()
    assert main(["design", str(FLOOR), "--json", "--quiet"]) == 0
    listed = {column["id"]: column for column in json.loads(capsys.readouterr().out)["columns"]}
    columns = [json.loads(text) for text in answer["columns"]]
    assert [column["id"] for column in columns] == list(listed)
    for column in columns:
        T = np.array(column["T_model_column"])
        placed = [(T @ [*point["centre_mm"], 1.0])[:3] for point in column["sleeves"]]
        np.testing.assert_allclose(placed, [one["centre_mm"] for one in listed[column["id"]]["sleeves"]], atol=1e-3)


def test_bodies_are_what_the_model_draws(tmp_path: Path) -> None:
    """Another reader of IFC, ifcopenshell's own, draws the same column in the same place."""
    import ifcopenshell
    import ifcopenshell.geom

    answer = asked(tmp_path, about="columns", path=str(FLOOR))
    settings = ifcopenshell.geom.settings()
    settings.set("use-world-coords", True)
    model = ifcopenshell.open(str(FLOOR))
    for text, faces in list(zip(answer["columns"], answer["bodies"], strict=True))[:2]:
        column = json.loads(text)
        shape = ifcopenshell.geom.create_shape(settings, model.by_guid(column["global_id"]))
        drawn_mm = 1000.0 * np.array(shape.geometry.verts).reshape(-1, 3)
        T = np.array(column["T_model_column"])
        placed_mm = np.concatenate([np.array(face) for face in faces]) @ T[:3, :3].T + T[:3, 3]
        np.testing.assert_allclose(placed_mm.min(axis=0), drawn_mm.min(axis=0), atol=0.1)
        np.testing.assert_allclose(placed_mm.max(axis=0), drawn_mm.max(axis=0), atol=0.1)


NONSENSE = {"no json": "{", "no question": "[1]", "unknown": '{"about": "weather"}', "empty": "", "no subject": "{}"}


@pytest.mark.parametrize("which", NONSENSE)
def test_what_is_no_question_is_refused(tmp_path: Path, which: str, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "question.json").write_text(NONSENSE[which], encoding="utf-8")
    assert main(["ask", str(tmp_path / "question.json"), str(tmp_path / "answer.json")]) == 2
    assert "question.json: is no question of the workbench" in capsys.readouterr().err
    assert not (tmp_path / "answer.json").exists()


def test_designs_that_are_handed_over_are_checked_as_those_of_the_job(tmp_path: Path) -> None:
    job = read_job(LAB / "job.toml")
    designs = {column.id: column.design for column in job.columns if column.design is not None}
    (tmp_path / "design.json").write_text(write_model({"source": "yard.FCStd"}, designs), encoding="utf-8")
    text = 'schema = 1\nname = "handed over"\nmodel = { path = "design.json" }\n[[columns]]\nid = "L-1"\nup = "+y"\n'
    for kind, name in (("sleeves", "L-1-foot.ply"), ("rebars", "L-1-bars.pcd")):
        text += f"{kind} = {json.dumps(str(LAB / 'scans' / name))}\n"
    (tmp_path / "handed.toml").write_text(text, encoding="utf-8")
    found = []
    for source in (LAB / "job.toml", tmp_path / "handed.toml"):
        out = tmp_path / source.stem
        main(["check", str(source), "--only", "L-1", "--out", str(out), "--quiet"])
        report = (out / "report.json").read_text(encoding="utf-8").replace("scans/L-1", "L-1")
        found.append(json.loads(report)["columns"][0])
    placed = ("T_model_column", "global_id")
    assert {key: value for key, value in found[1].items() if key not in placed} == {
        key: value for key, value in found[0].items() if key not in placed
    }


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "{}", '{"taken_from": {}, "columns": [{"id": "C"}]}', '{"taken_from": 1, "columns": []}']
)
def test_file_that_holds_no_designs_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "design.json").write_text(text, encoding="utf-8")
    with pytest.raises(DesignError, match=r"design\.json"):
        read_designs(tmp_path / "design.json")
