"""Which reports can be made from report.json, and how: what ``aadm report`` and ``aadm check`` have in common."""

from __future__ import annotations

import argparse
import gc
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from aadm_workbench.errors import AadmError
from aadm_workbench.own_files import is_there

if TYPE_CHECKING:
    from aadm_workbench.model import JobReport
    from aadm_workbench.model.reason import Language
    from aadm_workbench.report.bcf.forms import Version
    from aadm_workbench.report.tower import TowerShown

    from .tower_plan import Tower

FORMATS = {
    "html": ("report.html", "one page to read in a browser, offline; prints well"),
    "pdf": ("report.pdf", "the same on A4, to sign and to file"),
    "xlsx": ("report.xlsx", "a workbook with a sheet for each question"),
    "csv": ("report.csv", "all values with their limits, a line each"),
    "bcf": ("report.bcf", "a BCF topic for each column that is not a pass"),
    "bcf_pairs": ("report-pairs.bcf", "the same with a topic for each pair of sleeve and bar"),
    "crew": ("crew.pdf", "a page for the crew for each column: what to do"),
    "scan_card": ("scan-card.pdf", "a card for each column: how to scan it"),
    "fcstd": ("report.FCStd", "a FreeCAD document with the results on the columns"),
}
"""By the name of their switch: file, and what it is."""

_YOUNG_OBJECTS = 20_000
"""Python looks for cycles whenever it has made so many objects, by itself 700. Rows and texts of reports hold none: the
looking is a tenth of the processor time of a thousand columns, a fifth of that of HTML."""

SETTING_OUT = "setting-out.csv"
"""Beside report.csv of a job with [stack]: where the next storey will find its bars."""

_PACKAGES = {
    "html": ("jinja2", "fonttools"),
    "pdf": ("reportlab",),
    "xlsx": ("xlsxwriter",),
    "bcf": ("reportlab", "pypdfium2"),
    "bcf_pairs": ("reportlab", "pypdfium2"),
    "crew": ("reportlab",),
    "scan_card": ("reportlab",),
}


def add_format_switches(parser: argparse.ArgumentParser, *, also: str = "") -> None:
    """``--html`` to ``--scan-card``, and the language; ``also`` begins what is said of each."""
    for name, (file, what) in FORMATS.items():
        switch = f"--{name.replace('_', '-')}"
        parser.add_argument(switch, action="store_true", help=f"{also}DIR/{file}: {what}")
    parser.add_argument(
        "--language",
        choices=("en", "zh"),
        metavar="LANGUAGE",
        help="en or zh: of reports and messages "
        "(default: en, messages as the environment has it; crew pages and scan cards have both, Chinese first)",
    )
    parser.add_argument(
        "--bcf-version",
        choices=("2.1", "3.0"),
        metavar="VERSION",
        help="2.1 or 3.0: of BCF files (default: that of the file that is there, 2.1 for a new one)",
    )


def chosen_formats(options: argparse.Namespace) -> tuple[str, ...]:
    """The formats that were asked for."""
    return tuple(name for name in FORMATS if getattr(options, name))


def require_packages(formats: Sequence[str]) -> None:
    """Make sure that what the formats need is installed, before a night's work and not after it.

    Raises
    ------
    MissingDependencyError
        Naming the first package that is missing.
    """
    from aadm_workbench.errors import MissingDependencyError, package_called

    for name in formats:
        for package in map(package_called, _PACKAGES.get(name, ())):
            if find_spec(package.module) is None:
                raise MissingDependencyError(package.pip_name, FORMATS[name][0])


@dataclass(frozen=True)
class HowReports:
    """In which language reports are made, and of which version a BCF file; None for what each has by itself.

    ``tower`` is that of a job with [stack]; None where nobody knows more of it than the report.
    """

    language: Language | None = None
    bcf_version: Version | None = None
    tower: Tower | None = None

    @classmethod
    def asked(cls, options: argparse.Namespace, tower: Tower) -> HowReports:
        """As the switches say."""
        return cls(options.language, options.bcf_version, tower)


