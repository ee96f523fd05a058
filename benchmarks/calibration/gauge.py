"""Simulated gauge studies of known variances: how often intervals hold them, and what is said of the stated u.

``python -m benchmarks.calibration.gauge --studies 200``. Captures are made with complex numbers: a ring of sleeves,
moved, turned by each capture and brought back by a fit, which takes its share of the scatter; operators see each
sleeve beside its place by an amount of their own; repeats scatter by an even law as often as by a normal one.
"""

from __future__ import annotations

import argparse
from collections import Counter
from dataclasses import dataclass

import numpy as np

from aadm_workbench.calibration.gauge.anova import Estimate
from aadm_workbench.calibration.gauge.captures import Capture
from aadm_workbench.calibration.gauge.study import QuantityStudy, gauge_study
from aadm_workbench.model import Array
from tests.calibration.test_gauge import report

_KINDS = ((10, 1, 3), (10, 1, 4), (12, 3, 3), (12, 2, 4), (12, 4, 2))
"""Parts, operators, repeats: the first is the study of ten minutes."""

_OF_A_POSE = 3  # unknowns that a fit to design takes from the coordinates of a capture


@dataclass(frozen=True)
class PutIn:
    """Standard deviations per axis, mm, as they are after the fit of each capture to design."""

    repeat: float
    operator: float
    parts: float

    @property
    def gauge(self) -> float:
        """What the gauge adds: repeats and operators."""
        return float(np.hypot(self.repeat, self.operator))


def main() -> None:
    """Print a line for each kind of study."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--studies", type=int, default=200, help="of all kinds together")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    for kind in _KINDS:
        held: Counter[str] = Counter()
        said: Counter[str] = Counter()
        count = options.studies // len(_KINDS)
        for _ in range(count):
            sigma = PutIn(*rng.uniform([0.02, 0.0 if kind[1] == 1 else 0.01, 0.2], [0.08, 0.06, 0.8]))
            sigma = PutIn(sigma.repeat, 0.0 if kind[1] == 1 else sigma.operator, sigma.parts)
            held.update(_held(_study(kind, sigma, sigma.gauge, rng), sigma))
            for share in (1.0, 0.5):
                code = _study(kind, sigma, share * sigma.gauge, rng).stated.reason.code.partition(".")[2]
                said[f"{'honest' if share == 1.0 else 'half'} u: {code}"] += 1
        print(f"{kind[0]} sleeves, {kind[1]} operators, {kind[2]} captures each; {count} studies")
        print("  held by their 95 % intervals:", ", ".join(f"{name} {held[name] / count:.0%}" for name in sorted(held)))
        print("  said:", ", ".join(f"{name} {said[name] / count:.0%}" for name in sorted(said)))


def _held(found: QuantityStudy, sigma: PutIn) -> list[str]:
    variances, parts = found.variances, found.study.values.shape[1]
    each: dict[str, tuple[Estimate | None, float]] = {
        "repeatability": (variances.repeatability, sigma.repeat),
        "reproducibility": (variances.reproducibility, sigma.operator),
        "gauge": (variances.gauge, sigma.gauge),
        "parts": (variances.parts, sigma.parts * float(np.sqrt(parts / (parts - 1.0)))),
    }
    # parts scatter about their own mean, which the fit has taken
    return [name for name, (one, true) in each.items() if one is not None and one.low <= true**2 <= one.high]


def _study(kind: tuple[int, int, int], sigma: PutIn, u_mm: float, rng: np.random.Generator) -> QuantityStudy:
    parts, operators, repeats = kind
    ring = 240.0 * np.exp(2j * np.pi * (np.arange(parts) + rng.uniform(-0.1, 0.1, parts)) / parts)
    own, even = sigma.parts * _drawn(parts, rng), rng.uniform() < 0.5
    captures = []
    for operator in "ABCD"[:operators]:
        bent = sigma.operator * _drawn(parts, rng)
        for repeat in range(repeats):
            off = own + bent + sigma.repeat * _drawn(parts, rng, even=even)
            seen = (ring + off) * np.exp(1j * rng.uniform(-0.02, 0.02)) + complex(*rng.normal(0.0, 50.0, 2))
            left = _fitted(seen, ring) - ring
            offsets = np.column_stack([left.real, left.imag])
            captures.append(Capture(f"{operator}{repeat}", operator, report(offsets, u_mm, operator)))
    return gauge_study(captures, np.random.default_rng(1)).quantities[0]


def _drawn(parts: int, rng: np.random.Generator, *, even: bool = False) -> Array:
    """Complex numbers (n,) that scatter by one per axis once a pose was fitted to them."""
    axes = rng.uniform(-np.sqrt(3.0), np.sqrt(3.0), (2, parts)) if even else rng.normal(0.0, 1.0, (2, parts))
    return np.asarray((axes[0] + 1j * axes[1]) / np.sqrt(1.0 - _OF_A_POSE / (2.0 * parts)))


def _fitted(seen: Array, ring: Array) -> Array:
    """Brought back by a shift and a turn."""
    about, known = seen - seen.mean(), ring - ring.mean()
    turn = np.vdot(about, known)
    return np.asarray(about * turn / abs(turn) + ring.mean())


if __name__ == "__main__":
    main()
