"""Several frames of one column, put together: what one corner hides another one shows.

The shapes of sleeves and bars do not change while the column hangs; where they lie does, from frame to frame. So each
frame has two rigid poses of its own, one of the foot and one of the bars, and all frames share two shapes, which are
near the design. No camera needs to be calibrated against another, and the column may move in between. What comes out
is laid into the last frame, as if that one had seen it all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import stats

from aadm_workbench.assembly.decision import DecisionRule
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.hoisting.offsets import WARP_MM, HungFit
from aadm_workbench.hoisting.pairs import report_pairs
from aadm_workbench.hoisting.pattern_fit import OWN, Evidence, Pattern, State, as_built, loosened, placed
from aadm_workbench.hoisting.sense import why_half
from aadm_workbench.hoisting.sequence.sighting import SightedMeasurement, Sighting, with_sighting
from aadm_workbench.model import Array, AssemblyPoint, BoolArray, ColumnDesign, HoistingMeasurement, Profile

_ROUNDS = 6  # poses come from frames that were fitted: the third step is below a micrometre
_UNLIKELY = 1e-5  # of frames that are labelled rightly and of parts that stand as they stood, to differ so


@dataclass(frozen=True, eq=False)
class Sight:
    """What one frame shows of one pattern, and the pose (3,), x, y mm and turn, in which it lies there, roughly."""

    evidence: Evidence
    pose: Array


@dataclass(frozen=True, eq=False)
class JointShape:
    """A pattern as several frames show it, in the axes of the last one.

    ``centres`` (k, 2) mm with their joint ``covariance`` (2k, 2k); ``pose`` (3,) lays the pattern on them, with the
    covariance ``pose_covariance`` (3, 3); ``seen`` (k,) tells which were seen by some frame. ``chance`` is the
    probability that frames which agree differ as much as these; None where nothing was seen twice.
    """

    centres: Array
    covariance: Array
    pose: Array
    pose_covariance: Array
    seen: BoolArray
    chance: float | None


def join_sights(sights: Sequence[Sight], pattern: Pattern) -> JointShape:
    """Fit one shape of a pattern, and a pose for each frame, to what frames show; the last frame gives the axes."""
    count = len(pattern.places)
    seen = np.zeros(count, bool)
    for sight in sights:
        seen[sight.evidence.index] = True
    shape, poses = pattern.places.copy(), np.array([sight.pose for sight in sights])
    weights = [_weight(sight.evidence) for sight in sights]
    believed = pattern
    for _ in range(_ROUNDS):
        normal, gradient = _equations(sights, weights, believed, shape, poses)
        step = -np.linalg.solve(normal, gradient)
        shape = shape + step[: 2 * count].reshape(-1, 2)
        poses = poses + step[2 * count :].reshape(-1, 3)
        state = State(np.zeros(3), np.empty(0), np.pad(shape, ((0, 0), (0, OWN - 2))))
        believed = as_built(loosened(pattern, state), state, seen)
    normal, _ = _equations(sights, weights, believed, shape, poses)
    inverse = np.linalg.inv(normal)
    rows = np.concatenate([np.arange(2 * count), 2 * count + 3 * (len(sights) - 1) + np.arange(3)])
    jacobian = np.hstack([np.kron(np.eye(count), turn(float(poses[-1, 2]))), _moving(shape, poses[-1])])
    covariance = jacobian @ inverse[np.ix_(rows, rows)] @ jacobian.T
    return JointShape(
        centres=placed(poses[-1], shape),
        covariance=np.asarray(covariance),
        pose=poses[-1],
        pose_covariance=np.asarray(inverse[-3:, -3:]),
        seen=seen,
        chance=_chance(sights, weights, shape, poses, seen),
    )


def _weight(evidence: Evidence) -> Array:
    return np.asarray(np.linalg.inv(evidence.covariance + WARP_MM**2 * np.eye(len(evidence.covariance))))


def _moving(shape: Array, pose: Array) -> Array:
    """Jacobian (2m, 3) of placed points to a pose."""
    turned = placed(pose, shape) - pose[:2]
    jacobian = np.zeros((2 * len(shape), 3))
    jacobian[0::2, 0] = jacobian[1::2, 1] = 1.0
    jacobian[0::2, 2], jacobian[1::2, 2] = -turned[:, 1], turned[:, 0]
    return jacobian


def _equations(
    sights: Sequence[Sight], weights: Sequence[Array], pattern: Pattern, shape: Array, poses: Array
) -> tuple[Array, Array]:
    """Normal equations of the shape (2k) and the poses (3f): the frames' evidence, and the pattern that is believed."""
    count = len(shape)
    size = 2 * count + 3 * len(sights)
    normal, gradient = np.zeros((size, size)), np.zeros(size)
    own = np.arange(2 * count)
    prior = np.repeat(pattern.scatter_mm**-2.0, 2)
    normal[own, own] += prior
    gradient[own] += prior * (shape - pattern.places).ravel()
    for number, (sight, weight, pose) in enumerate(zip(sights, weights, poses, strict=True)):
        index = sight.evidence.index
        rows = np.concatenate([(2 * index[:, None] + np.arange(2)).ravel(), 2 * count + 3 * number + np.arange(3)])
        jacobian = np.hstack([np.kron(np.eye(len(index)), turn(float(pose[2]))), _moving(shape[index], pose)])
        off = (placed(pose, shape[index]) - sight.evidence.centres).ravel()
        normal[np.ix_(rows, rows)] += jacobian.T @ weight @ jacobian
        gradient[rows] += jacobian.T @ (weight @ off)
    return normal, gradient


