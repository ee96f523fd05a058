"""gauge.html: a gauge study on one self-contained page in both languages, with its plots."""

from __future__ import annotations

import math
from pathlib import Path

from aadm_workbench.calibration.gauge.anova import Estimate
from aadm_workbench.calibration.gauge.drawing import captures_sketch, components_sketch, style_of
from aadm_workbench.calibration.gauge.study import GaugeStudy, QuantityStudy
from aadm_workbench.model import Verdict, worst
from aadm_workbench.own_files import write_atomically
from aadm_workbench.report.pages.static_page import drawn, static_page
from aadm_workbench.report.words.labels import Language, Phrase, phrase, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages

_LINES = (("ev", "repeatability"), ("av", "reproducibility"), ("grr", "gauge"), ("pv", "parts"))
"""The words of each variance, and its name in the study."""


def write_gauge_page(found: GaugeStudy, path: Path, language: Language = "en") -> None:
    """Write gauge.html, whole or not at all; ``language`` is the one that it opens in.

    Raises
    ------
    MissingDependencyError
        Without the packages jinja2 and fonttools.
    AadmError
        Where the file cannot be written.
    """
    write_atomically(path, gauge_page(found, language).encode("utf-8", errors="replace"))


def gauge_page(found: GaugeStudy, language: Language = "en") -> str:
    """The document; the same study gives the same text."""
    return static_page("gauge.html.j2", _context(found), language, "gauge.html")


def _context(found: GaugeStudy) -> dict[str, object]:
    verdict = worst(found.verdicts)
    return {
        "found": found,
        "w": lambda name, **values: phrase(f"gauge.{name}", **values),
        "said": in_both_languages,
        "headline": {Verdict.PASS: "good", Verdict.FAIL: "bad"}.get(verdict, ""),
        "quantities": [(one, *_drawn(one), lines_of_variances(one)) for one in found.quantities],
        "verdict_words": verdict_words,
        "style_of": style_of,
        "interval": interval,
    }


def _drawn(found: QuantityStudy) -> tuple[object, object]:
    return drawn(components_sketch(found), "EV, AV, GRR, PV"), drawn(captures_sketch(found), found.study.quantity)


def lines_of_variances(found: QuantityStudy) -> list[tuple[Phrase, str]]:
    """Each variance by its name, as a standard deviation with its interval."""
    rows = []
    for word, name in _LINES:
        variance: Estimate | None = getattr(found.variances, name)
        if variance is not None:
            roots = Estimate(*map(math.sqrt, (variance.value, variance.low, variance.high)))
            rows.append((phrase(f"gauge.{word}"), interval(roots, 3)))
    return rows


def interval(estimate: Estimate, decimals: int) -> str:
    """``0.021 (0.017–0.027)``."""
    value, low, high = (f"{one:.{decimals}f}" for one in (estimate.value, estimate.low, estimate.high))
    return f"{value} ({low}–{high})"
