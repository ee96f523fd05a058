"""The files of a BCF file that belong to no topic: version, project, extensions, documents; reading and packing it."""

from __future__ import annotations

import io
import uuid
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Iterable, Mapping
from pathlib import Path

from aadm_workbench.bounded import ArchiveBounds, BoundsError, check_xml, entry_bytes, opened_archive
from aadm_workbench.errors import ReportError
from aadm_workbench.model import JobReport, Reason
from aadm_workbench.report.bcf.forms import VERSIONS, Form, Version, put, xml_bytes, xml_text
from aadm_workbench.report.bcf.markup import AUTHOR, PRIORITIES, TYPES

MARKUP = "markup.bcf"
_DOCUMENTS = "documents.xml"
_PROJECTS = uuid.UUID("0f6f7f3c-1f7e-5d8d-9f43-6a1d3a6f2b57")
_ZIP_EPOCH = (1980, 1, 1, 0, 0, 0)  # the first date that a ZIP file knows: the same report gives the same bytes

BCF_BOUNDS = ArchiveBounds("BCF file", entries=20_000, entry_bytes=2**26, all_bytes=2**28)
"""A thousand topics with pictures of 30 KB and five files each are a fifth of this."""

_SHOWN = 40  # characters of a name in a message
_DEEPEST_XML = 64
"""Markup has six levels; what other programs add to it may have some more."""

_MOST_ELEMENTS = 200_000
"""A topic with ten thousand comments has half as many."""


def new_files(report: JobReport, version: Version) -> dict[str, bytes]:
    """A file without topics."""
    root = ElementTree.Element("Version", VersionId=version)
    files = {}
    if version == "2.1":
        ElementTree.SubElement(root, "DetailedVersion").text = version
    files["bcf.version"] = xml_bytes(root, indent=False)
    files["project.bcfp"] = _project(report, version)
    if version == "3.0":
        files["extensions.xml"] = _extensions((), AUTHOR)
    return files


def _project(report: JobReport, version: Version) -> bytes:
    name = xml_text(str(report.job["name"]))
    root = ElementTree.Element("ProjectExtension" if version == "2.1" else "ProjectInfo")
    project = ElementTree.SubElement(root, "Project", ProjectId=str(uuid.uuid5(_PROJECTS, name)))
    if name.strip():
        ElementTree.SubElement(project, "Name").text = name
    if version == "2.1":
        ElementTree.SubElement(root, "ExtensionSchema")
    return xml_bytes(root, indent=False)


def _extensions(labels: Iterable[str], *users: str) -> bytes:
    """The words that topics may have."""
    root = ElementTree.Element("Extensions")
    lists = {
        "TopicTypes": TYPES,
        "TopicStatuses": ("Open", "Closed"),
        "Priorities": PRIORITIES,
        "TopicLabels": labels,
        "Users": users,
        "SnippetTypes": (),
        "Stages": (),
    }
    for name, held in lists.items():
        parent = ElementTree.SubElement(root, name)
        for text in held:
            ElementTree.SubElement(parent, _ONE[name]).text = xml_text(text)
    return xml_bytes(root)


_ONE = {
    "TopicTypes": "TopicType",
    "TopicStatuses": "TopicStatus",
    "Priorities": "Priority",
    "TopicLabels": "TopicLabel",
    "Users": "User",
    "SnippetTypes": "SnippetType",
    "Stages": "Stage",
}
"""What is in each list of extensions.xml."""


def with_words(files: dict[str, bytes], labels: Iterable[str]) -> None:
    """Make sure that extensions.xml (3.0) has the words that the topics of this report use; others stay."""
    name = "extensions.xml"
    root = parsed(files[name], name) if name in files else parsed(_extensions(()), name)
    before = ElementTree.tostring(root)
    wanted = {
        "TopicTypes": TYPES,
        "TopicStatuses": ("Open", "Closed"),
        "Priorities": PRIORITIES,
        "TopicLabels": labels,
        "Users": (AUTHOR,),
    }
    for many, texts in wanted.items():
        parent = root.find(many)
        if parent is None:
            continue
        known = {element.text for element in parent}
        for text in dict.fromkeys(map(xml_text, texts)):
            if text not in known and text.strip():
                ElementTree.SubElement(parent, _ONE[many]).text = text
    if name not in files or ElementTree.tostring(root) != before:
        files[name] = xml_bytes(root)


def put_document(files: dict[str, bytes], guid: str, name: str, content: bytes) -> None:
    """A document of the whole file (3.0): listed by its GUID, which is also its name in the file."""
    files[document_place(guid)] = content
    empty = b"<DocumentInfo><Documents/></DocumentInfo>"
    root = parsed(files.get(_DOCUMENTS, empty), _DOCUMENTS)
    parent = root.find("Documents")
    if parent is None:
        parent = ElementTree.SubElement(root, "Documents")
    if all(document.get("Guid") != guid for document in parent):
        put(ElementTree.SubElement(parent, "Document", Guid=guid), "Filename", name)
        files[_DOCUMENTS] = xml_bytes(root)


def document_place(guid: str) -> str:
    """Where a document lies (3.0)."""
    return f"documents/{guid}"


def read_files(path: Path) -> tuple[dict[str, bytes], Form]:
    """The content of an earlier file, in its order, and its version.

    Raises
    ------
    ReportError
        Where it is no BCF file, or one of a version that is not written here.
    """
    try:
        with opened_archive(path, BCF_BOUNDS) as archive:
            files = {entry.filename: entry_bytes(archive, entry) for entry in archive.infolist() if not entry.is_dir()}
    except (OSError, BoundsError) as error:
        raise ReportError.about(path, "report.bcf_unread", why=getattr(error, "strerror", None) or error) from error
    root = parsed(files["bcf.version"], f"{path}: bcf.version") if "bcf.version" in files else None
    found = root.get("VersionId", "") if root is not None else "no"
    for version in VERSIONS:
        if found == version:
            return files, Form(version)
    raise ReportError.about(path, "report.bcf_version", found=found[:_SHOWN], known=VERSIONS)


def read_markup(content: bytes, place: str) -> ElementTree.Element:
    """A topic's markup.

    Raises
    ------
    ReportError
        Where it is none, or has no topic.
    """
    root = parsed(content, place)
    if root.tag != "Markup":
        raise ReportError.because("report.bcf_no_markup", place=place, tag=root.tag[:_SHOWN])
    if root.find("Topic") is None:
        raise ReportError.because("report.bcf_no_topic", place=place)
    return root


def parsed(content: bytes, place: str) -> ElementTree.Element:
    """XML of others, within bounds.

    Raises
    ------
    ReportError
        Where it is none, or beyond the bounds.
    """
    try:
        check_xml(content, deepest=_DEEPEST_XML, most_elements=_MOST_ELEMENTS)
        return ElementTree.fromstring(content)
    except (BoundsError, ElementTree.ParseError) as error:
        reason = error if isinstance(error, BoundsError) else Reason("bounded.no_xml", why=error)
        raise ReportError.because("report.bcf_xml", place=place, why=reason) from error


def packed(files: Mapping[str, bytes]) -> bytes:
    """An archive with the same bytes for the same files."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        for name, held in files.items():
            entry = zipfile.ZipInfo(name, _ZIP_EPOCH)
            # Pictures are packed already.
            entry.compress_type = zipfile.ZIP_STORED if name.endswith(".png") else zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, held)
    return content.getvalue()