def _chance(
    sights: Sequence[Sight], weights: Sequence[Array], shape: Array, poses: Array, seen: BoolArray
) -> float | None:
    """Probability of a χ² as large as that of the frames about their common shape."""
    square, told = 0.0, 0
    for sight, weight, pose in zip(sights, weights, poses, strict=True):
        off = (placed(pose, shape[sight.evidence.index]) - sight.evidence.centres).ravel()
        square += float(off @ weight @ off)
        told += len(off)
    # the shape is free but for a rigid move, which the frames' own poses hold
    freedom = told - (2 * int(seen.sum()) - 3) - 3 * len(sights)
    return float(stats.chi2.sf(square, freedom)) if freedom > 0 else None


def shapes_agree(first: HoistingMeasurement, second: HoistingMeasurement) -> bool | None:
    """Whether two frames can be of one column over one group of bars, as they are labelled; None where nobody knows."""
    if not isinstance(first, SightedMeasurement) or not isinstance(second, SightedMeasurement):
        return None
    sightings = (first.sighting, second.sighting)
    return _agree(*_shapes(sightings)) if all(map(_is_oriented, sightings)) else None


def _shapes(sightings: Sequence[Sighting]) -> tuple[JointShape, JointShape]:
    """Those of the foot and of the bars."""
    foot = [Sight(sighting.hung.foot.evidence, sighting.hung.foot.pose) for sighting in sightings]
    bars = [Sight(sighting.hung.bars.evidence, sighting.hung.bars.pose) for sighting in sightings]
    return join_sights(foot, _least_known(sightings, 0)), join_sights(bars, _least_known(sightings, 1))


def _agree(*shapes: JointShape) -> bool:
    return all(shape.chance is None or shape.chance > _UNLIKELY for shape in shapes)


