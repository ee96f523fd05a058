"""Sampling documents in the real FreeCAD: each dialect by an exact truth, each bar and each hole once."""

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.design_text import read_design
from aadm_workbench.design.element_json import from_json
from aadm_workbench.design.recognise.columns import Origin, Rules, recognise
from aadm_workbench.errors import DesignError
from aadm_workbench.model import AssemblyPoint, ColumnDesign
from batch.answers import columns
from tests.conftest import FreeCADRunner, find_freecad

pytestmark = pytest.mark.freecad

EXACT_MM = 0.001
AUTHOR = Path(__file__).with_name("freecad_author.py")

# One FreeCAD writes all and samples its shapes: most of what these tests take is its start.
SAMPLE_ALL = """\
import sys
sys.path.insert(0, {folder!r})
import FreeCAD
import freecad_author
from aadm_workbench.document.sample.columns import sampled_shapes
from aadm_workbench.errors import AadmError

result["undrawn"] = [name for name in freecad_author.SCENES if not freecad_author.can_draw(name)]
for name in set(freecad_author.SCENES) - set(result["undrawn"]):
    path, truth = freecad_author.write(name, folder)
    document = FreeCAD.openDocument(path)
    sys.modules["scipy"] = None  # FreeCAD need not bring it
    result[name] = dict(shapes=sampled_shapes(document), truth=truth, path=path)
    if name == "links":
        result["selected"] = sampled_shapes(document, [document.Column002])
        result["objects"] = sampled_shapes(document, [document.Column, document.Column001])
        result["one bar"] = sampled_shapes(document, [document.OneBar])
        result["names"] = [obj.Name for obj in document.Objects]
    FreeCAD.closeDocument(document.Name)
"""


def plain(points: Sequence[AssemblyPoint]) -> list[dict[str, Any]]:
    return [
        {"label": p.label, "centre": p.centre.tolist(), "axis": p.axis.tolist(), "diameter": p.diameter_mm}
        | {"length": p.length_mm, "guid": p.global_id, "object": p.object_name, "why": p.why}
        for p in points
    ]


def entry(column: ColumnDesign) -> dict[str, Any]:
    assert column.T_model_column is not None
    said = {"id": column.id, "names": list(column.names), "size": column.size_mm, "storey": column.storey}
    said |= {"mark": column.piece_mark, "guid": column.global_id, "T": column.T_model_column.tolist()}
    return said | {
        "sleeves": plain(column.sleeves),
        "rebars": plain(column.rebars),
        "warnings": list(column.warnings),
    }


def recognised(shapes: Mapping[str, Any], rules: Rules | None = None) -> dict[str, Any]:
    """What the private process makes of shapes that FreeCAD has handed over, all of them."""
    origin = Origin(shapes["source"], shapes["sha256"], "FreeCAD", tuple(shapes["problems"]))
    model = recognise(from_json(shapes["elements"]), origin, rules)
    return {
        "columns": [entry(column) for column in model.columns],
        "loose_sleeves": plain(model.loose_sleeves),
        "loose_rebars": plain(model.loose_rebars),
        "warnings": list(model.warnings),
        "holdings": model.holdings,
        "left": [[left.what, left.name, left.reason] for left in model.not_taken],
        "sha256": model.sha256,
    }


