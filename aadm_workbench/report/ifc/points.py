"""Results onto the elements of sleeves and bars; one element may draw the points of several columns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

from aadm_workbench.model import ColumnReport, JobReport, Kind, PointResult
from aadm_workbench.report.ifc import sets as ifc_sets
from aadm_workbench.report.ifc.assign import Assigner
from aadm_workbench.report.ifc.elements import Elements

Told: TypeAlias = tuple[ColumnReport, PointResult]
"""A column and one of its points."""


def write_points(
    report: JobReport, columns: Sequence[ColumnReport], elements: Elements, assigner: Assigner
) -> list[str]:
    """Give sleeves and bars their sets; names what the model does not hold, or not once."""
    missing: list[str] = []
    for kind, name in ifc_sets.POINT_SETS.items():
        of_element: dict[int, tuple[Any, list[Told]]] = {}
        for column in columns:
            for point in column.points(kind):
                element = elements.point(point)
                if element is None:
                    missing.append(f"{point.label} of column {column.id}")
                else:
                    of_element.setdefault(element.id(), (element, []))[1].append((column, point))
        for element, told in of_element.values():
            _write_element(report, kind, name, told, element, assigner)
    return missing


def _write_element(
    report: JobReport, kind: Kind, name: str, told: Sequence[Told], element: Any, assigner: Assigner
) -> None:
    """One element; where several points are drawn as one, its set tells the worst, and each has a set of its own."""
    column, worst = max(told, key=lambda pair: _badness(pair[1]))
    assigner.assign(element, name, ifc_sets.point_properties(report, column, kind, worst))
    several = len({column.id for column, _ in told}) > 1
    for own, point in told if len(told) > 1 else ():
        called = f"{name}_{own.id}_{point.label}" if several else f"{name}_{point.label}"
        assigner.assign(element, called, ifc_sets.point_properties(report, own, kind, point))
    if assigner.addition.is_4x3:
        assigner.assign(element, "Pset_Tolerance", ifc_sets.tolerance_properties(report, kind, worst))
        assigner.assign(element, "Pset_Uncertainty", ifc_sets.uncertainty_properties(worst))


def _badness(point: PointResult) -> tuple[int, float]:
    rank = ("not_assessed", "pass", "inconclusive", "not_measured", "fail", "error").index(point.verdict)
    return rank, point.deviation_mm or 0.0
