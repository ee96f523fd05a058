"""BCF 2.1 and 3.0 against the classes of bcf-client, which are generated from the schemas; both updated alike."""

from __future__ import annotations

import copy
import dataclasses
import re
import uuid
import xml.etree.ElementTree as ElementTree
import zipfile
from datetime import UTC, datetime
from importlib import import_module
from pathlib import Path
from typing import Any, get_args

import cv2
import numpy as np
import pytest

from aadm_workbench.errors import ReportError
from aadm_workbench.report.bcf.topics import write_bcf
from tests.report.floor_schemas import made_report
from tests.report.typed import typed

FLOOR = Path(__file__).resolve().parents[2] / "samples" / "floor" / "floor3.ifc"
DAY = datetime(2026, 11, 20, tzinfo=UTC)
HOSTILE = "C'1\"<script>alert(1)</script>\x01灌浆😀 =1+1"
ROOTS = {
    "markup.bcf": {"2.1": "Markup", "3.0": "Markup"},
    "viewpoint.bcfv": {"2.1": "VisualizationInfo", "3.0": "VisualizationInfo"},
    "project.bcfp": {"2.1": "ProjectExtension", "3.0": "ProjectInfo"},
    "bcf.version": {"2.1": "Version", "3.0": "Version"},
    "extensions.xml": {"3.0": "Extensions"},
    "documents.xml": {"3.0": "DocumentInfo"},
}


@pytest.fixture(scope="module")
def made() -> dict[str, Any]:
    return made_report(FLOOR, only=("C-301", "C-302", "C-303"))