def pointed_at(shapes: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The columns that the private process answers for objects that were selected."""
    answer = columns({"about": "columns", **shapes})
    return [entry(read_design(text, "the answer")) for text in answer["columns"]]


class Sampled(dict[str, Any]):
    """What was sampled, by scene; to ask for one that this FreeCAD cannot draw skips the test."""

    def __missing__(self, name: str) -> Any:
        if name not in self["undrawn"]:
            raise KeyError(name)
        pytest.skip(f"this FreeCAD cannot draw {name!r} without a window")


@pytest.fixture(scope="module")
def sampled(tmp_path_factory: pytest.TempPathFactory) -> Sampled:
    """What FreeCAD sampled in each scene, with the truth."""
    program = find_freecad("freecadcmd", "FreeCADCmd")
    runner = FreeCADRunner(program, tmp_path_factory.mktemp("documents"))
    found = Sampled(runner.run(SAMPLE_ALL.format(folder=str(AUTHOR.parent)), timeout_s=300.0))
    for name in SCENES:
        if name not in found["undrawn"]:
            found[name] = recognised(found[name]["shapes"]) | found[name]
    return found


SCENES = (
    "arch",
    "part",
    "part_design",
    "links",
    "arrays",
    "imported",
    "native",
    "meshes",
    "features",
    "hidden",
    "tilted",
)


def in_model(column: dict[str, Any], point: dict[str, Any]) -> Any:
    return (np.array(column["T"]) @ [*point["centre"], 1.0])[:3]


@pytest.mark.parametrize("name", SCENES)
def test_every_point_is_where_it_was_drawn(sampled, name: str) -> None:
    found, truth = sampled[name], sampled[name]["truth"]
    assert len(found["columns"]) == len(truth["columns"])
    assert found["loose_sleeves"] == found["loose_rebars"] == []
    for T in map(np.array, truth["columns"]):
        column = min(found["columns"], key=lambda one: float(np.linalg.norm(np.array(one["T"])[:3, 3] - T[:3, 3])))
        drawn = {
            "sleeves": np.array([(T @ [x, y, 0.0, 1.0])[:3] for x, y in truth["ring"]]),
            "rebars": np.array([(T @ [x, y, truth["top_mm"], 1.0])[:3] for x, y in truth["ring"]]),
        }
        for kind, diameter_mm in (("sleeves", truth["bore_mm"]), ("rebars", truth["bar_mm"])):
            points = np.array([in_model(column, point) for point in column[kind]])
            assert len(points) == 12
            distance_mm = np.linalg.norm(points[:, np.newaxis] - drawn[kind], axis=2)
            assert sorted(distance_mm.argmin(axis=1)) == list(range(12)), "each once"
            assert distance_mm.min(axis=1).max() < EXACT_MM
            assert max(abs(point["diameter"] - diameter_mm) for point in column[kind]) < EXACT_MM
        for sleeve, rebar in zip(column["sleeves"], column["rebars"], strict=True):
            assert sleeve["label"][1:] == rebar["label"][1:]
            assert np.linalg.norm(np.subtract(sleeve["centre"], rebar["centre"])[:2]) < EXACT_MM
        assert column["size"] == pytest.approx([600.0, 600.0], abs=EXACT_MM)
        assert "not in the model" not in " ".join(rebar["why"] for rebar in column["rebars"])


@pytest.mark.parametrize("name", SCENES)
def test_sleeves_are_as_long_as_drawn_and_upright(sampled, name: str) -> None:
    for column in sampled[name]["columns"]:
        assert [sleeve["length"] for sleeve in column["sleeves"]] == pytest.approx([310.0] * 12, abs=0.01)
        up = np.array(column["T"])[:3, :3] @ column["sleeves"][0]["axis"]
        assert up == pytest.approx([0.0, 0.0, 1.0], abs=1e-6)


def test_columns_are_called_as_people_call_them(sampled) -> None:
    assert [column["id"] for column in sampled["arch"]["columns"]] == ["C-301", "C-302"]
    assert sorted(column["id"] for column in sampled["links"]["columns"]) == ["C-401", "C-402", "C-403", "C-404"]
    assert sampled["part_design"]["columns"][0]["id"] == "C-301", "the App::Part is named, the body is not"
    assert sampled["native"]["columns"][0]["mark"] == "PCZ-9"
    assert sampled["native"]["columns"][0]["storey"] == "Level 3"
    assert {column["storey"] for column in sampled["arch"]["columns"]} == {"3F"}


def test_points_know_their_objects_and_their_global_ids(sampled) -> None:
    column = sampled["imported"]["columns"][0]
    assert column["guid"] == "2O2Fr$t4X7Zf8NOew3FLOH"
    assert {sleeve["guid"] for sleeve in column["sleeves"]} == {f"{number:022d}" for number in range(12)}
    assert all(rebar["guid"].startswith("B") and rebar["object"].startswith("Bar") for rebar in column["rebars"])
    plain = sampled["part"]["columns"][0]
    assert plain["guid"] is None
    assert {point["guid"] for point in plain["sleeves"] + plain["rebars"]} == {None}
    assert {sleeve["object"] for sleeve in plain["sleeves"]} == {"Cut"}
    points = [point for column in sampled["links"]["columns"] for point in column["sleeves"] + column["rebars"]]
    assert {point["object"].split(".")[0] for point in points} <= set(sampled["names"])


def test_what_is_no_sleeve_is_left_out_and_said(sampled) -> None:
    left = sampled["imported"]["left"]
    assert ["sleeve", "吊装套筒", "is called '吊装': no grouting sleeve"] in left
    assert any(name == "防水套管 DN40" for _, name, _ in left) or all(
        "防水" not in sleeve["why"] for sleeve in sampled["imported"]["columns"][0]["sleeves"]
    )
    reasons = [reason for what, name, reason in sampled["arch"]["left"] if "箍" in name]
    assert reasons == []  # a stirrup that FreeCAD could not sweep has no body


def test_one_selected_column(sampled) -> None:
    (selected,) = pointed_at(sampled["selected"])
    assert selected["id"] == "C-403"
    assert len(selected["rebars"]) == 12
    assert [column["id"] for column in pointed_at(sampled["objects"])] == ["C-401", "C-402"]
    with pytest.raises(DesignError, match="OneBar has no grouting sleeves in its foot face"):
        pointed_at(sampled["one bar"])


def test_rules_of_the_job(sampled) -> None:
    rules = Rules("Label=/^预制柱$/, object!=Column.Concrete", "Name*=Sleeve + Label=/套筒/")
    found = recognised(sampled["links"]["shapes"], rules)
    assert sorted(column["id"] for column in found["columns"]) == ["C-402", "C-403", "C-404"]


def test_a_hidden_original_counts_only_where_everything_is_hidden(sampled) -> None:
    objects = {point["object"].split(".")[0] for column in sampled["links"]["columns"] for point in column["sleeves"]}
    assert "Library" not in objects
    assert "Sleeve" not in objects
    assert len(sampled["hidden"]["columns"]) == 1


def test_the_hash_is_that_of_the_file(sampled) -> None:
    import hashlib

    assert sampled["part"]["sha256"] == hashlib.sha256(Path(sampled["part"]["path"]).read_bytes()).hexdigest()


def test_a_mirrored_column_keeps_its_bars(sampled) -> None:
    mirrored = next(column for column in sampled["links"]["columns"] if column["id"] == "C-404")
    T = np.array(mirrored["T"])
    assert math.isclose(np.linalg.det(T[:3, :3]), 1.0, abs_tol=1e-9), "a frame of its own, right-handed"


def test_results_are_json(sampled) -> None:
    assert json.loads(json.dumps(sampled["tilted"]["columns"], allow_nan=False))
