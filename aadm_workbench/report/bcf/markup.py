"""markup.bcf: title, status, labels, description and comments of one topic, BCF 2.1.

What people have added to a topic (comments, a responsible person, a due date, their own labels) stays.
"""

from __future__ import annotations

import re
import uuid
import xml.etree.ElementTree as ElementTree
from pathlib import PurePath

from aadm_workbench.model import JobReport, Verdict
from aadm_workbench.report.bcf.findings import Finding
from aadm_workbench.report.bcf.viewpoint import viewpoint_guid
from aadm_workbench.report.column_view import declared_up

AUTHOR = "AADM workbench"
TABLE = "table.csv"
VIEWPOINT = "viewpoint.bcfv"
SNAPSHOT = "snapshot.png"

_OPEN, _CLOSED = "Open", "Closed"
_DONE = {"closed", "resolved", "done"}
_NOT_IN_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_TOPIC_ORDER = (
    "ReferenceLink",
    "Title",
    "Priority",
    "Index",
    "Labels",
    "CreationDate",
    "CreationAuthor",
    "ModifiedDate",
    "ModifiedAuthor",
    "DueDate",
    "AssignedTo",
    "Stage",
    "Description",
    "BimSnippet",
    "DocumentReference",
    "RelatedTopic",
)
_MARKUP_ORDER = ("Header", "Topic", "Comment", "Viewpoints")


def new_markup(report: JobReport, finding: Finding, date: str) -> ElementTree.Element:
    """A topic that was not there before; ``date`` in ISO 8601 with its offset."""
    root = ElementTree.Element("Markup")
    if report.model is not None:
        source = str(report.model["source"])
        file = ElementTree.SubElement(ElementTree.SubElement(root, "Header"), "File", isExternal="true")
        _put(file, "Filename", PurePath(source.replace("\\", "/")).name)
        _put(file, "Reference", source)
    topic = ElementTree.SubElement(root, "Topic", Guid=finding.guid)
    _put(topic, "CreationDate", date)
    _put(topic, "CreationAuthor", AUTHOR)
    document = ElementTree.SubElement(topic, "DocumentReference", Guid=_guid(finding, TABLE), isExternal="false")
    _put(document, "ReferencedDocument", TABLE)
    _put(document, "Description", "Every number of this column with its limit, clause and verdict")
    view = ElementTree.SubElement(root, "Viewpoints", Guid=viewpoint_guid(finding))
    _put(view, "Viewpoint", VIEWPOINT)
    _put(view, "Snapshot", SNAPSHOT)
    write_finding(root, report, finding, date)
    return root


def write_finding(root: ElementTree.Element, report: JobReport, finding: Finding, date: str) -> None:
    """Put this report's finding into a topic; a finding that a comment holds already is not repeated."""
    topic = _topic(root)
    status = topic.get("TopicStatus", "")
    if not status or status.lower() in _DONE:
        topic.set("TopicStatus", _OPEN)
    topic.set("TopicType", "Issue" if finding.verdict is Verdict.FAIL else "Request")
    _put(topic, "Title", finding.title)
    _put(topic, "Priority", "High" if finding.verdict is Verdict.FAIL else "Normal")
    _put(topic, "Description", _description(report, finding))
    _labels(topic, finding)
    _comment(root, finding, _said(finding), date, viewpoint=True)
    _in_order(root)


def close(root: ElementTree.Element, finding: Finding, report: JobReport, date: str) -> bool:
    """Close the topic of what passes now; False where it was closed already."""
    topic = _topic(root)
    if topic.get("TopicStatus", "").lower() == _CLOSED.lower():
        return False
    topic.set("TopicStatus", _CLOSED)
    _put(topic, "Title", finding.title)
    said = f"{finding.name} passes now (job {report.job['name']}, {str(report.job['sha256'])[:12]})."
    _comment(root, finding, said, date, viewpoint=False)
    stamp(root, date)
    return True


def stamp(root: ElementTree.Element, date: str) -> None:
    """Write down when this program changed the topic."""
    topic = _topic(root)
    _put(topic, "ModifiedDate", date)
    _put(topic, "ModifiedAuthor", AUTHOR)
    _in_order(root)


def markup_bytes(root: ElementTree.Element) -> bytes:
    """The file."""
    ElementTree.indent(root)
    written: bytes = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
    return written


def xml_text(text: str) -> str:
    """A text with the signs that XML 1.0 cannot hold replaced."""
    return _NOT_IN_XML.sub("\ufffd", text)


def _description(report: JobReport, finding: Finding) -> str:
    column = finding.column
    places = [f"{name} {place}" for name, place in (("storey", column.storey), ("grid", column.grid)) if place]
    said = [
        f"Column {column.id}" + (f" ({', '.join(places)})" if places else ""),
        f"Goes on its bars: {column.goes_on.replace('_', ' ')}",
        f"Tolerances: {report.profile.title or report.profile.name}",
    ]
    said += [f"Scan of the {kind.plural}: {group.source}" for kind, group in column.groups.items()]
    said += [f"Also: {one.text}" for one in column.findings if not one.holds_back]
    return "\n".join(said)


def _said(finding: Finding) -> str:
    """The comment: every reason, and the advice where the trial assembly did not pass."""
    repair = finding.column.repair
    advice = [f"Advice: {repair.advice}"] if repair else []
    up = declared_up(finding.column)
    declared = [f"As declared: {up}"] if up is not None and (finding.reasons or advice) else []
    return "\n".join([*finding.reasons, *advice, *declared]) or finding.title


def _comment(root: ElementTree.Element, finding: Finding, said: str, date: str, *, viewpoint: bool) -> None:
    own = [comment for comment in root.findall("Comment") if comment.findtext("Author") == AUTHOR]
    if own and own[-1].findtext("Comment") == xml_text(said):
        return
    comment = ElementTree.SubElement(root, "Comment", Guid=_guid(finding, f"comment {len(own)}"))
    _put(comment, "Date", date)
    _put(comment, "Author", AUTHOR)
    _put(comment, "Comment", said)
    if viewpoint:
        ElementTree.SubElement(comment, "Viewpoint", Guid=viewpoint_guid(finding))


def _labels(topic: ElementTree.Element, finding: Finding) -> None:
    """Labels that the report gives; those of people stay, those of an earlier verdict go."""
    of_verdicts = {verdict.value.replace("_", " ") for verdict in Verdict}
    for element in topic.findall("Labels"):
        if element.text in of_verdicts or element.text in finding.labels:
            topic.remove(element)
    for label in finding.labels:
        ElementTree.SubElement(topic, "Labels").text = xml_text(label)


def _topic(root: ElementTree.Element) -> ElementTree.Element:
    topic = root.find("Topic")
    assert topic is not None, "a markup without a topic is not taken for one of ours"
    return topic


def _put(parent: ElementTree.Element, name: str, text: str) -> None:
    element = parent.find(name)
    if element is None:
        element = ElementTree.SubElement(parent, name)
    element.text = xml_text(text)


def _in_order(root: ElementTree.Element) -> None:
    """The schema is a sequence; what it does not know stays at the end."""
    for parent, order in ((root, _MARKUP_ORDER), (_topic(root), _TOPIC_ORDER)):
        rank = {name: place for place, name in enumerate(order)}
        parent[:] = sorted(parent, key=lambda element: rank.get(element.tag, len(rank)))


def _guid(finding: Finding, what: str) -> str:
    return str(uuid.uuid5(uuid.UUID(finding.guid), what))
