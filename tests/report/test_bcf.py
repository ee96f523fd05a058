"""BCF topics: what viewers ask for is there, a re-run updates instead of adding, a repaired column closes its topic."""

from __future__ import annotations

import copy
import csv
import io
import re
import uuid
import xml.etree.ElementTree as ElementTree
import zipfile
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from aadm_workbench.errors import ReportError
from aadm_workbench.report.bcf.topics import write_bcf
from tests.report.floor_schemas import made_report
from tests.report.typed import typed

FLOOR = Path(__file__).resolve().parents[2] / "samples" / "floor" / "floor3.ifc"
HOSTILE = "C'1\"<script>alert(1)</script>\x01灌浆😀 =1+1"
DAY = datetime(2026, 11, 20, tzinfo=UTC)

# The schemas of BCF 2.1, as far as these files use them: children in their order, * for any number, ? for optional.
MARKUP = {
    "Markup": "Header? Topic Comment* Viewpoints*",
    "Header": "File*",
    "File": "Filename? Date? Reference?",
    "Topic": "ReferenceLink* Title Priority? Index? Labels* CreationDate CreationAuthor ModifiedDate? ModifiedAuthor? "
    "DueDate? AssignedTo? Stage? Description? BimSnippet* DocumentReference* RelatedTopic*",
    "DocumentReference": "ReferencedDocument? Description?",
    "Comment": "Date Author Comment Viewpoint? ModifiedDate? ModifiedAuthor?",
    "Viewpoints": "Viewpoint? Snapshot? Index?",
}
VIEWPOINT = {
    "VisualizationInfo": "Components? OrthogonalCamera? PerspectiveCamera? Lines? ClippingPlanes? Bitmap*",
    "Components": "ViewSetupHints? Selection? Visibility Coloring?",
    "Selection": "Component*",
    "Visibility": "Exceptions?",
    "Exceptions": "Component*",
    "Coloring": "Color*",
    "Color": "Component*",
    "PerspectiveCamera": "CameraViewPoint CameraDirection CameraUpVector FieldOfView",
    "CameraViewPoint": "X Y Z",
    "CameraDirection": "X Y Z",
    "CameraUpVector": "X Y Z",
}


@pytest.fixture(scope="module")
def made() -> dict[str, Any]:
    return made_report(FLOOR, only=("C-301", "C-302", "C-303"))


@pytest.fixture
def report(made: dict[str, Any]) -> dict[str, Any]:
    """Three columns: the first fails, the second fails too, the third passes."""
    found: dict[str, Any] = copy.deepcopy(made)
    found["columns"][2]["verdict"] = "pass"
    for kind in ("sleeves", "rebars"):
        for point in found["columns"][2][kind]["points"]:
            point["verdict"] = "pass"
    return found