@pytest.fixture
def report(made: dict[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = copy.deepcopy(made)
    return found


def files(path: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def topics(path: Path) -> list[str]:
    return [name for name in files(path) if name.endswith("markup.bcf")]


def rewritten(path: Path, place: str, root: ElementTree.Element) -> None:
    held = files(path) | {place: ElementTree.tostring(root)}
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in held.items():
            archive.writestr(name, content)


def assert_follows(element: ElementTree.Element, schema: Any) -> None:
    """An element has what its generated class asks for: children in their order, as often as allowed, and patterns."""
    kept = {field.metadata["name"]: field for field in dataclasses.fields(schema) if "name" in field.metadata}
    children = {name: field for name, field in kept.items() if field.metadata["type"] == "Element"}
    attributes = {name: field for name, field in kept.items() if field.metadata["type"] == "Attribute"}
    assert set(element.attrib) <= set(attributes), element.tag
    assert [child.tag for child in element] == sorted(
        (child.tag for child in element), key=lambda tag: list(children).index(tag)
    ), element.tag
    for name, field in {**children, **attributes}.items():
        texts = [child.text or "" for child in element.findall(name)] if name in children else [element.get(name)]
        texts = [text for text in texts if text is not None]
        assert texts or not (field.metadata.get("required") or field.metadata.get("min_occurs")), (element.tag, name)
        pattern = field.metadata.get("pattern")
        assert all(re.fullmatch(pattern, text) for text in texts if pattern), (element.tag, name, texts)
        assert all(len(text) >= field.metadata.get("min_length", 0) for text in texts), (element.tag, name)
    for child in element:
        kind = _class_of(children[child.tag].type, schema)
        if kind is not None:
            assert_follows(child, kind)


def _class_of(annotation: Any, schema: Any) -> Any:
    """The dataclass that a field holds, or a list of."""
    if isinstance(annotation, str):
        annotation = eval(annotation, vars(import_module(schema.__module__)))
    found = [annotation, *get_args(annotation), *(inner for arg in get_args(annotation) for inner in get_args(arg))]
    return next((kind for kind in found if dataclasses.is_dataclass(kind)), None)


def assert_valid(path: Path, version: str) -> None:
    model = pytest.importorskip(f"bcf.v{version[0]}.model")
    held = files(path)
    assert {name for name, roots in ROOTS.items() if version in roots and "/" not in name} - set(held) <= {
        "markup.bcf",
        "viewpoint.bcfv",
    }
    for name, content in held.items():
        last = name.rpartition("/")[2]
        if last in ROOTS:
            root = ElementTree.fromstring(content)
            assert root.tag == ROOTS[last][version]
            assert_follows(root, getattr(model, root.tag))


@pytest.mark.parametrize("version", ["2.1", "3.0"])
@pytest.mark.parametrize("language", ["en", "zh"])
def test_each_version_is_as_its_schema_wants_it(
    report: dict[str, Any], tmp_path: Path, version: Any, language: Any
) -> None:
    path = tmp_path / "report.bcf"
    report["columns"][1] |= {"id": HOSTILE, "reasons": [HOSTILE], "storey": "  "}
    write_bcf(typed(report), path, version=version, language=language, written=DAY)
    assert_valid(path, version)
    report["columns"][0]["reasons"] = ["S5 is off"]
    report["columns"][1]["verdict"] = "pass"
    done = write_bcf(typed(report), path, existing=path, language=language, written=DAY.replace(day=21))
    assert (len(done.updated), len(done.closed)) == (1, 1)
    assert_valid(path, version)


@pytest.mark.parametrize("version", ["2.1", "3.0"])
def test_bcf_client_opens_it(report: dict[str, Any], tmp_path: Path, version: Any) -> None:
    bcfxml = pytest.importorskip("bcf.bcfxml")
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path, version=version, language="zh")
    loaded = bcfxml.load(path)
    assert loaded.version.version_id == version
    handler = loaded.topics[topics(path)[0].partition("/")[0]]
    assert handler.topic.title == "C-301 不合格：S1 is off"
    assert handler.comments[0].author == "AADM workbench"
    view = handler.viewpoints["viewpoint.bcfv"]
    assert view.snapshot.startswith(b"\x89PNG")
    assert view.visualization_info.guid == handler.comments[0].viewpoint.guid
    if version == "3.0":
        assert [name.startswith("C-30") for name in loaded.documents.documents] == [True] * len(topics(path))


def test_an_earlier_file_is_gone_on_with_in_its_own_version(report: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path, version="3.0", written=DAY)
    before = path.read_bytes()
    done = write_bcf(typed(report), path, existing=path, written=DAY.replace(day=22))
    assert (len(done.unchanged), path.read_bytes()) == (len(topics(path)), before)
    with pytest.raises(ReportError, match=r"is of BCF version 3\.0, and 2\.1 was asked for"):
        write_bcf(typed(report), path, existing=path, version="2.1")
    assert path.read_bytes() == before


@pytest.mark.parametrize("version", ["2.1", "3.0"])
def test_what_people_changed_stays(report: dict[str, Any], tmp_path: Path, version: Any) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path, version=version, written=DAY)
    first, second, _ = topics(path)
    root = ElementTree.fromstring(files(path)[first])
    root.find("Topic/Title").text = "C-301: ask Wang"
    root.find("Topic/Priority").text = "Low"
    root.find("Topic/Description").text = "My own words"
    rewritten(path, first, root)
    for column in report["columns"]:
        column["reasons"] = ["S5 is off"]
    write_bcf(typed(report), path, existing=path, written=DAY.replace(day=21))
    after = ElementTree.fromstring(files(path)[first])
    assert [after.findtext(f"Topic/{name}") for name in ("Title", "Priority", "Description")] == [
        "C-301: ask Wang",
        "Low",
        "My own words",
    ]
    other = ElementTree.fromstring(files(path)[second])
    assert other.findtext("Topic/Title") == "C-302 fails: S5 is off"
    report["columns"][0]["verdict"] = "pass"
    write_bcf(typed(report), path, existing=path, written=DAY.replace(day=22))
    closed = ElementTree.fromstring(files(path)[first])
    assert closed.find("Topic").get("TopicStatus") == "Closed"
    assert closed.findtext("Topic/Title") == "C-301: ask Wang"


@pytest.mark.parametrize("version", ["2.1", "3.0"])
def test_comments_have_guids_of_their_own_after_deletions(report: dict[str, Any], tmp_path: Path, version: Any) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path, version=version, written=DAY)
    place = topics(path)[0]
    where = "Topic/Comments" if version == "3.0" else "."
    seen = set()
    for day, reason in enumerate(("S5 is off", "S6 is off", "S5 is off", "S7 is off"), start=21):
        report["columns"][0]["reasons"] = [reason]
        write_bcf(typed(report), path, existing=path, written=DAY.replace(day=day))
        root = ElementTree.fromstring(files(path)[place])
        comments = root.findall(f"{where}/Comment")
        guids = [comment.get("Guid") for comment in comments]
        assert len(set(guids)) == len(guids)
        assert guids[-1] not in seen, "a comment that was deleted and one that is new are two"
        seen |= set(guids)
        root.find(where).remove(comments[0])
        rewritten(path, place, root)


