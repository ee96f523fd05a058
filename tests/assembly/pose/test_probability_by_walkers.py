"""The probability that a pose exists, against walkers that draw by another method and poses found by another solver."""

import numpy as np
import pytest
from scipy import stats

from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.pose_probability import probability_of_a_pose
from aadm_workbench.model import Array
from benchmarks.columns import PATTERNS
from benchmarks.smooth_margin import margins_mm

LIMIT_MM, WALKERS, SETTLE, SNAPSHOTS, BETWEEN = 3.0, 800, 100, 3, 25
STUDENT = 0  # of the two laws


class Walkers:
    """Metropolis steps of many walkers in true offsets, pose, width and law, by the densities as they are stated."""

    def __init__(self, places: Array, measured: Array, u_mm: Array, rng: np.random.Generator) -> None:
        self.measured, self.u_mm, self.rng, count = measured, u_mm, rng, len(places)
        self.by_pose = np.zeros((count, 2, 3))
        self.by_pose[:, 0, 0] = self.by_pose[:, 1, 1] = 1.0
        self.by_pose[:, :, 2] = np.column_stack([-places[:, 1], places[:, 0]]) / np.abs(places).max()
        self.offsets = measured + u_mm[:, None] * rng.normal(size=(WALKERS, count, 2))
        flat = self.by_pose.reshape(-1, 3)
        self.pose = -np.linalg.lstsq(flat, self.offsets.reshape(WALKERS, -1).T, rcond=None)[0].T
        self.log_width = rng.normal(0.0, 0.3, WALKERS)
        self.law = rng.integers(0, 2, WALKERS)

    def scatter(self, offsets: Array, pose: Array) -> Array:
        return np.asarray(offsets + np.einsum("ndj,kj->knd", self.by_pose, pose))

    def of_pairs(self, scatter: Array, log_width: Array, law: Array) -> Array:
        """Log density (k, n) of the scatter: the normal law in the plane, or Student's with four degrees of freedom."""
        width = np.exp(log_width)[:, None]
        lengths = np.hypot(scatter[..., 0], scatter[..., 1]) / width
        # In the plane: the square of a length by Student's law is twice an F, by the normal law a chi-square.
        student = stats.f.logpdf(lengths**2 / 2.0, 2, 4)
        normal = stats.chi2.logpdf(lengths**2, 2) + np.log(2.0)
        return np.asarray(np.where(law[:, None] == STUDENT, student, normal) - 2.0 * log_width[:, None])

    def of_width(self, log_width: Array) -> Array:
        """Flat in the width, but for the usual 0.7 mm of bars and sleeves, which counts as one pair."""
        return np.asarray(stats.invgamma.logpdf(np.exp(2.0 * log_width), 0.5, scale=2.0 * 0.7**2) + 2.0 * log_width)

    def accept(self, gain: Array) -> Array:
        return np.asarray(np.log(self.rng.uniform(size=gain.shape)) < gain)

    def step(self) -> None:
        rng = self.rng
        now = self.of_pairs(self.scatter(self.offsets, self.pose), self.log_width, self.law)
        # Every pair by itself, in steps as wide as it is known, or as pairs scatter.
        reach = np.minimum(self.u_mm, 1.0)[:, None] * np.where(rng.uniform(size=(WALKERS, 1, 1)) < 0.5, 1.0, 2.5)
        moved = self.offsets + reach * rng.normal(size=self.offsets.shape)
        then = self.of_pairs(self.scatter(moved, self.pose), self.log_width, self.law)
        misfit = [(((self.measured - at) / self.u_mm[:, None]) ** 2).sum(axis=2) for at in (self.offsets, moved)]
        better = self.accept(then - now + (misfit[0] - misfit[1]) / 2.0)
        self.offsets = np.where(better[..., None], moved, self.offsets)
        now = np.where(better, then, now).sum(axis=1)
        posed = self.pose + 0.35 * rng.normal(size=self.pose.shape)
        then = self.of_pairs(self.scatter(self.offsets, posed), self.log_width, self.law).sum(axis=1)
        better = self.accept(then - now)
        self.pose, now = np.where(better[:, None], posed, self.pose), np.where(better, then, now)
        wider, other = self.log_width + 0.35 * rng.normal(size=WALKERS), rng.integers(0, 2, WALKERS)
        then = self.of_pairs(self.scatter(self.offsets, self.pose), wider, other).sum(axis=1)
        better = self.accept(then + self.of_width(wider) - now - self.of_width(self.log_width))
        self.log_width, self.law = np.where(better, wider, self.log_width), np.where(better, other, self.law)


def by_walkers(places: Array, measured: Array, u_mm: Array, rng: np.random.Generator) -> float:
    """Share of the walkers whose offsets leave a pose, found by Newton's method on a smooth maximum."""
    walkers, shares = Walkers(places, measured, u_mm, rng), []
    for snapshot in range(SNAPSHOTS):
        for _ in range(BETWEEN if snapshot else SETTLE):
            walkers.step()
        bars = places + walkers.offsets
        found = margins_mm(bars, np.broadcast_to(places, bars.shape), np.full(bars.shape[:2], LIMIT_MM))
        shares.append(float((found >= 0.0).mean()))
    return float(np.mean(shares))


@pytest.mark.parametrize(("pattern", "scatter_mm", "hardly"), [("four", 2.6, 1), ("double row", 1.1, 3)])
def test_stated_is_what_walkers_find(pattern: str, scatter_mm: float, hardly: int) -> None:
    """Known to 0.3 mm, some pairs to 2.5 mm: there, all hangs on which law the pairs scatter by, and on its width."""
    rng = np.random.default_rng([hardly, int(10.0 * scatter_mm)])
    places = PATTERNS[pattern] - PATTERNS[pattern].mean(axis=0)
    u_mm = np.where(np.arange(len(places)) < hardly, 2.5, 0.3)
    measured = rng.normal(0.0, np.hypot(scatter_mm, u_mm)[:, None], (len(places), 2))
    pairs = [
        Pair(f"S{k}", f"R{k}", place, place + offset, np.zeros(2), np.zeros(2), None, u**2 * np.eye(2))
        for k, (place, offset, u) in enumerate(zip(places, measured, u_mm, strict=True))
    ]
    stated = probability_of_a_pose(pairs, np.full(len(places), LIMIT_MM), np.random.default_rng(1), 3000)
    expected = by_walkers(places, measured, u_mm, rng)
    assert 0.3 < expected < 0.97
    # Three thousand draws here, some two thousand there: 0.007 each. Tails in every column would be 0.06 too low.
    assert stated == pytest.approx(expected, abs=0.035)
