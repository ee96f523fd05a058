"""BCF 2.1: a topic per column that is not a pass, for the BIM coordinator's viewer.

A topic keeps its GUID over all runs, so that a later report updates it, and closes it once the column passes. What
people have written into an earlier file stays: their comments, their topics, whom they made responsible.
"""

from __future__ import annotations

import io
import uuid
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal

from aadm_workbench.atomic import write_atomically
from aadm_workbench.bounded import ArchiveBounds, BoundsError, check_xml, entry_bytes, opened_archive
from aadm_workbench.errors import ReportError
from aadm_workbench.model import JobReport
from aadm_workbench.report.bcf import markup as bcf_markup
from aadm_workbench.report.bcf.findings import Finding, findings
from aadm_workbench.report.bcf.viewpoint import viewpoint
from aadm_workbench.report.sheets.csv import csv_content

_VERSION = (
    b"<?xml version='1.0' encoding='utf-8'?>\n"
    b'<Version VersionId="2.1"><DetailedVersion>2.1</DetailedVersion></Version>\n'
)
_PROJECTS = uuid.UUID("0f6f7f3c-1f7e-5d8d-9f43-6a1d3a6f2b57")
_MARKUP = "markup.bcf"
_ZIP_EPOCH = (1980, 1, 1, 0, 0, 0)  # the first date that a ZIP file knows: the same report gives the same bytes

BCF_BOUNDS = ArchiveBounds("BCF file", entries=20_000, entry_bytes=2**26, all_bytes=2**28)
"""A thousand topics with pictures of 150 KB and five files each are half of this."""

_SHOWN = 40  # characters of a name in a message
_DEEPEST_XML = 64
"""Markup has six levels; what other programs add to it may have some more."""

_MOST_ELEMENTS = 200_000
"""A topic with ten thousand comments has half as many."""


@dataclass(frozen=True)
class BcfOutcome:
    """Names of what has a topic that was opened, that changed, that was closed, and that stayed as it was."""

    opened: tuple[str, ...]
    updated: tuple[str, ...]
    closed: tuple[str, ...]
    unchanged: tuple[str, ...]


def write_bcf(
    report: JobReport,
    path: Path,
    *,
    existing: Path | None = None,
    per: Literal["column", "pair"] = "column",
    snapshots: Mapping[str, bytes] | None = None,
    written: datetime | None = None,
) -> BcfOutcome:
    """Write the topics of a report as a BCF 2.1 file.

    Parameters
    ----------
    report
        report.json, schema 1.
    path
        The .bcf file; replaced as a whole or not at all.
    existing
        An earlier file to go on from; it may be ``path`` itself. A topic that says the same as before stays, byte for
        byte.
    per
        A topic for each column that is not a pass, or for each of its pairs.
    snapshots
        Pictures (PNG) by column id instead of the drawn plan of the foot.
    written
        When the topics were written; by default the date of the capture, else now.

    Raises
    ------
    ReportError
        Where ``existing`` is no BCF file of version 2.1.
    AadmError
        Where the file cannot be written.
    """
    if per not in ("column", "pair"):
        raise ReportError(f"topics can be made per column or per pair, not per {per}")
    date = (written or _capture_date(report)).astimezone(UTC).isoformat(timespec="seconds")
    files = {"bcf.version": _VERSION, "project.bcfp": _project(report)} if existing is None else _files(existing)
    done: dict[str, list[str]] = {"opened": [], "updated": [], "closed": [], "unchanged": []}
    for finding in findings(report, per):
        outcome = _apply(files, report, finding, date, (snapshots or {}).get(finding.column.id))
        if outcome:
            done[outcome].append(finding.name)
    write_atomically(path, _zip(files))
    return BcfOutcome(**{name: tuple(names) for name, names in done.items()})


