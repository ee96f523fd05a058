"""Reversal without a plate: what reports on captures of the same columns tell of the camera, and of the parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.matching.reversal import CameraView, Reversal, image_axes, reversal_of
from aadm_workbench.model import Array, GroupReport, JobReport, Json, Kind, Reason, Verdict


@dataclass(frozen=True, eq=False)
class ColumnReversal:
    """The sleeves or the rebars of one column: their labels, from how many captures, what was found, or why nothing."""

    column: str
    kind: Kind
    labels: tuple[str, ...]
    captures: int
    found: Reversal | Reason

    @property
    def verdict(self) -> Verdict:
        """Fails where the camera bends more than the stated uncertainty; inconclusive where captures tell nothing."""
        if isinstance(self.found, str):
            return Verdict.INCONCLUSIVE
        return Verdict.FAIL if self.found.contradicts else Verdict.PASS


def reversals_of(reports: Sequence[JobReport]) -> list[ColumnReversal]:
    """Each group of each column that two captures or more have measured."""
    groups: dict[tuple[str, Kind], list[GroupReport]] = {}
    for report in reports:
        for column in report.columns:
            for kind, group in column.groups.items():
                groups.setdefault((column.id, kind), []).append(group)
    return [_of_group(column, kind, each) for (column, kind), each in groups.items() if len(each) > 1]


def _of_group(column: str, kind: Kind, groups: Sequence[GroupReport]) -> ColumnReversal:
    labels = tuple(sorted({point.label for group in groups for point in group.points}, key=_place))
    views = [view for view in (_view(group, labels) for group in groups) if view is not None]
    return ColumnReversal(column, kind, labels, len(groups), reversal_of(views))


def _place(label: str) -> tuple[str, int]:
    letters = label.rstrip("0123456789")
    return letters, int(label[len(letters) :] or 0)


def _view(group: GroupReport, labels: Sequence[str]) -> CameraView | None:
    """One capture; None where it was not matched, or its points are in no camera's frame."""
    if group.fit is None:
        return None
    empty = (len(labels), 2)
    offset, design, picture = np.full(empty, np.nan), np.zeros(empty), np.full(empty, np.nan)
    u_mm = np.full(len(labels), np.nan)
    for point in group.points:
        number = labels.index(point.label)
        design[number] = point.design_mm[:2]
        if point.offset_mm is None or point.scan_mm is None:
            continue
        if point.scan_mm[2] <= 0.0:
            return None
        offset[number] = point.offset_mm
        picture[number] = np.array(point.scan_mm[:2]) / point.scan_mm[2]
        if point.u_mm is not None:
            u_mm[number] = point.u_mm
    return CameraView(offset, design, picture, image_axes(group.fit.T_design_scan), u_mm)


def reversal_document(each: Sequence[ColumnReversal]) -> list[dict[str, Json]]:
    """All that was found, lengths in mm: the part's own offsets, the bend at each centre of each capture."""
    return [
        {
            "column": one.column,
            "kind": one.kind.plural,
            "captures": one.captures,
            "verdict": one.verdict.value,
            **({"reason": one.found} if isinstance(one.found, str) else _document(one.found, one.labels)),
        }
        for one in each
    ]


def _document(found: Reversal, labels: Sequence[str]) -> dict[str, Json]:
    return {
        "bend_mm": found.largest_mm,
        "u_mm": found.u_mm,
        "stated_u_mm": found.stated_u_mm,
        "noise_mm": found.noise_mm,
        "chance": found.chance,
        "not_told": list(found.untold),
        "part_mm": {label: _pair(at) for label, at in zip(labels, found.part, strict=True)},
        "camera_mm": [
            {label: _pair(at) for label, at in zip(labels, bias, strict=True) if np.isfinite(at).all()}
            for bias in found.bias
        ],
    }


def _pair(at: Array) -> Json:
    return [float(one) for one in at] if np.isfinite(at).all() else None