def files(path: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        return {name: archive.read(name) for name in archive.namelist()}


def markup(path: Path, guid: str) -> ElementTree.Element:
    return ElementTree.fromstring(files(path)[f"{guid}/markup.bcf"])


def guids(path: Path) -> list[str]:
    return [name.partition("/")[0] for name in files(path) if name.endswith("markup.bcf")]


def assert_in_order(element: ElementTree.Element, schema: dict[str, str]) -> None:
    """Children as the schema's sequence has them; an element without children is a text."""
    if len(element):
        parts = (re.fullmatch(r"(\w+)([*?]?)", part) for part in schema[element.tag].split())
        pattern = "".join(f"(?:{part[1]} ){part[2]}" for part in parts if part)
        assert re.fullmatch(pattern, "".join(f"{child.tag} " for child in element)), element.tag
    for child in element:
        assert_in_order(child, schema)


@pytest.mark.parametrize("per", ["column", "pair"])
def test_every_topic_has_what_viewers_ask_for(per: Any, report: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    done = write_bcf(typed(report), path, per=per)
    held = files(path)
    assert 'VersionId="2.1"' in held["bcf.version"].decode()
    expected = ["C-301", "C-302"] if per == "column" else [f"C-30{c} S{k}/R{k}" for c in (1, 2) for k in (1, 2)]
    assert list(done.opened) == expected
    assert len(guids(path)) == len(expected)
    for guid in guids(path):
        assert str(uuid.UUID(guid)) == guid
        topic = markup(path, guid)
        assert_in_order(topic, MARKUP)
        view = ElementTree.fromstring(held[f"{guid}/viewpoint.bcfv"])
        assert_in_order(view, VIEWPOINT)
        assert topic.find("Topic").get("Guid") == guid
        assert topic.find("Topic").get("TopicStatus") == "Open"
        assert topic.find("Viewpoints").get("Guid") == view.get("Guid")
        assert topic.find("Comment/Viewpoint").get("Guid") == view.get("Guid")
        assert topic.findtext("Viewpoints/Viewpoint") == "viewpoint.bcfv"
        picture = cv2.imdecode(np.frombuffer(held[f"{guid}/{topic.findtext('Viewpoints/Snapshot')}"], np.uint8), 1)
        assert min(picture.shape[:2]) >= 500
        assert (picture[100:-50] < 250).any(), "something is drawn"
        table = held[f"{guid}/{topic.findtext('Topic/DocumentReference/ReferencedDocument')}"]
        rows = list(csv.DictReader(io.StringIO(table.decode("utf-8-sig"))))
        assert {row["column"] for row in rows} == {topic.findtext("Topic/Title").split()[0]}


def test_bcf_client_reads_it(report: dict[str, Any], tmp_path: Path) -> None:
    bcfxml = pytest.importorskip("bcf.bcfxml")
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path)
    loaded = bcfxml.load(path)
    assert loaded.version.version_id == "2.1"
    assert loaded.project.name == report["job"]["name"]
    assert len(loaded.topics) == 2
    handler = loaded.topics[guids(path)[0]]
    assert handler.topic.title.startswith("C-301 fails: S1 is off")
    assert {"AADM", "fail", "sleeves", "rebars", "3F"} <= set(handler.topic.labels)
    assert "S2 not measured: plugged" in handler.comments[0].comment
    view = handler.viewpoints["viewpoint.bcfv"]
    assert view.snapshot.startswith(b"\x89PNG")
    points = report["columns"][0]["sleeves"]["points"] + report["columns"][0]["rebars"]["points"]
    components = view.visualization_info.components
    chosen = {component.ifc_guid for component in components.selection.component}
    assert chosen == {point["global_id"] for point in points if point["label"][1:] in ("1", "2")}
    shown = {component.ifc_guid for component in components.visibility.exceptions.component}
    assert shown == {point["global_id"] for point in points} | {report["columns"][0]["global_id"]}
    assert components.visibility.default_visibility is False
    colours = {
        component.ifc_guid: colour.color for colour in components.coloring.color for component in colour.component
    }
    by_verdict = {point["verdict"]: colours[point["global_id"]] for point in points}
    assert len(set(by_verdict.values())) == 3
    red, green = (int(by_verdict["fail"][place : place + 2], 16) for place in (2, 4))
    assert red > 2 * green
    assert colours[report["columns"][0]["global_id"]] == by_verdict["fail"]


def test_the_camera_is_under_the_foot_and_looks_at_it(report: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path)
    view = ElementTree.fromstring(files(path)[f"{guids(path)[1]}/viewpoint.bcfv"])
    camera = view.find("PerspectiveCamera")
    position, direction, up = (
        np.array([float(camera.findtext(f"{name}/{axis}")) for axis in "XYZ"])
        for name in ("CameraViewPoint", "CameraDirection", "CameraUpVector")
    )
    T_model_column = np.array(report["columns"][1]["T_model_column"])
    foot = T_model_column[:3, 3] / 1000.0
    assert 0.5 < foot[2] - position[2] < 2.0, "metres, below the foot"
    np.testing.assert_allclose(np.cross(direction, foot - position), 0.0, atol=1e-6)
    assert direction @ (foot - position) > 0.0
    assert direction[2] > 0.9
    assert abs(up @ direction) < 1e-9
    assert up @ T_model_column[:3, 1] > 0.9, "y of the column is up"
    assert 45.0 <= float(camera.findtext("FieldOfView")) <= 60.0


def test_a_repeated_run_changes_nothing(report: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path)
    first = path.read_bytes()
    report["capture"]["date"] = "2026-12-24"
    done = write_bcf(typed(report), path, existing=path)
    assert done.unchanged == ("C-301", "C-302")
    assert path.read_bytes() == first
    report["capture"]["date"] = "2026-11-20"
    write_bcf(typed(report), tmp_path / "again.bcf")
    assert (tmp_path / "again.bcf").read_bytes() == first, "the date is the capture's"


def test_a_later_run_updates_closes_and_opens_again(report: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path, written=DAY)
    first, second = guids(path)
    later = copy.deepcopy(report)
    later["columns"][0]["reasons"] = ["S5 is off"]
    later["columns"][1]["verdict"] = "pass"
    later["columns"][1]["reasons"] = []
    later["columns"][2] |= {"verdict": "error", "reasons": ["the scan is missing"]}
    done = write_bcf(typed(later), path, existing=path, written=DAY.replace(day=21))
    assert (done.updated, done.closed, done.opened) == (("C-301",), ("C-302",), ("C-303",))
    assert guids(path)[:2] == [first, second]
    changed = markup(path, first)
    assert [comment.findtext("Comment") for comment in changed.findall("Comment")] == [
        "S1 is off\nS2 not measured: plugged",
        "S5 is off",
    ]
    assert changed.findtext("Topic/CreationDate") == "2026-11-20T00:00:00+00:00"
    assert changed.findtext("Topic/ModifiedDate") == "2026-11-21T00:00:00+00:00"
    closed = markup(path, second)
    assert closed.find("Topic").get("TopicStatus") == "Closed"
    assert "passes now" in closed.findall("Comment")[-1].findtext("Comment")
    assert write_bcf(typed(later), path, existing=path).unchanged == ("C-301", "C-302", "C-303")
    write_bcf(typed(report), path, existing=path, written=DAY.replace(day=22))
    assert markup(path, second).find("Topic").get("TopicStatus") == "Open"
    for guid in guids(path):
        assert_in_order(markup(path, guid), MARKUP)


def test_what_people_wrote_stays(report: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path)
    first, _ = guids(path)
    root = markup(path, first)
    topic = root.find("Topic")
    topic.set("TopicStatus", "In Progress")
    ElementTree.SubElement(topic, "AssignedTo").text = "li@yard.cn"
    ElementTree.SubElement(topic, "Labels").text = "urgent"
    comment = ElementTree.SubElement(root, "Comment", Guid=str(uuid.uuid4()))
    for name, text in (("Date", "2026-11-21T08:00:00Z"), ("Author", "li@yard.cn"), ("Comment", "I shall look at it")):
        ElementTree.SubElement(comment, name).text = text
    foreign = {"0a0a0a0a-1111-4222-8333-444444444444/markup.bcf": b"<Markup><Topic Guid='x'/></Markup>"}
    held = {**files(path), f"{first}/markup.bcf": ElementTree.tostring(root), **foreign}
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in held.items():
            archive.writestr(name, content)
    report["columns"][0]["reasons"] = ["S5 is off"]
    write_bcf(typed(report), path, existing=path)
    after = markup(path, first)
    assert after.find("Topic").get("TopicStatus") == "In Progress"
    assert after.findtext("Topic/AssignedTo") == "li@yard.cn"
    assert "urgent" in [label.text for label in after.findall("Topic/Labels")]
    assert [item.findtext("Author") for item in after.findall("Comment")].count("li@yard.cn") == 1
    assert_in_order(after, MARKUP)
    assert foreign.items() <= files(path).items()


def test_a_pair_that_could_not_be_seen_again_stays_open(report: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(report), path, per="pair")
    report["columns"][0] |= {"verdict": "error", "reasons": ["no scan"], "sleeves": None, "rebars": None}
    done = write_bcf(typed(report), path, per="pair", existing=path)
    assert done.opened == ("C-301",), "nothing to blame but the column"
    assert done.closed == ()
    statuses = [markup(path, guid).find("Topic").get("TopicStatus") for guid in guids(path)]
    assert statuses == ["Open"] * 5


def test_hostile_names_and_columns_without_a_model(report: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    report["job"]["name"] = HOSTILE
    report["model"] = None
    column = report["columns"][0]
    column |= {"id": HOSTILE, "reasons": [HOSTILE], "global_id": None, "T_model_column": None, "size_mm": None}
    for kind in ("sleeves", "rebars"):
        for point in column[kind]["points"]:
            point["global_id"] = None
    write_bcf(typed(report), path)
    topic = markup(path, guids(path)[0])
    assert topic.findtext("Topic/Title").startswith("C'1\"<script>alert(1)</script>\ufffd灌浆😀 =1+1 fails")
    assert_in_order(topic, MARKUP)
    view = ElementTree.fromstring(files(path)[f"{guids(path)[0]}/viewpoint.bcfv"])
    assert_in_order(view, VIEWPOINT)
    assert view.find("Components") is None


def test_a_file_that_is_no_bcf_is_refused(report: dict[str, Any], tmp_path: Path) -> None:
    broken, newer = tmp_path / "broken.bcf", tmp_path / "newer.bcf"
    broken.write_bytes(b"PK but no archive")
    with zipfile.ZipFile(newer, "w") as archive:
        archive.writestr("bcf.version", '<Version VersionId="4.0"/>')
    with pytest.raises(ReportError, match="cannot be read as a BCF file"):
        write_bcf(typed(report), tmp_path / "a.bcf", existing=broken)
    with pytest.raises(ReportError, match=r"is of BCF version 4\.0"):
        write_bcf(typed(report), tmp_path / "a.bcf", existing=newer)
    with zipfile.ZipFile(newer, "w") as archive:
        archive.writestr("bcf.version", '<Version VersionId="2.0"><DetailedVersion>2.0 RC</DetailedVersion></Version>')
        archive.writestr("5a0f/markup.bcf", "<Markup/>")
    with pytest.raises(ReportError, match=r"is of BCF version 2\.0.*save it as one of these"):
        write_bcf(typed(report), tmp_path / "a.bcf", existing=newer)
    assert not (tmp_path / "a.bcf").exists()


def pictures(report: dict[str, Any], path: Path) -> list[np.ndarray]:
    write_bcf(typed(report), path)
    held = [content for name, content in files(path).items() if name.endswith("snapshot.png")]
    return [cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_GRAYSCALE) for content in held]


def test_names_in_chinese_can_be_read_in_the_picture(report: dict[str, Any], tmp_path: Path) -> None:
    """Two signs of a name are two drawings, of about as much ink as letters have; the foot below is the same."""
    drawn = {}
    for name in ("柱-307", "梁-307", "C-307"):
        report["columns"][0] |= {"id": name}
        drawn[name] = pictures(report, tmp_path / f"{len(drawn)}.bcf")[0]
    first, second, letters = drawn.values()
    ink = [int((picture[20:70, 20:56] < 200).sum()) for picture in (first, second, letters)]
    assert np.abs(first[20:70, 20:56].astype(int) - second[20:70, 20:56]).max() > 100
    assert min(ink[:2]) > 0.7 * ink[2] > 0
    assert (first[110:] == second[110:]).all()


def test_a_pair_is_ringed_in_its_own_picture(report: dict[str, Any], tmp_path: Path) -> None:
    write_bcf(typed(report), tmp_path / "pairs.bcf", per="pair")
    held = [content for name, content in files(tmp_path / "pairs.bcf").items() if name.endswith("snapshot.png")]
    found = [cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR)[110:] for content in held]
    blue = [(picture[..., 0].astype(int) - picture[..., 2] > 100).sum() for picture in found]
    assert min(blue) > 200
