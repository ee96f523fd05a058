"""A gauge study as JSON."""

from __future__ import annotations

import math

from aadm_workbench.calibration.gauge.anova import Anova, Estimate
from aadm_workbench.calibration.gauge.study import GaugeStudy, QuantityStudy
from aadm_workbench.model import Json

SCHEMA = 1
"""Of this document: keys are added under the same number, and never change their meaning."""


def gauge_document(found: GaugeStudy) -> dict[str, Json]:
    """What ``aadm gauge --json`` prints: standard deviations in mm, intervals of 95 %."""
    return {
        "schema": SCHEMA,
        "captures": [{"name": one.name, "operator": one.operator} for one in found.captures],
        "quantities": [_quantity(one) for one in found.quantities],
        "not_studied": [str(reason) for reason in found.not_studied],
    }


def _quantity(found: QuantityStudy) -> dict[str, Json]:
    variances, stated = found.variances, found.stated
    av = variances.reproducibility
    return {
        "quantity": found.study.quantity,
        "parts": [list(part) for part in found.study.parts],
        "operators": list(found.study.operators),
        "repeats": found.study.values.shape[-1],
        "axes": found.study.values.shape[0],
        "table": _table(found.table),
        "repeatability_mm": _root(variances.repeatability),
        "reproducibility_mm": None if av is None else _root(av),
        "gauge_mm": _root(variances.gauge),
        "parts_mm": _root(variances.parts),
        "percent_of_study": _interval(found.percent_of_study),
        "categories": found.categories,
        "against": [
            {
                "limit_mm": one.limit_mm,
                "percent": _interval(one.percent),
                "categories": one.categories,
                "verdict": one.verdict.value,
            }
            for one in found.against
        ],
        "stated_u_mm": stated.u_mm,
        "scatter_over_u": None if stated.ratio is None else _interval(stated.ratio),
        "stated_u_verdict": stated.verdict.value,
        "stated_u": str(stated.reason),
        "left_out": list(found.study.left_out),
    }


def _table(table: Anova) -> list[Json]:
    names = ("parts", "operators", "interaction", "repeats")
    lines = ((name, getattr(table, name)) for name in names)
    return [{"source": name, "ss": line.squares, "df": line.freedom} for name, line in lines if line is not None]


def _interval(estimate: Estimate) -> list[Json]:
    return [estimate.value, estimate.low, estimate.high]


def _root(variance: Estimate) -> list[Json]:
    return [math.sqrt(value) for value in (variance.value, variance.low, variance.high)]
