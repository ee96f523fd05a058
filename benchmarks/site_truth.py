"""What is true of a column, by its exact centres, against what its report says."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.inspect import inspect_group
from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial.virtual import try_scans
from aadm_workbench.model import Array, AssemblyPoint, BoolArray, ColumnReport, Extraction, GroupReport, Kind, Verdict
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.parts import BarAsBuilt, axis_of
from aadm_workbench.twin.scene import TrueScan, truth_of
from aadm_workbench.twin.slips import Slip
from benchmarks.site_scenes import Column

CERTAIN_MM = 0.15
GHOST_MM = 3.0
CHI2_95 = 5.991
_UP = np.array([0.0, 0.0, 1.0])
_CN = load_profile("cn")
_DECIDED = (Verdict.PASS, Verdict.FAIL)


@dataclass(frozen=True, eq=False)
class Errors:
    """Of the points of one group: how many there are to measure, how many were, and how far off these are, mm.

    ``inside``: whether the true centre lies in the stated 95 % region. ``ghosts`` lie more than 3 mm off, or where
    nothing is to be seen; where the report leaves open which point is which, more than 3 mm off every one.
    """

    kind: Kind
    measurable: int
    found: int
    ghosts: int
    distance_mm: Array
    inside: BoolArray


def _covered(column: Column, kind: Kind) -> list[bool]:
    """Which are wholly under tape."""
    count = len(column.bars.bars)
    return [sleeve.taped >= 0.8 for sleeve in column.foot.sleeves] if kind is Kind.SLEEVE else [False] * count


def _measurable(column: Column, kind: Kind) -> list[bool]:
    """Mouths that are not under tape, and tops, as far as they lie in the picture."""
    if kind is Kind.REBAR:
        across = [bar.core_diameter for bar in column.bars.bars]
        return _in_picture(column.rebars, column.slip, across).tolist()
    sleeves = column.foot.sleeves
    in_picture = _in_picture(column.sleeves, column.slip, [sleeve.diameter for sleeve in sleeves])
    return [seen and not taped for taped, seen in zip(_covered(column, kind), in_picture.tolist(), strict=True)]


def _in_picture(scan: TrueScan, slip: Slip, across_mm: Sequence[float]) -> BoolArray:
    """Whether a round thing about each true centre lies wholly in the picture that was taken, by the true camera."""
    camera, (x, y, depth) = scan.camera, scan.points_scan().T
    fx, fy = camera.fx / slip.focal, camera.fy / slip.focal
    reach = fx * np.array(across_mm) / 2.0 / depth + 1.0
    u = fx * x / depth + camera.cx - slip.principal_px[0]
    v = fy * y / depth + camera.cy - slip.principal_px[1]
    inside = (u > reach) & (u < camera.width - reach) & (v > reach) & (v < camera.height - reach)
    return np.asarray(inside)


def _group(report: ColumnReport, kind: Kind) -> GroupReport | None:
    return report.sleeves if kind is Kind.SLEEVE else report.rebars


def errors_of(column: Column, report: ColumnReport, kind: Kind) -> Errors:
    """Centres that the report gives against the true ones, both in the scan frame, in the plane."""
    group, scan = _group(report, kind), column.sleeves if kind is Kind.SLEEVE else column.rebars
    measurable, covered = _measurable(column, kind), _covered(column, kind)
    distances, inside, ghosts, found = [], [], 0, 0
    true = _told(scan.points_scan(), column)
    for k, point in enumerate(group.points if group is not None else ()):
        if point.scan_mm is None or point.verdict is Verdict.NOT_MEASURED or k >= len(true):
            continue
        assert group is not None
        assert group.fit is not None
        offs = (np.array(point.scan_mm) - true) @ group.fit.T_design_scan[:2, :3].T
        off, nearest = offs[k], int(np.hypot(*offs.T).argmin())
        if group.fit.orientation == "ambiguous" and group.verdict is Verdict.NOT_MEASURED:
            ghosts += bool(np.hypot(*offs[nearest]) > GHOST_MM or covered[nearest])
            continue
        distance = float(np.hypot(*off))
        found += measurable[k]
        if distance > GHOST_MM or covered[k]:
            ghosts += 1
            continue
        distances.append(distance)
        covariance = np.array(point.cov_mm2)
        inside.append(bool(off @ np.linalg.solve(covariance, off) <= CHI2_95))
    return Errors(kind, sum(measurable), found, ghosts, np.array(distances), np.array(inside, bool))


def _told(points: Array, column: Column) -> Array:
    """Points (n, 3) where a camera has them that is told a wrong principal point: it cannot know."""
    across = np.array([*column.slip.principal_px, 0.0]) / PRO_M.fx
    return points - points[:, 2:] * across


def false_verdicts(column: Column, report: ColumnReport, *, void: bool) -> list[str]:
    """Verdicts that are certain and false; of ``void`` scans every certain one is."""
    return list(_false_points(column, report, void=void)) + list(_false_trial(column, report, void=void))


def _exact(column: Column, kind: Kind) -> Extraction:
    points = truth_of(column.foot if kind is Kind.SLEEVE else column.bars)
    if kind is Kind.REBAR:
        length_mm = column.setting.exposed
        points = tuple(_from_end_to_end(*one, length_mm) for one in zip(points, column.bars.bars, strict=True))
    return Extraction(kind, "truth", points, None, _UP, "truth")


def _from_end_to_end(point: AssemblyPoint, bar: BarAsBuilt, length_mm: float) -> AssemblyPoint:
    """The point with the axis from where a kinked bar passes the mouth to its top: farthest off are the ends."""
    if bar.kinked_at is None:
        return point
    bent = min(length_mm / bar.kinked_at, 1.0) / length_mm
    return replace(point, axis=axis_of((bar.lean[0] + bent * bar.bend[0], bar.lean[1] + bent * bar.bend[1])))


def _exact_group(column: Column, kind: Kind) -> GroupReport | None:
    found, points = _exact(column, kind), column.design.points(kind)
    match = match_extraction(points, found, up=90.0, image_up_scan=np.array([0.0, 1.0, 0.0]))
    return inspect_group(points, found, match, _CN, decision="simple") if match else None


def _false_points(column: Column, report: ColumnReport, *, void: bool) -> Iterator[str]:
    for kind in Kind:
        group, exact = _group(report, kind), _exact_group(column, kind)
        if group is None:
            continue
        void_here = void or exact is None
        pairs = [*zip(group.points, exact.points if exact else group.points, strict=True)]
        pairs += [*zip(group.spacing, exact.spacing if exact else group.spacing, strict=True)]
        for said, true in pairs:
            if said.verdict not in _DECIDED:
                continue
            off_mm = 0.0 if void_here or true.deviation_mm is None else abs(abs(true.deviation_mm) - 2.0)
            if void_here or (said.verdict is not true.verdict and off_mm > CERTAIN_MM):
                name = getattr(said, "label", None) or "-".join(said.between)
                yield f"{name} {said.verdict}, measured {said.deviation_mm:.2f}, true {true.deviation_mm or 0.0:.2f} mm"


def _false_trial(column: Column, report: ColumnReport, *, void: bool) -> Iterator[str]:
    trial = report.trial_assembly
    if trial is None or trial.verdict not in _DECIDED:
        return
    exact = [(_exact(column, kind), column.design.points(kind)) for kind in Kind]
    matched = [
        (found, match_extraction(points, found, up=90.0, image_up_scan=np.array([0.0, 1.0, 0.0])))
        for found, points in exact
    ]
    if void or not all(match for _, match in matched):
        yield f"trial {trial.verdict} of scans that are not of this column"
        return
    true = try_scans(column.design, *matched, _CN, np.random.default_rng(0), decision="simple")
    if true.verdict is not trial.verdict:
        yield f"trial {trial.verdict} ({trial.probability}), true {true.verdict}, margin {true.margin}"
