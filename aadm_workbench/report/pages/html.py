"""report.html: one self-contained file, for the client to read and keep.

It works offline and asks nothing of the network: a Content-Security-Policy lets run only the script and the style that
stand in the file, by their hashes. Names from models and jobs are escaped wherever they stand.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.model import SUMMED, JobReport, MouldDrift, Verdict
from aadm_workbench.own_files import write_atomically
from aadm_workbench.report.column_view import advice_notes, column_facts, trial_facts, window_text
from aadm_workbench.report.drawing.mould import mould_sketch
from aadm_workbench.report.drawing.plan import Plan, floor_plans, plan_verdict
from aadm_workbench.report.findings import Finding, findings
from aadm_workbench.report.hoist import headline
from aadm_workbench.report.pages.crew import crew_advice, in_steps
from aadm_workbench.report.pages.fonts import embedded_font_css
from aadm_workbench.report.pages.html_column import column_entry, view_of
from aadm_workbench.report.pages.html_table import TableWriter
from aadm_workbench.report.pages.svg import svg_of, svg_styles
from aadm_workbench.report.sheets.numbers import number_text, signed
from aadm_workbench.report.sheets.sheets import MOULD, mould_rows, profile_table
from aadm_workbench.report.sheets.tables import Heading, Row, narrowed
from aadm_workbench.report.tower import TowerShown
from aadm_workbench.report.words.labels import (
    Language,
    Phrase,
    all_words,
    phrase,
    profile_words,
    resource_folder,
    verdict_words,
)
from aadm_workbench.report.words.reasons import in_both_languages

_LATER = {"policy": "(the policy)", "style": "(the style)"}
"""What stands in the head until both are known."""
_PIECES = 5000  # of the template in one part: some hundred kilobytes, and the whole head in the first

_VERDICTS = tuple(verdict.value for verdict in (*SUMMED, Verdict.NOT_ASSESSED))


def write_html(report: JobReport, path: Path, language: Language = "en", *, tower: TowerShown | None = None) -> None:
    """Write report.html, whole or not at all; ``language`` is the one that it opens in.

    ``tower`` is what set columns do to the storey above, where somebody has worked it out.

    Raises
    ------
    MissingDependencyError
        Without the packages jinja2 and fonttools.
    AadmError
        Where the file cannot be written.
    """
    write_atomically(path, _parts(report, language, tower))


def html_text(report: JobReport, language: Language = "en", *, tower: TowerShown | None = None) -> str:
    """The document; the same report gives the same text."""
    return b"".join(_parts(report, language, tower)).decode()


def _parts(report: JobReport, language: Language, tower: TowerShown | None) -> list[bytes]:
    """The document in UTF-8, in parts.

    Font and policy hang on all that follows: which signs occur, and the hash of the style. They are put into the head
    at the end, where no text of others stands before them.
    """
    script = (resource_folder() / "report.js").read_text(encoding="utf-8")
    context = _context(report, language) | _tower(tower) | {"script": _raw(script)}
    context |= {name: _raw(mark) for name, mark in _LATER.items()}
    stream = _environment().get_template("report.html.j2").stream(**context)
    stream.enable_buffering(_PIECES)
    parts, signs = [], set[str]()
    for part in stream:
        signs.update(part)
        parts.append(part.encode("utf-8", errors="replace"))
    sheets = ("report.css",) if tower is None else ("report.css", "tower.css")
    style = "".join((resource_folder() / name).read_text(encoding="utf-8") for name in sheets) + svg_styles()
    style = embedded_font_css("".join(signs)) + style
    for name, text in (("policy", _policy(script, style)), ("style", style)):
        parts[0] = parts[0].replace(_LATER[name].encode(), text.encode(), 1)
    return parts


def json_in_html(document: object) -> str:
    """JSON that no text in it can end: what opens or closes a tag is written as a number."""
    text = json.dumps(document, ensure_ascii=False, separators=(",", ":"))
    return text.translate({ord(sign): f"\\u{ord(sign):04x}" for sign in "<>&'\u2028\u2029"})


def _policy(script: str, style: str) -> str:
    hashes = [base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in (script, style)]
    return (
        f"default-src 'none'; script-src 'sha256-{hashes[0]}'; style-src 'sha256-{hashes[1]}'; "
        "font-src data:; base-uri 'none'; form-action 'none'"
    )


def _environment() -> Any:
    try:
        jinja2: Any = import_module("jinja2")
    except ImportError as error:
        raise MissingDependencyError("jinja2", "report.html") from error
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(resource_folder()), autoescape=True, undefined=jinja2.StrictUndefined
    )


def _raw(text: str) -> Any:
    """A text of this product's own that is not escaped: script, style, drawings whose labels are escaped already."""
    return import_module("markupsafe").Markup(text)


