"""markup.bcf: title, status, labels, description and comments of one topic.

What people have added to a topic (comments, a responsible person, a due date, their own labels) stays, and so does a
title, a priority or a description that they have changed.
"""

from __future__ import annotations

import re
import uuid
import xml.etree.ElementTree as ElementTree
from pathlib import PurePath

from aadm_workbench.model import JobReport, Verdict
from aadm_workbench.report.bcf import said as words
from aadm_workbench.report.bcf.findings import Finding
from aadm_workbench.report.bcf.forms import Form, put, topic_of, xml_text
from aadm_workbench.report.words.labels import Language, phrase

AUTHOR = "AADM workbench"
TABLE = "table.csv"
VIEWPOINT = "viewpoint.bcfv"
SNAPSHOT = "snapshot.png"

_OPEN, _CLOSED = "Open", "Closed"
TYPES = ("Issue", "Request")
PRIORITIES = ("High", "Normal")
"""Of what fails, and of all else."""
_DONE = {"closed", "resolved", "done"}
_IFC_GUID = re.compile("[0-3][0-9A-Za-z_$]{21}")


def new_markup(report: JobReport, finding: Finding, date: str, form: Form, language: Language) -> ElementTree.Element:
    """A topic that was not there before; ``date`` in ISO 8601 with its offset."""
    root = ElementTree.Element("Markup")
    if report.model is not None:
        source = str(report.model["source"])
        project = report.model.get("ifc_project", "")
        name = PurePath(source.replace("\\", "/")).name
        form.add_file(root, name, source, project if _IFC_GUID.fullmatch(project) else "")
    topic = ElementTree.SubElement(root, "Topic", Guid=finding.guid)
    put(topic, "CreationDate", date)
    put(topic, "CreationAuthor", AUTHOR)
    form.add_table(root, table_guid(finding), TABLE, phrase("bcf.table").in_language(language))
    return root


def write_finding(
    root: ElementTree.Element,
    report: JobReport,
    finding: Finding,
    date: str,
    form: Form,
    language: Language,
    view_guid: str,
) -> None:
    """Put this report's finding into a topic; a finding that a comment holds already is not repeated."""
    topic = topic_of(root)
    status = topic.get("TopicStatus", "")
    if not status or status.lower() in _DONE:
        topic.set("TopicStatus", _OPEN)
    failed = finding.verdict is Verdict.FAIL
    _title(root, finding, form, language)
    if topic.findtext("Priority") in (None, _priority_of(topic.get("TopicType"))):
        put(topic, "Priority", PRIORITIES[0 if failed else 1])
    topic.set("TopicType", TYPES[0 if failed else 1])
    if words.is_own_description(topic.findtext("Description") or ""):
        put(topic, "Description", words.description_of(finding, report, language))
    _labels(root, finding, form)
    _viewpoint(root, form, view_guid)
    said = [words.comment_of(finding, one) for one in words.LANGUAGES]
    _comment(root, finding, said, date, form, language, view_guid)
    form.in_order(root)


def close(
    root: ElementTree.Element, finding: Finding, report: JobReport, date: str, form: Form, language: Language
) -> bool:
    """Close the topic of what passes now; False where it was closed already."""
    topic = topic_of(root)
    if topic.get("TopicStatus", "").lower() == _CLOSED.lower():
        return False
    topic.set("TopicStatus", _CLOSED)
    _title(root, finding, form, language)
    said = [words.closing_of(finding, report, one) for one in words.LANGUAGES]
    _comment(root, finding, said, date, form, language)
    stamp(root, date, form)
    return True


def stamp(root: ElementTree.Element, date: str, form: Form) -> None:
    """Write down when this program changed the topic."""
    topic = topic_of(root)
    put(topic, "ModifiedDate", date)
    put(topic, "ModifiedAuthor", AUTHOR)
    form.in_order(root)


def table_guid(finding: Finding) -> str:
    """The GUID of a topic's table: the same in every run."""
    return _guid(finding, TABLE)


def _title(root: ElementTree.Element, finding: Finding, form: Form, language: Language) -> None:
    """A title of ours; one that a person gave stays."""
    topic = topic_of(root)
    before = topic.findtext("Title")
    own = [comment.findtext("Comment") or "" for comment in _own_comments(root, form)]
    if before is None or before in map(xml_text, words.own_titles(finding, own)):
        put(topic, "Title", words.title_of(finding, language))


def _priority_of(topic_type: str | None) -> str:
    """What this program gave a topic of that type."""
    return PRIORITIES[TYPES.index(topic_type)] if topic_type in TYPES else ""


def _viewpoint(root: ElementTree.Element, form: Form, view_guid: str) -> None:
    """The entry of viewpoint and picture; where these have changed, comments go on to lead to them."""
    entry = next((one for one in form.viewpoints(root) if one.findtext("Viewpoint") == VIEWPOINT), None)
    if entry is None:
        entry = form.new_viewpoint(root, view_guid)
        put(entry, "Viewpoint", VIEWPOINT)
        put(entry, "Snapshot", SNAPSHOT)
    before = entry.get("Guid", "")
    entry.set("Guid", view_guid)
    for comment in form.comments(root):
        shown = comment.find("Viewpoint")
        if shown is not None and shown.get("Guid") == before:
            shown.set("Guid", view_guid)


def _own_comments(root: ElementTree.Element, form: Form) -> list[ElementTree.Element]:
    return [comment for comment in form.comments(root) if comment.findtext("Author") == AUTHOR]


def _comment(
    root: ElementTree.Element,
    finding: Finding,
    said: list[str],
    date: str,
    form: Form,
    language: Language,
    view_guid: str = "",
) -> None:
    """One more comment, unless the last one of ours says the same, in whichever language."""
    own = _own_comments(root, form)
    if own and (own[-1].findtext("Comment") or "") in map(xml_text, said):
        return
    text = said[words.LANGUAGES.index(language)]
    comment = form.new_comment(root, _new_guid(root, finding, f"comment {date} {text}", form))
    put(comment, "Date", date)
    put(comment, "Author", AUTHOR)
    put(comment, "Comment", text)
    if view_guid:
        ElementTree.SubElement(comment, "Viewpoint", Guid=view_guid)


def _new_guid(root: ElementTree.Element, finding: Finding, what: str, form: Form) -> str:
    """A GUID that no comment of the topic has: people delete comments, and the next one is another all the same."""
    known = {comment.get("Guid") for comment in form.comments(root)}
    number = 0
    while (guid := _guid(finding, f"{what} {number}")) in known:
        number += 1
    return guid


def _labels(root: ElementTree.Element, finding: Finding, form: Form) -> None:
    """Labels that the report gives; those of people stay, those of an earlier verdict go."""
    of_verdicts = {verdict.value.replace("_", " ") for verdict in Verdict}
    kept = [label for label in form.labels(root) if label not in of_verdicts and label not in finding.labels]
    form.set_labels(root, [*kept, *finding.labels])


def _guid(finding: Finding, what: str) -> str:
    return str(uuid.uuid5(uuid.UUID(finding.guid), what))
