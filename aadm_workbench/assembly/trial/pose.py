"""What becomes of each pair of rebar and sleeve at one pose of the trial assembly: distance, clearance, verdict.

A lean that all bars, or all sleeves, share: theirs, or that of what was taken for the vertical. A floor that slopes by
a degree, taken as level, makes every bar lean alike; a camera whose principal point is off makes every sleeve lean
alike. Twelve axes that agree against the vertical are evidence too, and which of the two is right the scan does not
say. So the trial is made both ways, and only what both come to is decided.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from aadm_workbench.assembly.decision import Decision, DecisionRule, decide_radial, standard_uncertainty, verdict_radial
from aadm_workbench.assembly.pairs import LEAN_U_RAD, Pair
from aadm_workbench.assembly.pose.best_pose import BestFit
from aadm_workbench.assembly.pose.eopa import planar_transform, turn
from aadm_workbench.assembly.tolerances import describe_limit
from aadm_workbench.model import Array, BestPair, BestPose, PairResult, Reason, Rule, TrialPose, Verdict, in_one, worst
from aadm_workbench.model.measured import OF_MEDIAN, TO_SIGMA
from aadm_workbench.model.special import median

_FEWEST = 4
"""With fewer axes, that they agree says little."""

_SIGMAS = 5.0
"""A common lean counts where it is so many times what the scatter of the axes lets their mean be off by chance."""

_SMALLEST_RAD = math.radians(0.15)
"""Half of the usual lean of a single bar: less in common decides nothing over an embedded length."""

_BENT_RAD = 10.0 * LEAN_U_RAD
"""Ten times what bars lean by as cast: no chance. Such a bar was bent, at its foot or anywhere under its top."""


@dataclass(frozen=True, eq=False)
class _End:
    """Axis of the bar from that of the sleeve at one end of the embedded length, (2,) mm, and its covariance."""

    gap: Array
    covariance: Array | None

    @property
    def length_mm(self) -> float:
        return float(np.hypot(*self.gap))


def evaluate_pose(
    pairs: Sequence[Pair], yaw: float, shift: Array, rule: Rule | None, decision: DecisionRule
) -> TrialPose:
    """Distances and clearances of all pairs where bars are turned by ``yaw`` and moved by ``shift`` (2,) mm."""
    results = tuple(_evaluate(pair, yaw, shift, rule, decision) for pair in pairs)
    return TrialPose(planar_transform(yaw, shift), *_statistics(results), pairs=results)


def evaluate_best_pose(
    pairs: Sequence[Pair], limits_mm: Array, fit: BestFit, rule: Rule | None, decision: DecisionRule
) -> BestPose:
    """The pose that leaves most: as :func:`evaluate_pose`, with the room of each pair, its uncertainty and margin.

    Parameters
    ----------
    limits_mm
        (n,) float64, of the distance of each pair.
    """
    results = tuple(
        _best_pair(pair, float(limit_mm), fit, rule, decision) for pair, limit_mm in zip(pairs, limits_mm, strict=True)
    )
    statistics = _statistics(results)
    return BestPose(planar_transform(fit.yaw, fit.shift), *statistics, pairs=results, margin=fit.margin)


def _statistics(results: Sequence[PairResult]) -> tuple[float, float, float]:
    distances = np.array([result.distance_mm for result in results])
    return float(distances.max()), float(distances.mean()), float(distances.std())


def _offset(pair: Pair, yaw: float, shift: Array) -> Array:
    return np.asarray(turn(yaw) @ pair.rebar_xy + shift - pair.sleeve_xy)


def _ends(pair: Pair, yaw: float, shift: Array) -> tuple[_End, _End]:
    """At the sleeve's mouth, and at the bar's top inside it."""
    offset, rotation = _offset(pair, yaw, shift), turn(yaw)
    bar, sleeve = pair.bar_shift_covariance, pair.sleeve_shift_covariance
    turned = None if bar is None else rotation @ bar @ rotation.T
    return (
        _End(offset - rotation @ pair.bar_shift, _sum(pair.covariance, turned)),
        _End(offset - pair.sleeve_shift, _sum(pair.covariance, sleeve)),
    )


def _sum(first: Array | None, second: Array | None) -> Array | None:
    return first if first is None or second is None else first + second


def _evaluate(pair: Pair, yaw: float, shift: Array, rule: Rule | None, decision: DecisionRule) -> PairResult:
    offset = _offset(pair, yaw, shift)
    distance_mm = float(np.hypot(*offset))
    clearance_mm = None
    if pair.room_mm is not None:
        clearance_mm = pair.room_mm - max(end.length_mm for end in _ends(pair, yaw, shift))
    u_mm = standard_uncertainty(pair.covariance)
    decided = Decision(Verdict.NOT_ASSESSED, None)
    if rule is not None:
        decided = decide_radial(offset, pair.covariance, rule.upper, decision)
    collides = clearance_mm is not None and clearance_mm < 0.0
    return PairResult(
        sleeve=pair.sleeve,
        rebar=pair.rebar,
        offset_mm=(float(offset[0]), float(offset[1])),
        distance_mm=distance_mm,
        u_mm=u_mm,
        limit_mm=None if rule is None else rule.upper,
        clearance_mm=clearance_mm,
        verdict=Verdict.FAIL if collides else decided.verdict,
        reason=_reason(pair, distance_mm, u_mm, clearance_mm, rule, decided.verdict),
        probability=decided.probability,
    )


def _best_pair(pair: Pair, limit_mm: float, fit: BestFit, rule: Rule | None, decision: DecisionRule) -> BestPair:
    found = _evaluate(pair, fit.yaw, fit.shift, rule, decision)
    by_distance = Verdict.NOT_ASSESSED
    if rule is not None:
        offset = _offset(pair, fit.yaw, fit.shift)
        by_distance = verdict_radial(offset, pair.covariance, rule.upper, decision)
    decided = [by_distance, *_room_verdicts(pair, fit, decision)]
    verdict = worst(one for one in decided if one is not Verdict.NOT_ASSESSED)
    if all(one is Verdict.NOT_ASSESSED for one in decided):
        verdict = Verdict.NOT_ASSESSED
    known = {item.name: getattr(found, item.name) for item in fields(PairResult)}
    return BestPair(
        **{**known, "verdict": verdict, "reason": found.reason or _close(pair, found, verdict)},
        room_mm=found.clearance_mm,
        u_room_mm=None if found.clearance_mm is None else _room_u_mm(pair, fit),
        allowance_mm=pair.room_mm,
        margin=_margin(pair, limit_mm, fit),
        seen_length_mm=pair.seen_length_mm,
    )


def _room_verdicts(pair: Pair, fit: BestFit, decision: DecisionRule) -> list[Verdict]:
    if pair.room_mm is None:
        return []
    sized = pair.room_u_mm**2 * np.eye(2)
    return [
        verdict_radial(end.gap, _sum(end.covariance, sized), pair.room_mm, decision)
        for end in _ends(pair, fit.yaw, fit.shift)
    ]


def _room_u_mm(pair: Pair, fit: BestFit) -> float | None:
    """Standard uncertainty of the room that is left: along the gap at the nearer end, and of the diameters."""
    end = max(_ends(pair, fit.yaw, fit.shift), key=lambda one: one.length_mm)
    if end.covariance is None:
        return None
    along = end.gap / end.length_mm if end.length_mm > 0.0 else np.array([1.0, 0.0])
    return math.sqrt(max(float(along @ end.covariance @ along), 0.0) + pair.room_u_mm**2)


def _margin(pair: Pair, limit_mm: float, fit: BestFit) -> float | None:
    ratios = [float(np.hypot(*_offset(pair, fit.yaw, fit.shift))) / limit_mm]
    if pair.room_mm is not None:
        if pair.room_mm <= 0.0:
            return None
        ratios += [end.length_mm / pair.room_mm for end in _ends(pair, fit.yaw, fit.shift)]
    return 1.0 - max(ratios)


def _close(pair: Pair, found: PairResult, verdict: Verdict) -> str:
    """The reason where the distance is decided and the room is not."""
    if verdict is not Verdict.INCONCLUSIVE or found.clearance_mm is None:
        return ""
    return Reason("assembly.little_room", rebar=pair.rebar, room_mm=found.clearance_mm, sleeve=pair.sleeve)


def _reason(
    pair: Pair,
    distance_mm: float,
    u_mm: float | None,
    clearance_mm: float | None,
    rule: Rule | None,
    verdict: Verdict,
) -> str:
    texts = []
    if rule is not None and verdict in (Verdict.FAIL, Verdict.INCONCLUSIVE):
        limit = describe_limit(rule)
        texts.append(
            Reason("assembly.from_centre", rebar=pair.rebar, distance_mm=distance_mm, sleeve=pair.sleeve, limit=limit)
        )
        if verdict is Verdict.INCONCLUSIVE:
            texts = [Reason("assembly.close", what=texts[0], u_mm=u_mm or 0.0)]
    if clearance_mm is not None and clearance_mm < 0.0:
        texts.append(Reason("assembly.collides", rebar=pair.rebar, sleeve=pair.sleeve, missing_mm=-clearance_mm))
    return in_one(texts)


@dataclass(frozen=True, eq=False)
class CommonLean:
    """How far all ``bars`` and all ``sleeves`` move together over the embedded length, (2,) mm each; zero for none."""

    bars: Array
    sleeves: Array

    def __bool__(self) -> bool:
        return bool(self.bars.any() or self.sleeves.any())

    def taken_off(self, pairs: Sequence[Pair]) -> tuple[Pair, ...]:
        """The pairs with their axes against the mean of all, and not against the vertical of the scans."""
        return tuple(
            replace(pair, bar_shift=pair.bar_shift - self.bars, sleeve_shift=pair.sleeve_shift - self.sleeves)
            for pair in pairs
        )

    def in_words(self, length_mm: float) -> str:
        """``all bars lean alike by 0.8°``, with what it may mean."""
        found = [
            Reason(
                "assembly.lean_alike", name=name, lean_deg=math.degrees(math.atan2(float(np.hypot(*shift)), length_mm))
            )
            for name, shift in (("bars", self.bars), ("sleeves", self.sleeves))
            if shift.any()
        ]
        return Reason("assembly.common_lean", found=found)


def other_readings(pairs: Sequence[Pair], length_mm: float) -> Iterator[tuple[str, tuple[Pair, ...]]]:
    """What else the axes may be, in words, and the pairs as they then are; lengths in mm."""
    if shared := common_lean(pairs, length_mm):
        yield shared.in_words(length_mm), shared.taken_off(pairs)
    own_mm = np.array([pair.bar_shift for pair in pairs])
    own_mm = np.hypot(*(own_mm - _shared(own_mm, length_mm)).T)
    seen_mm = np.array([length_mm if pair.seen_length_mm is None else pair.seen_length_mm for pair in pairs])
    bent = (own_mm > math.tan(_BENT_RAD) * length_mm) & (seen_mm < length_mm)
    if bent.any():
        said = Reason(
            "assembly.bent",
            rebars=[pair.rebar for pair, one in zip(pairs, bent.tolist(), strict=True) if one],
            lean_deg=math.degrees(math.atan2(float(own_mm[bent].max()), length_mm)),
            seen_mm=float(seen_mm[bent].min()),
        )
        parts = np.where(bent, seen_mm / length_mm, 1.0).tolist()
        yield (
            said,
            tuple(replace(pair, bar_shift=part * pair.bar_shift) for pair, part in zip(pairs, parts, strict=True)),
        )


def common_lean(pairs: Sequence[Pair], length_mm: float) -> CommonLean:
    """The lean that the axes share, as far as it is no chance; parameters in mm over the embedded length."""
    return CommonLean(
        _shared(np.array([pair.bar_shift for pair in pairs]), length_mm),
        _shared(np.array([pair.sleeve_shift for pair in pairs]), length_mm),
    )


def _shared(shifts: Array, length_mm: float) -> Array:
    if len(shifts) < _FEWEST:
        return np.zeros(2)
    middle = median(shifts, axis=0)
    scatter_mm = TO_SIGMA * float(median(np.abs(shifts - middle)))
    chance_mm = OF_MEDIAN * scatter_mm / math.sqrt(len(shifts))
    length = float(np.hypot(*middle))
    counts = length > max(_SIGMAS * chance_mm, math.tan(_SMALLEST_RAD) * length_mm)
    return np.asarray(middle) if counts else np.zeros(2)