def _context(report: JobReport, language: Language) -> dict[str, Any]:
    found = findings(report)
    sentences: dict[Phrase, int] = {}

    def number_of(text: Phrase) -> int:
        return sentences.setdefault(text, len(sentences))

    tables = TableWriter(language, number_of)
    by_state = {state: [one for one in found if one.hoist.state == state] for state in ("no", "not_yet", "yes")}
    return {
        "report": report,
        "language": language,
        "words": all_words(),
        "found": found,
        **by_state,
        "entry": lambda finding: column_entry(report, finding, _raw),
        "number_of": number_of,
        "table": lambda headings, rows: _raw(tables.table(headings, rows)),
        "headline": headline(report),
        "not_yet_line": phrase("headline.not_yet", number=len(by_state["not_yet"])),
        "yes_line": phrase("headline.yes", number=len(by_state["yes"])),
        "plans": _plans(report, found),
        "limits": profile_words(report.profile.name, report.profile.title),
        "legend": [name for name in _VERDICTS if any(plan_verdict(one.column) == name for one in found)],
        "moulds": [_mould(mould, language) for mould in report.mould_drift],
        "profile": profile_table(report),
        "inputs": _inputs(report),
        "views": lambda: _raw(
            json_in_html({one.anchor: asdict(view_of(one.column)) for one in found if one.column.groups})
        ),
        "dictionary": lambda: _raw(json_in_html(_dictionary(sentences))),
        "verdict_words": verdict_words,
        "column_facts": column_facts,
        "advice_notes": advice_notes,
        "steps": lambda column: in_steps(crew_advice(report, column)),
        "trial_facts": trial_facts,
        "window_text": window_text,
        "view_note": lambda factor: phrase("ui.view_3d_note", factor=factor),
        "number": number_text,
        "sentence": in_both_languages,
    }


def _dictionary(sentences: Iterable[Phrase]) -> dict[str, dict[str, list[str]] | list[list[str]]]:
    """What the language switch needs; sentences by the number that the document calls them by."""
    shown = ("ui.", "cause.", "state.")
    return {
        "texts": {name: list(text) for name, text in all_words().items() if name.startswith(shown)},
        "sentences": [list(sentence) for sentence in sentences],
        "verdicts": {name: [verdict_words(name, "en"), verdict_words(name, "zh")] for name in _VERDICTS},
    }


def _plans(report: JobReport, found: list[Finding]) -> list[tuple[Plan, str]]:
    """Each plan, and as SVG."""
    anchors = {finding.column.id: finding.anchor for finding in found}
    plans = floor_plans(report.columns, anchors, report.grid)
    return [(plan, _raw(svg_of(plan.sketch, label="plan", css_class="plan"))) for plan in plans]


def _tower(tower: TowerShown | None) -> dict[str, object]:
    """What the template needs of the tower, where there is one."""
    drawn = () if tower is None else tower.plans
    plans = [(plan, _raw(svg_of(plan.sketch, label="plan", css_class="plan"))) for plan in drawn]
    return {"tower": tower, "tower_plans": plans, "word": phrase, "signed": signed}


class _Mould(NamedTuple):
    """A mould as the template shows it."""

    name: str
    columns: str
    conclusion: Phrase
    note: Phrase
    svg: str
    headings: Sequence[Heading]
    rows: Sequence[Row]


def _mould(mould: MouldDrift, language: Language) -> _Mould:
    limit = "–" if mould.axis_limit_mm is None else f"{mould.axis_limit_mm:.2f}"
    return _Mould(
        mould.name,
        phrase("ui.of_columns", number=len(mould.columns)).in_language(language),
        in_both_languages(mould.conclusion),
        phrase("ui.mould_note", limit=limit),
        _raw(svg_of(mould_sketch(mould), label="Cpk", css_class="bars")),
        *narrowed(MOULD, list(mould_rows(mould, language))),
    )


def _inputs(report: JobReport) -> list[tuple[str, str, str]]:
    job, model = report.job, report.model
    lines = [("ui.job", job["name"], job["sha256"])]
    if model is not None:
        lines.append(("ui.model", model["source"], model["sha256"]))
    rest = [f"{key} {value}" for key, value in job.items() if key not in ("name", "sha256")]
    versions = [f"{key} {value}" for key, value in report.tool.items() if key not in ("name", "version")]
    lines.append(("ui.settings", ", ".join(rest), ""))
    lines.append(("ui.made_by", ", ".join([f"{report.tool['name']} {report.tool['version']}", *versions]), ""))
    return lines
