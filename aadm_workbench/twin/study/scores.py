"""What many errors come to: mean, spread, bias, honesty of the stated uncertainty, and time."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from statistics import median

import numpy as np

from aadm_workbench.model import Array, Kind, Vector2
from aadm_workbench.twin.study.errors import FeatureError
from aadm_workbench.twin.study.methods import PUBLISHED, BareTime, Measurement, MethodStudy

Z_95 = 1.96
"""Two-sided 95 % of the normal law."""

FLAGGED_WITHIN_U = 3.0
"""An error within this multiple of its own uncertainty was announced by it."""


@dataclass(frozen=True)
class Spread:
    """Absolute errors: mean with its 95 % interval (mean ± 1.96 sd/√n), standard deviation (n - 1), and so on, mm."""

    count: int
    mean_mm: float
    sd_mm: float
    interval_mm: Vector2
    rmse_mm: float
    median_mm: float
    largest_mm: float


@dataclass(frozen=True)
class Score:
    """One method on all scans of one setting and kind.

    Signed means of the centre error: ``radial_mm`` away from the camera's foot point, ``x_mm`` and ``y_mm`` along the
    image. ``unflagged_mm`` is the largest error beyond three of its own u (every error, where a method states no u);
    ``coverage`` the share of true centres within the 95 % region. Times are medians over the scans;
    ``times_fusion`` and ``times_bare`` medians of the ratio on the same scan. What has no data is None.
    """

    setting: str
    method: str
    kind: Kind
    expected: int
    found: int
    false: int
    diameter: Spread | None
    spacing: Spread | None
    centre: Spread | None
    radial_mm: float | None
    x_mm: float | None
    y_mm: float | None
    unflagged_mm: float | None
    coverage: float | None
    seconds: float
    times_fusion: float | None
    times_bare: float | None


def scores(study: MethodStudy) -> tuple[Score, ...]:
    """A score for each setting, method and kind of a study, in that order."""
    return tuple(
        _score(study, [m for m in study.measurements if (m.setting, m.method, m.kind) == (setting, method, kind)])
        for setting in study.settings
        for method in study.methods
        for kind in Kind
    )


def bare_seconds(study: MethodStudy, setting: str, kind: Kind) -> float | None:
    """Median of the bare calls over the scans of one setting and kind; None where they were not timed."""
    seconds = [b.seconds for b in study.bare if (b.setting, b.kind) == (setting, kind) and b.seconds is not None]
    return median(seconds) if seconds else None


def spread_of(errors_mm: Iterable[float | None]) -> Spread | None:
    """Sum up errors of either sign; None where there is none."""
    size = np.abs([error for error in errors_mm if error is not None])
    if len(size) == 0:
        return None
    mean, sd = float(size.mean()), float(size.std(ddof=1)) if len(size) > 1 else 0.0
    reach = Z_95 * sd / float(np.sqrt(len(size)))
    return Spread(
        len(size),
        mean,
        sd,
        (mean - reach, mean + reach),
        float(np.sqrt((size**2).mean())),
        float(np.median(size)),
        float(size.max()),
    )


def largest_unflagged_mm(features: Iterable[FeatureError]) -> float | None:
    """The largest centre error that its own uncertainty did not announce; None where all were announced."""
    hidden = [
        feature.distance_mm
        for feature in features
        if feature.distance_mm is not None
        and (feature.u_mm is None or feature.distance_mm > FLAGGED_WITHIN_U * feature.u_mm)
    ]
    return max(hidden, default=None)


def _score(study: MethodStudy, measured: list[Measurement]) -> Score:
    first = measured[0]
    features = [feature for m in measured for feature in m.comparison.features]
    found = [feature for feature in features if feature.error_mm is not None]
    signed = _signed(found)
    covered = [feature.covered for feature in found if feature.covered is not None]
    return Score(
        setting=first.setting,
        method=first.method,
        kind=first.kind,
        expected=len(features),
        found=len(found),
        false=sum(m.comparison.false for m in measured),
        diameter=spread_of(feature.diameter_error_mm for feature in found),
        spacing=spread_of(spacing.error_mm for m in measured for spacing in m.comparison.spacings),
        centre=spread_of(feature.distance_mm for feature in found),
        radial_mm=None if signed is None else float(signed[0]),
        x_mm=None if signed is None else float(signed[1]),
        y_mm=None if signed is None else float(signed[2]),
        unflagged_mm=largest_unflagged_mm(found),
        coverage=float(np.mean(covered)) if covered else None,
        seconds=median(m.seconds for m in measured),
        times_fusion=_ratio(measured, [m for m in study.measurements if m.method == PUBLISHED]),
        times_bare=_ratio(measured, study.bare),
    )


def _signed(found: list[FeatureError]) -> Array | None:
    """Mean errors (3,) mm: radial, x, y."""
    rows = [(f.radial_mm, *f.error_mm) for f in found if f.error_mm is not None and f.radial_mm is not None]
    return np.asarray(np.mean(rows, axis=0), np.float64) if rows else None


def _ratio(measured: list[Measurement], others: Iterable[Measurement] | Iterable[BareTime]) -> float | None:
    """Median over the scans of one time by another on the same scan."""
    by_scan = {(other.setting, other.scene, other.kind): other.seconds for other in others}
    ratios = []
    for m in measured:
        other = by_scan.get((m.setting, m.scene, m.kind))
        if other:
            ratios.append(m.seconds / other)
    return median(ratios) if ratios else None
