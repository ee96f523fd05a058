"""How often verdicts are right, on random cases whose truth is known exactly.

    python benchmarks/verdict.py [--cases 10000] [--seed 1]

Nothing is measured in seconds: the same numbers come out on every machine.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule, decide_probability, decide_radial
from aadm_workbench.assembly.matching.match import match_points
from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.eopa import EopaFit, fit_eopa_planar, turn
from aadm_workbench.assembly.pose.minimax import MinimaxPose, fit_minimax
from aadm_workbench.assembly.pose.pose_probability import probability_of_a_pose
from aadm_workbench.assembly.repair.bends import advise_repair
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial.virtual import try_assembly
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.model import Array, RepairReport, TrialReport, Verdict
from aadm_workbench.twin.parts import ring

FIELD = ring(240.0, 240.0, 4)
LAB = ring(90.0, 90.0, 4)
LIMIT_MM = 3.0
_REPAIRED = 3  # of the scenes, those that are repaired too


@dataclass(frozen=True)
class Feasibility:
    """Minimax verdicts at zero noise against the truth; ``error_mm`` is the largest error of the largest distance."""

    cases: int
    feasible: int
    rejected_though_feasible: int
    accepted_though_infeasible: int
    error_mm: float


def feasibility(cases: int, rng: np.random.Generator) -> Feasibility:
    """Cases whose smallest largest distance is known, because the conditions of its optimum were built into them."""
    counts: Counter[tuple[bool, bool]] = Counter()
    worst_mm = 0.0
    for _ in range(cases):
        true_mm = _true_distance(rng)
        source, target = _case_of(true_mm, FIELD if rng.random() < 0.5 else LAB, rng)
        pose = fit_minimax(source, target, np.full(len(source), LIMIT_MM))
        assert isinstance(pose, MinimaxPose)
        counts[true_mm <= LIMIT_MM, pose.ratio <= 1.0] += 1
        worst_mm = max(worst_mm, abs(pose.ratio * LIMIT_MM - true_mm))
    feasible = counts[True, True] + counts[True, False]
    return Feasibility(cases, feasible, counts[True, False], counts[False, True], worst_mm)


def _true_distance(rng: np.random.Generator) -> float:
    """Half of the cases anywhere from 1.5 to 5 mm, half a hair beside the limit."""
    if rng.random() < 0.5:
        return float(rng.uniform(1.5, 5.0))
    side = 1.0 if rng.random() < 0.5 else -1.0
    return float(LIMIT_MM * (1.0 + side * 10.0 ** rng.uniform(-7.0, -2.0)))


def _case_of(true_mm: float, target: Array, rng: np.random.Generator) -> tuple[Array, Array]:
    """Bars and sleeves (12, 2) whose minimax distance is exactly this.

    Four pairs are in contact, in directions u_i that some weights λ_i > 0 balance: Σλu = 0 and Σλ·(u × r) = 0. No
    small motion shortens all four, and all other pairs are nearer.
    """
    while True:
        contact = rng.choice(len(target), 4, replace=False)
        angle = rng.uniform(0.0, 2.0 * np.pi, 4)
        directions = np.column_stack([np.cos(angle), np.sin(angle)])
        moments = target[contact, 0] * directions[:, 1] - target[contact, 1] * directions[:, 0]
        weights = np.linalg.svd(np.vstack([directions.T, moments / 100.0]))[2][-1]
        if (weights > 0.02).all() or (weights < -0.02).all():
            break
    offsets = rng.normal(size=target.shape)
    offsets *= (true_mm * 0.999 * np.sqrt(rng.uniform(size=len(target))) / np.hypot(*offsets.T))[:, None]
    offsets[contact] = true_mm * directions
    placed = (target + offsets) @ turn(rng.uniform(-3.0, 3.0)).T
    return placed + rng.uniform(-500.0, 500.0, 2), target


@dataclass(frozen=True)
class LeastSquares:
    """Of so many good columns, by minimax, least squares would have refused this share."""

    good: int
    share_refused: float


def least_squares(cases: int, rng: np.random.Generator, scatter_mm: float = 1.2) -> LeastSquares:
    """Scatter per axis of bar minus sleeve."""
    good, refused = 0, 0
    for _ in range(cases):
        source = FIELD + rng.normal(0.0, scatter_mm, FIELD.shape)
        pose, fit = fit_minimax(source, FIELD, np.full(12, LIMIT_MM)), fit_eopa_planar(source, FIELD)
        assert isinstance(pose, MinimaxPose)
        assert isinstance(fit, EopaFit)
        if pose.ratio <= 1.0:
            good += 1
            refused += bool(np.hypot(*fit.residuals.T).max() > LIMIT_MM)
    return LeastSquares(good, refused / max(good, 1))


@dataclass(frozen=True)
class Guarded:
    """Guarded verdicts against the truth.

    Shares: of passes that are wrong, of fails that are wrong, of bad ones that pass, of good ones that fail, of all
    that are decided, and of those further than 3 u from the limit that are inconclusive.
    """

    cases: int
    good: int
    passes: int
    fails: int
    wrong_of_passes: float
    wrong_of_fails: float
    bad_that_pass: float
    good_that_fail: float
    decided: float
    inconclusive_far_off: float


def guarded_points(
    cases: int, rng: np.random.Generator, *, limit_mm: float = LIMIT_MM, scatter_mm: float = 1.0, u_mm: float = 0.25
) -> Guarded:
    """Single distances in the plane: scatter and uncertainty per axis."""
    true = rng.normal(0.0, scatter_mm, (cases, 2))
    measured = true + rng.normal(0.0, u_mm, (cases, 2))
    covariance = u_mm**2 * np.eye(2)
    guarded: DecisionRule = "guarded"
    verdicts = [decide_radial(offset, covariance, limit_mm, guarded).verdict for offset in measured]
    return _judged(np.hypot(*true.T), verdicts, limit_mm, u_mm)


def guarded_trials(
    cases: int, rng: np.random.Generator, *, scatter_mm: float = 1.0, u_mm: float = 0.25, samples: int = 1000
) -> Guarded:
    """Whole trials of the field pattern: scatter and uncertainty per axis of bar minus sleeve."""
    limits = np.full(12, LIMIT_MM)
    true, verdicts = [], []
    for _ in range(cases):
        bars = FIELD + rng.normal(0.0, scatter_mm, FIELD.shape)
        pose = fit_minimax(bars, FIELD, limits)
        measured = bars + rng.normal(0.0, u_mm, FIELD.shape)
        start = fit_minimax(measured, FIELD, limits)
        assert isinstance(pose, MinimaxPose)
        assert isinstance(start, MinimaxPose)
        pairs = [
            Pair(f"S{k}", f"R{k}", FIELD[k], measured[k], np.zeros(2), np.zeros(2), None, u_mm**2 * np.eye(2))
            for k in range(12)
        ]
        probability = probability_of_a_pose(pairs, limits, np.random.default_rng(0), samples)
        true.append(pose.ratio * LIMIT_MM)
        verdicts.append(decide_probability(probability or 0.0, start.ratio <= 1.0))
    return _judged(np.array(true), verdicts, LIMIT_MM, u_mm)


def _judged(true_mm: Array, verdicts: list[Verdict], limit_mm: float, u_mm: float) -> Guarded:
    good = true_mm <= limit_mm
    passes, fails = (np.array([verdict is kind for verdict in verdicts]) for kind in (Verdict.PASS, Verdict.FAIL))
    far = np.abs(true_mm - limit_mm) > 3.0 * u_mm
    return Guarded(
        cases=len(verdicts),
        good=int(good.sum()),
        passes=int(passes.sum()),
        fails=int(fails.sum()),
        wrong_of_passes=_share(passes & ~good, passes),
        wrong_of_fails=_share(fails & good, fails),
        bad_that_pass=_share(passes & ~good, ~good),
        good_that_fail=_share(fails & good, good),
        decided=float((passes | fails).mean()),
        inconclusive_far_off=_share(far & ~passes & ~fails, far),
    )


def _share(some: Array, of: Array) -> float:
    return float(some.sum() / max(of.sum(), 1))


def turned_rings(cases: int, rng: np.random.Generator, scatter_mm: float = 0.8) -> dict[str, int]:
    """A square ring as built, turned by any multiple of 90 degrees, one in three with up to two points missing.

    Counted: ``ambiguous``; ``right`` and ``wrong`` of those that were resolved.
    """
    counts = Counter({"ambiguous": 0, "right": 0, "wrong": 0})
    design = np.column_stack([FIELD, np.zeros(12)])
    for _ in range(cases):
        built = FIELD + rng.normal(0.0, scatter_mm, FIELD.shape)
        kept = np.sort(rng.choice(12, 12 - int(rng.integers(0, 3)) * int(rng.random() < 1 / 3), replace=False))
        seen = rng.permutation(kept)
        flat = built[seen] @ turn(np.pi / 2.0 * int(rng.integers(4)) + rng.uniform(-0.05, 0.05)).T
        points = np.column_stack([flat + rng.uniform(-300.0, 300.0, 2), np.zeros(len(flat))])
        match = match_points(points, np.array([0.0, 0.0, 1.0]), design)
        if not match or match.orientation == "ambiguous":
            counts["ambiguous"] += 1
            continue
        matched = match.placements[0].matched
        right = all(seen[index] == place for place, index in enumerate(matched.tolist()) if index >= 0)
        counts["right" if right else "wrong"] += 1
    return dict(counts)


def like_the_paper(
    largest_mm: float, mean_mm: float, sd_mm: float, pattern: Array, sleeve_mm: float, rng: np.random.Generator
) -> tuple[TrialReport, RepairReport | None]:
    """A trial whose distances after least squares have this maximum, mean and standard deviation, and its advice."""
    offsets = _offsets_like(largest_mm, mean_mm, sd_mm, pattern, rng)
    table = {
        "centres": pattern.tolist(),
        "sleeve_diameter": sleeve_mm,
        "rebar_diameter": 18.0,
        "rebar_outer_diameter": 20.0,
        "embedded_length": 100.0,
    }
    design = inline_design("paper", table)
    covariance = 0.1**2 * np.eye(3)
    order = [int(np.argmin(np.hypot(*(pattern - point.centre[:2]).T))) for point in design.sleeves]
    sleeves = [replace(point, covariance=covariance) for point in design.sleeves]
    rebars = [
        replace(point, centre=point.centre + np.array([*offsets[k], 0.0]), covariance=covariance)
        for point, k in zip(design.rebars, order, strict=True)
    ]
    cn = load_profile("cn")
    trial = try_assembly(design, sleeves, rebars, cn, np.random.default_rng(0))
    return trial, advise_repair(design, sleeves, rebars, trial, cn, np.random.default_rng(0))


def _offsets_like(largest_mm: float, mean_mm: float, sd_mm: float, pattern: Array, rng: np.random.Generator) -> Array:
    """Offsets (n, 2) of these lengths that least squares cannot make smaller: no net shift and no net turn."""
    count = len(pattern)
    while True:
        rest = rng.normal(size=count - 1)
        rest_mean = (count * mean_mm - largest_mm) / (count - 1)
        squares = count * (sd_mm**2 + mean_mm**2) - largest_mm**2
        rest_sd = np.sqrt(squares / (count - 1) - rest_mean**2)
        rest = rest_mean + rest_sd * (rest - rest.mean()) / rest.std()
        if rest.min() > 0.0 and rest.max() < largest_mm:
            break
    lengths = rng.permutation(np.append(rest, largest_mm))
    angle = rng.uniform(0.0, 2.0 * np.pi, count)
    lever = np.hypot(*pattern.T).mean()
    for _ in range(200):
        x, y = lengths * np.cos(angle), lengths * np.sin(angle)
        left = np.array([x.sum(), y.sum(), (pattern[:, 0] * y - pattern[:, 1] * x).sum() / lever])
        slopes = np.stack([-y, x, (pattern[:, 0] * x + pattern[:, 1] * y) / lever])
        angle = angle - np.linalg.pinv(slopes) @ left
        if np.abs(left).max() < 1e-12:
            break
    return np.column_stack([lengths * np.cos(angle), lengths * np.sin(angle)])


def _print_columns(cases: int, rng: Callable[[int], np.random.Generator]) -> None:
    """So many whole columns, spread over all scenes; half as many assignments, repairs and parts of rows."""
    # Run as a script, this folder is on the path and not the one that holds it.
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    from benchmarks.columns import SCENES
    from benchmarks.judged_columns import calibration, judged_columns, repaired_columns
    from benchmarks.matching import matched_margins
    from benchmarks.periodic import periodic_views

    each = max(cases // len(SCENES), 1)
    judged = []
    for number, scene in enumerate(SCENES):
        judged.append(judged_columns(scene, each, rng(100 + number)))
        print("f. columns:", judged[-1], flush=True)
    print(f"   all {sum(found.cases for found in judged)} columns, by the probability that was stated:")
    stated, true = (np.concatenate(parts) for parts in ([j.stated for j in judged], [j.true for j in judged]))
    for one in calibration(stated, true):
        print(f"   stated {one.stated:.4f}, true {one.true:.4f} of {one.cases}: {one.sigmas:+.1f} sigma")
    for number, scene in enumerate(SCENES[:_REPAIRED]):
        print("g. one bar off:", repaired_columns(scene, max(cases // 40, 1), rng(200 + number)), flush=True)
        scattered = repaired_columns(scene, max(cases // 40, 1), rng(250 + number), None)
        print("g. any scatter:", scattered, flush=True)
    print("h. assignments:", matched_margins(max(cases // 2, 1), rng(300)))
    print("i. parts of rows:", periodic_views(max(cases // 20, 1), rng(301)))


def main() -> None:
    """Run everything and print it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=10_000, help="cases of the quick parts; others take a part of it")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    few = max(options.cases // 20, 1)

    def rng(part: int) -> np.random.Generator:
        return np.random.default_rng([options.seed, part])

    print("a. minimax at zero noise:", feasibility(options.cases, rng(0)))
    print("b. least squares, 1.2 mm per axis:", least_squares(options.cases, rng(1)))
    print("c. single points, limit 3 mm:", guarded_points(options.cases, rng(2)))
    print("c. single points, limit 2 mm:", guarded_points(options.cases, rng(3), limit_mm=2.0))
    print("c. trials, 1.0 mm per axis:", guarded_trials(few, rng(4)))
    print("c. trials, 1.6 mm per axis:", guarded_trials(few, rng(5), scatter_mm=1.6))
    print("d. square rings without up:", turned_rings(few, rng(6)))
    _print_columns(options.cases, rng)
    for name, values in {
        "laboratory": (2.39, 1.23, 0.53, LAB, 26.0),
        "field": (13.93, 8.34, 4.16, FIELD, 36.0),
    }.items():
        trial, repair = like_the_paper(*values, rng(7))
        squares, minimax = trial.least_squares, trial.minimax
        assert squares is not None
        assert minimax is not None
        numbers = f"max {squares.max_mm:.2f} mean {squares.mean_mm:.2f} sd {squares.sd_mm:.2f} mm"
        print(f"e. {name}: {numbers}, minimax {minimax.max_mm:.2f} mm: {trial.verdict.value}")
        if repair is not None:
            print(f"   {repair.advice}")


if __name__ == "__main__":
    main()