def test_the_viewpoint_is_another_where_it_shows_something_else(report: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path, written=DAY)
    place = topics(path)[0]
    guid = ElementTree.fromstring(files(path)[place]).find("Viewpoints").get("Guid")
    report["columns"][0]["sleeves"]["points"][0]["verdict"] = "pass"
    write_bcf(typed(report), path, existing=path, written=DAY.replace(day=21))
    root = ElementTree.fromstring(files(path)[place])
    new = root.find("Viewpoints").get("Guid")
    assert str(uuid.UUID(new)) == new != guid
    view = ElementTree.fromstring(files(path)[place.replace("markup.bcf", "viewpoint.bcfv")])
    assert {view.get("Guid"), *(one.get("Guid") for one in root.findall("Comment/Viewpoint"))} == {new}


def test_the_project_of_the_model_is_named_where_it_is_one(report: dict[str, Any], tmp_path: Path) -> None:
    for project, expected in (("0YvctVUKr0kugbFTf53O9L", "0YvctVUKr0kugbFTf53O9L"), ("no guid", None)):
        report["model"]["ifc_project"] = project
        path = tmp_path / f"{expected}.bcf"
        write_bcf(typed(report), path)
        root = ElementTree.fromstring(files(path)[topics(path)[0]])
        assert root.find("Header/File").get("IfcProject") == expected


def test_a_markup_without_a_topic_is_refused(report: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path)
    rewritten(path, topics(path)[0], ElementTree.Element("Markup"))
    before = path.read_bytes()
    with pytest.raises(ReportError, match="has no topic in it"):
        write_bcf(typed(report), path, existing=path)
    assert path.read_bytes() == before


def test_picture_and_camera_see_the_same_side(report: dict[str, Any], tmp_path: Path) -> None:
    """A point that fails alone is on that side of the picture on which the camera of the viewpoint has it."""
    column = report["columns"][0]
    report["columns"] = [column]
    points = [point for kind in ("sleeves", "rebars") for point in column[kind]["points"]]
    for point in points:
        point |= {"verdict": "pass", "offset_mm": [0.0, 0.0]}
    column["trial_assembly"] = None
    failing = column["sleeves"]["points"][0]
    failing |= {"verdict": "fail", "offset_mm": [2.5, 0.0]}
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path)
    held = files(path)
    view = ElementTree.fromstring(next(content for name, content in held.items() if name.endswith("bcfv")))
    direction, up = (
        np.array([float(view.findtext(f"PerspectiveCamera/{name}/{axis}")) for axis in "XYZ"])
        for name in ("CameraDirection", "CameraUpVector")
    )
    T = np.array(column["T_model_column"])
    right = float(np.cross(direction, up) @ T[:3, :3] @ failing["design_mm"])
    content = next(content for name, content in held.items() if name.endswith("png"))
    picture = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR).astype(int)[100:-60]
    _, across = np.nonzero(picture[..., 2] - picture[..., 0] > 120)
    assert (across.mean() - picture.shape[1] / 2.0) * right > 0.0