def measure_jointly(
    frames: Sequence[HoistingMeasurement], design: ColumnDesign, profile: Profile | None, decision: DecisionRule
) -> SightedMeasurement | None:
    """Put frames of one column together, in the last one's bars' frame.

    Returns
    -------
    None where fewer than two of them tell which sleeve is which, where the last one does not, or where they contradict
    each other: then none of them is to be believed more than another.
    """
    told = [frame for frame in frames if isinstance(frame, SightedMeasurement) and _is_oriented(frame.sighting)]
    if len(told) < 2 or told[-1] is not frames[-1]:
        return None
    sightings = [frame.sighting for frame in told]
    last = sightings[-1]
    foot, bars = _shapes(sightings)
    if not _agree(foot, bars):
        return None
    missing = _missing(sightings, design)
    hung = _hung(last.hung, foot, bars, _heights([s.hung for s in sightings]), missing, design)
    shown = np.any([s.shown for s in sightings], axis=0)
    half = why_half(shown)
    measured = report_pairs(last.scan, last.frame, design, hung, last.orientation, profile, decision, half)
    moved = {one.label: one for frame in told for one in frame.report.moved_since}
    report = replace(
        measured.report,
        near=told[-1].report.near,
        joined=tuple(frame.report.source for frame in told),
        moved_since=tuple(moved.values()),
        findings=told[-1].report.findings,
    )
    return with_sighting(replace(measured, report=report), replace(last, hung=hung, shown=shown))


def _is_oriented(sighting: Sighting) -> bool:
    return sighting.orientation in ("declared", "resolved")


def _least_known(sightings: Sequence[Sighting], kind: int) -> Pattern:
    """The pattern as it may be believed of all frames: what one of them found moved is by design."""
    patterns = [(s.sleeves, s.rebars)[kind] for s in sightings]
    scatter = np.array([pattern.scatter_mm for pattern in patterns])
    widest = scatter.argmax(axis=0)
    every = np.arange(scatter.shape[1])
    return Pattern(np.array([p.places for p in patterns])[widest, every], scatter[widest, every])


def _heights(hung: Sequence[HungFit]) -> Array:
    """Heights (k,) mm of the bars' tops in the last frame: of those that it hides, from what others see of both."""
    last = hung[-1].bars
    known = np.where(last.seen, last.tops[:, 2], np.nan)
    told = []
    for one in hung[:-1]:
        own = np.where(one.bars.seen, one.bars.tops[:, 2], np.nan)
        both = np.isfinite(own) & np.isfinite(known)
        told.append(own - np.median((own - known)[both]) if both.any() else np.full(len(own), np.nan))
    for heights in told:
        known = np.where(np.isfinite(known), known, heights)
    return np.asarray(known)


def _missing(sightings: Sequence[Sighting], design: ColumnDesign) -> tuple[str, ...]:
    """Labels of what some frame shows not to be there, and no later one where it should be."""
    missing: set[str] = set()
    for sighting in sightings:
        hung = sighting.hung
        seen = {
            point.label
            for points, shown in ((design.sleeves, hung.foot.seen), (design.rebars, hung.bars.seen))
            for point, is_seen in zip(points, shown, strict=True)
            if is_seen
        }
        missing = (missing - seen) | set(hung.missing)
    return tuple(point.label for point in (*design.sleeves, *design.rebars) if point.label in missing)


def _there(points: Sequence[AssemblyPoint], missing: Sequence[str]) -> BoolArray:
    return np.array([point.label not in missing for point in points])


def _hung(
    last: HungFit, foot: JointShape, bars: JointShape, heights: Array, missing: tuple[str, ...], design: ColumnDesign
) -> HungFit:
    """The last frame's fit, as if it had seen what all have."""
    seen = foot.seen & _there(design.sleeves, missing)
    foot_fit = replace(last.foot, centres=foot.centres, covariance=foot.covariance, seen=seen, pose=foot.pose)
    bar_fit = replace(
        last.bars,
        tops=np.column_stack([bars.centres, heights]),
        covariance=bars.covariance,
        seen=bars.seen & np.isfinite(heights) & _there(design.rebars, missing),
        pose=bars.pose,
        turn_u=float(np.sqrt(bars.pose_covariance[2, 2])),
    )
    before = tuple(label for label in last.before if label not in missing)
    return replace(last, foot=foot_fit, bars=bar_fit, before=before, missing=missing)
