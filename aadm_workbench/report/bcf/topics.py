"""BCF: a topic per column that is not a pass, for the BIM coordinator's viewer; versions 2.1 and 3.0.

A topic keeps its GUID over all runs, so that a later report updates it, and closes it once the column passes. What
people have written into an earlier file stays: their comments, their topics, whom they made responsible.
"""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal

from aadm_workbench.errors import ReportError
from aadm_workbench.model import JobReport
from aadm_workbench.own_files import write_atomically
from aadm_workbench.report.bcf import markup as bcf_markup
from aadm_workbench.report.bcf.container import (
    MARKUP,
    document_place,
    new_files,
    packed,
    put_document,
    read_files,
    read_markup,
    with_words,
)
from aadm_workbench.report.bcf.findings import Finding, findings
from aadm_workbench.report.bcf.forms import Form, Version, xml_bytes
from aadm_workbench.report.bcf.viewpoint import viewpoint_bytes, viewpoint_guid
from aadm_workbench.report.sheets.csv import csv_content
from aadm_workbench.report.words.labels import Language


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
    version: Version | None = None,
    language: Language = "en",
) -> BcfOutcome:
    """Write the topics of a report as a BCF file.

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
    version
        Of BCF; by default that of ``existing``, 2.1 for a new file.
    language
        Of titles, comments and pictures.

    Raises
    ------
    ReportError
        Where ``existing`` is no BCF file of that version, or a topic of it is none.
    AadmError
        Where the file cannot be written.
    """
    if per not in ("column", "pair"):
        raise ReportError.because("report.bcf_per", per=per)
    date = (written or _capture_date(report)).astimezone(UTC).isoformat(timespec="seconds")
    files, form = _begun(report, existing, version)
    writer = _Writer(report, files, form, language, date)
    done: dict[str, list[str]] = {"opened": [], "updated": [], "closed": [], "unchanged": []}
    for finding in findings(report, per):
        outcome = writer.apply(finding, (snapshots or {}).get(finding.column.id))
        if outcome:
            done[outcome].append(finding.name)
    writer.finish()
    write_atomically(path, packed(files))
    return BcfOutcome(**{name: tuple(names) for name, names in done.items()})


def _begun(report: JobReport, existing: Path | None, version: Version | None) -> tuple[dict[str, bytes], Form]:
    """The files to go on from."""
    if existing is None:
        return new_files(report, version or "2.1"), Form(version or "2.1")
    files, form = read_files(existing)
    if version is not None and version != form.version:
        raise ReportError.about(existing, "report.bcf_two", found=form.version, asked=version)
    return files, form


class _Writer:
    """Puts findings into the files of one BCF file."""

    def __init__(self, report: JobReport, files: dict[str, bytes], form: Form, language: Language, date: str) -> None:
        self.report, self.files, self.form, self.date = report, files, form, date
        self.language: Language = language
        self._labels: dict[str, None] = {}

    def apply(self, finding: Finding, picture: bytes | None) -> str | None:
        """Put one finding into the files; how its topic came out, or None where it has none."""
        place = f"{finding.guid}/{MARKUP}"
        was_there = place in self.files
        if not finding.is_open and not (was_there and finding.verdict == "pass"):
            return None
        root = read_markup(self.files[place], place) if was_there else None
        if not finding.is_open:
            assert root is not None, "a pass makes no topic"
            return self._close(root, finding, place)
        return self._open(root, finding, place, picture)

    def _close(self, root: ElementTree.Element, finding: Finding, place: str) -> str:
        if not bcf_markup.close(root, finding, self.report, self.date, self.form, self.language):
            return "unchanged"
        self.files[place] = xml_bytes(root)
        return "closed"

    def _open(self, root: ElementTree.Element | None, finding: Finding, place: str, picture: bytes | None) -> str:
        """Write a topic, new or not; what has not changed stays as it is, byte for byte."""
        was_there = root is not None
        if root is None:
            root = bcf_markup.new_markup(self.report, finding, self.date, self.form, self.language)
        before = xml_bytes(root)
        attached, view_guid = self._attached(finding, picture)
        bcf_markup.write_finding(root, self.report, finding, self.date, self.form, self.language, view_guid)
        self._labels |= dict.fromkeys(finding.labels)
        same = all(self.files.get(name) == held for name, held in attached.items())
        if was_there and same and xml_bytes(root) == before:
            return "unchanged"
        if was_there:
            bcf_markup.stamp(root, self.date, self.form)
        self.files |= {place: xml_bytes(root), **attached}
        if self.form.is_3:
            guid = bcf_markup.table_guid(finding)
            put_document(self.files, guid, f"{finding.name}.csv", self.files[document_place(guid)])
        return "updated" if was_there else "opened"

    def _attached(self, finding: Finding, picture: bytes | None) -> tuple[dict[str, bytes], str]:
        """The files of a topic beside its markup, and the GUID of its viewpoint."""
        # What draws a picture takes longer to import than everything else here takes to run.
        from aadm_workbench.report.bcf.snapshot import foot_picture

        picture = picture or foot_picture(finding, self.language)
        view_guid = viewpoint_guid(finding, self.form, picture)
        table = csv_content(self.report, [finding.column])
        at = document_place(bcf_markup.table_guid(finding)) if self.form.is_3 else f"{finding.guid}/{bcf_markup.TABLE}"
        files = {
            f"{finding.guid}/{bcf_markup.VIEWPOINT}": viewpoint_bytes(finding, self.form, view_guid),
            f"{finding.guid}/{bcf_markup.SNAPSHOT}": picture,
            at: table,
        }
        return files, view_guid

    def finish(self) -> None:
        """What belongs to no topic."""
        if self.form.is_3:
            with_words(self.files, self._labels)


def _capture_date(report: JobReport) -> datetime:
    """The day of the capture, so that the same report gives the same file; else now."""
    try:
        taken = datetime.fromisoformat(report.capture.get("date", ""))
    except ValueError:
        return datetime.now(tz=UTC)
    return taken if taken.tzinfo else taken.replace(tzinfo=UTC)