@dataclass(frozen=True)
class Written:
    """The files that were written, and what kept others from it, by the names of their formats."""

    files: dict[str, Path]
    failed: dict[str, Exception]

    def say(self, options: argparse.Namespace) -> None:
        """Tell of each format that failed, on stderr."""
        from .shown.terminal import say

        for name, error in self.failed.items():
            known = isinstance(error, AadmError)
            from .shown.told import told

            said = told(error, options) if known else f"{FORMATS[name][0]}: {type(error).__name__}: {error}"
            say(f"aadm: {said}")
            if options.debug and not known:
                say("".join(traceback.format_exception(error)))


def write_reports(report: JobReport, formats: Sequence[str], folder: Path, how: HowReports | None = None) -> Written:
    """Write reports into a folder, one after the other; one that fails does not cost the others."""
    from .tower_plan import Tower

    files: dict[str, Path] = {}
    failed: dict[str, Exception] = {}
    how = how or HowReports()
    tower = how.tower or Tower(report, None)
    for name in formats:
        path = folder / FORMATS[name][0]
        try:
            with _few_searches_for_cycles():
                _write(name, report, path, how, tower)
        except Exception as error:  # noqa: BLE001 - whatever breaks one report, the night's others are wanted
            failed[name] = error
        else:
            files[name] = path
            beside = path.with_name(SETTING_OUT)
            if name == "csv" and "stack" in report.job and is_there(beside):
                files["setting_out"] = beside
    return Written(files, failed)


@contextmanager
def _few_searches_for_cycles() -> Iterator[None]:
    usual = gc.get_threshold()
    gc.set_threshold(max(usual[0], _YOUNG_OBJECTS) if usual[0] else 0, *usual[1:])
    try:
        yield
    finally:
        gc.set_threshold(*usual)


def _with_tower(name: str, report: JobReport, path: Path, language: Language, tower: TowerShown | None) -> None:
    """A format that shows the tower of a job with [stack]."""
    if name == "html":
        from aadm_workbench.report.pages.html import write_html

        write_html(report, path, language, tower=tower)
    elif name == "pdf":
        from aadm_workbench.report.pages.pdf import write_pdf

        write_pdf(report, path, language, tower=tower)
    elif name == "xlsx":
        from aadm_workbench.report.sheets.xlsx import write_xlsx

        write_xlsx(report, path, language, tower=tower)
    else:
        from aadm_workbench.report.sheets.csv import write_csv, write_setting_out

        write_csv(report, path)
        if tower is not None and tower.setting_out:
            write_setting_out(tower, path.with_name(SETTING_OUT))


def _write(name: str, report: JobReport, path: Path, how: HowReports, tower: Tower) -> None:
    """One report; the packages of a format are imported only where it is asked for."""
    language = how.language
    if name in ("html", "pdf", "xlsx", "csv"):
        _with_tower(name, report, path, language or "en", tower.shown())
    elif name == "fcstd":
        from .fcstd import write_fcstd

        write_fcstd(report, path)
    elif name in ("bcf", "bcf_pairs"):
        from aadm_workbench.report.bcf.topics import write_bcf

        per: Literal["column", "pair"] = "pair" if name == "bcf_pairs" else "column"
        existing = path if is_there(path) else None
        write_bcf(report, path, existing=existing, per=per, version=how.bcf_version, language=language or "en")
    else:
        _write_pages(name, report, path, language)


def _write_pages(name: str, report: JobReport, path: Path, language: Language | None) -> None:
    if name == "crew":
        from aadm_workbench.report.pages.crew_page import write_crew_pages

        write_crew_pages(report, path, language or "zh")
    else:
        from aadm_workbench.report.pages.scan_card import scan_cards
        from aadm_workbench.report.pages.scan_card_page import write_scan_cards

        write_scan_cards(scan_cards(report), path, language or "zh", title=report.job["name"])