def _apply(
    files: dict[str, bytes], report: JobReport, finding: Finding, date: str, picture: bytes | None
) -> str | None:
    """Put one finding into the files; how its topic came out, or None where it has none."""
    place = f"{finding.guid}/{_MARKUP}"
    was_there = place in files
    if not finding.is_open and not (was_there and finding.verdict == "pass"):
        return None
    root = _markup(files[place], place) if was_there else bcf_markup.new_markup(report, finding, date)
    if not finding.is_open:
        closed = bcf_markup.close(root, finding, report, date)
        if closed:
            files[place] = bcf_markup.markup_bytes(root)
        return "closed" if closed else "unchanged"
    before = bcf_markup.markup_bytes(root)
    bcf_markup.write_finding(root, report, finding, date)
    attached = _attachments(report, finding, picture)
    changed = bcf_markup.markup_bytes(root) != before or any(files.get(name) != attached[name] for name in attached)
    if was_there and not changed:
        return "unchanged"
    if was_there:
        bcf_markup.stamp(root, date)
    files.update({place: bcf_markup.markup_bytes(root), **attached})
    return "updated" if was_there else "opened"


def _attachments(report: JobReport, finding: Finding, picture: bytes | None) -> dict[str, bytes]:
    """The files of a topic's folder beside its markup."""
    # OpenCV takes longer to import than everything else here takes to run.
    from aadm_workbench.report.bcf.snapshot import foot_picture

    content = {
        bcf_markup.VIEWPOINT: viewpoint(finding),
        bcf_markup.SNAPSHOT: picture or foot_picture(finding),
        bcf_markup.TABLE: csv_content(report, [finding.column]),
    }
    return {f"{finding.guid}/{name}": held for name, held in content.items()}


def _project(report: JobReport) -> bytes:
    name = bcf_markup.xml_text(str(report.job["name"]))
    root = ElementTree.Element("ProjectExtension")
    project = ElementTree.SubElement(root, "Project", ProjectId=str(uuid.uuid5(_PROJECTS, name)))
    ElementTree.SubElement(project, "Name").text = name
    ElementTree.SubElement(root, "ExtensionSchema")
    written: bytes = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
    return written


def _capture_date(report: JobReport) -> datetime:
    """The day of the capture, so that the same report gives the same file; else now."""
    try:
        taken = datetime.fromisoformat(report.capture.get("date", ""))
    except ValueError:
        return datetime.now(tz=UTC)
    return taken if taken.tzinfo else taken.replace(tzinfo=UTC)


def _files(path: Path) -> dict[str, bytes]:
    """The content of an earlier file, in its order."""
    try:
        with opened_archive(path, BCF_BOUNDS) as archive:
            files = {entry.filename: entry_bytes(archive, entry) for entry in archive.infolist() if not entry.is_dir()}
    except (OSError, BoundsError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ReportError(
            f"{path}: cannot be read as a BCF file ({reason}); name another, or start without it"
        ) from error
    version = _parsed(files["bcf.version"], f"{path}: bcf.version") if "bcf.version" in files else None
    found = version.get("VersionId", "") if version is not None else "no"
    if found != "2.1":
        raise ReportError(
            f"{path}: is of BCF version {found}, but topics of 2.1 are written, and no file holds both; save it as BCF "
            "2.1 in the program that it comes from, or start a new file"
        )
    return files


def _markup(content: bytes, place: str) -> ElementTree.Element:
    root = _parsed(content, place)
    if root.tag != "Markup":
        raise ReportError(f"{place} is no markup of a topic, but <{root.tag[:_SHOWN]}>; start a new BCF file")
    return root


def _parsed(content: bytes, place: str) -> ElementTree.Element:
    try:
        check_xml(content, deepest=_DEEPEST_XML, most_elements=_MOST_ELEMENTS)
        return ElementTree.fromstring(content)
    except (BoundsError, ElementTree.ParseError) as error:
        reason = str(error) if isinstance(error, BoundsError) else f"is no XML ({error})"
        raise ReportError(f"{place} {reason}; start a new BCF file") from error


def _zip(files: Mapping[str, bytes]) -> bytes:
    """An archive with the same bytes for the same files."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        for name, held in files.items():
            entry = zipfile.ZipInfo(name, _ZIP_EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, held)
    return content.getvalue()
