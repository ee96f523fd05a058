"""A column that swings on its rope: where it would come to rest, how far it swings about that, and how fast.

All that is told of a swing is a handful of places with their times. The law is y(t) = e + a cos ωt + b sin ωt in each
axis; its period is known only to lie within what ropes give, so all periods and all sizes of swings are weighed by how
likely they make what was seen. Frames that follow each other fast, or at the pace of the swing itself, leave large
swings likely, and the answer says so.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array

PERIODS_S = np.geomspace(1.5, 12.0, 90)
"""A free rope of 0.6 to 36 m, by T = 2π √(l/g); tag lines only shorten it."""

# standard deviation of a law that is even over the logarithm
_BETWEEN_PERIODS = float(np.log(PERIODS_S[1] / PERIODS_S[0])) / np.sqrt(12.0)

SIZES_MM = np.geomspace(0.02, 25.0, 15)
"""Standard deviations of a swing's parts: from less than a frame's noise to what leaves the picture."""

_REST_MM = 30.0  # of the rest about the newest place: farther off no frame is measured
_PUSHES_MM = np.array([0.5, 1.0, 2.0, 5.0, 10.0, 20.0])  # how far a push moves it, per axis: each as likely
_PUSH_LOG_ODDS = np.log(0.3)  # of a push before a frame, against none: crews push after every third frame or so
_NODES = ((-np.sqrt(3.0), 1 / 6), (0.0, 2 / 3), (np.sqrt(3.0), 1 / 6))  # Gauss-Hermite, of a normal law
_FEWEST = 3  # frames: a rest and a swing have as many unknowns
_SURE = 0.95  # as verdicts are


@dataclass(frozen=True)
class Swing:
    """What times and places say of a swing, mm and s.

    ``rest`` (m,) is the equilibrium and ``rest_u_mm`` its standard uncertainty per axis; ``amplitude_mm`` is what the
    swing about it does not exceed with a probability of 95 %; ``period_s`` is None where it hardly swings. ``frames``
    counts the newest frames, since a push, that say so.
    """

    rest: Array
    rest_u_mm: float
    amplitude_mm: float
    period_s: float | None
    frames: int


def swing_of(times_s: Array, places: Array, noise_mm: float) -> Swing | None:
    """The swing that the newest of some places show.

    Parameters
    ----------
    times_s
        (n,), increasing.
    places
        (n, m) mm.
    noise_mm
        Standard deviation of a place per axis, from frame to frame.

    Returns
    -------
    None where fewer than three frames were taken since the last push.
    """
    begin = _since_push(times_s, places, noise_mm)
    times_s, places = times_s[begin:] - times_s[-1], places[begin:]
    if len(times_s) < _FEWEST:
        return None
    log_odds, parts, covariance = _weighed(times_s, places, noise_mm)
    weights = np.exp(log_odds - log_odds.max())
    weights /= weights.sum()
    rest = np.einsum("ts,tsm->m", weights, parts[:, :, 0])
    apart = parts[:, :, 0] - rest
    variance = float((weights * (covariance[..., 0, 0] + (apart**2).mean(axis=-1))).sum())
    amplitude_mm = _amplitude(parts, covariance, weights)
    swings = amplitude_mm > 4.0 * noise_mm
    period_s = float(np.exp(weights.sum(axis=1) @ np.log(PERIODS_S))) if swings else None
    return Swing(rest, float(np.sqrt(variance)), amplitude_mm, period_s, len(times_s))


def _since_push(times_s: Array, places: Array, noise_mm: float) -> int:
    """The first frame since the last push: where it is likeliest that one swing ends and another begins."""
    square = ((places - places[-1]) ** 2).sum(axis=1)[:, None] / _PUSHES_MM**2
    each = -0.5 * (square + places.shape[1] * np.log(2.0 * np.pi * _PUSHES_MM**2))
    away = np.logaddexp.reduce(each, axis=1) - np.log(len(_PUSHES_MM))
    odds = [_log_evidence(times_s, places, noise_mm)]
    for first in range(1, len(times_s)):
        # what lies before is one swing too, or was pushed about by itself
        earlier = away[first - 1] + _log_evidence(times_s[:first], places[:first], noise_mm)
        earlier = max(earlier, float(away[:first].sum()))
        odds.append(_PUSH_LOG_ODDS + earlier + _log_evidence(times_s[first:], places[first:], noise_mm))
    return int(np.argmax(odds))


def _log_evidence(times_s: Array, places: Array, noise_mm: float) -> float:
    log_odds = _weighed(times_s - times_s[-1], places, noise_mm)[0]
    return float(np.logaddexp.reduce(log_odds.ravel()) - np.log(len(PERIODS_S) * SIZES_MM.sum()))


def _weighed(times_s: Array, places: Array, noise_mm: float) -> tuple[Array, Array, Array]:
    """For each period and size: log of the likelihood, the parts (t, s, 3, m) e, a, b, and their covariance."""
    phases = 2.0 * np.pi * times_s[None, :] / PERIODS_S[:, None]
    system = np.stack([np.ones_like(phases), np.cos(phases), np.sin(phases)], axis=-1)
    prior = np.stack([np.full_like(SIZES_MM, _REST_MM), SIZES_MM, SIZES_MM], axis=-1) ** -2.0
    # a true period between two of the list runs ahead of them by a phase that grows with the time
    weight = 1.0 / (noise_mm**2 + (SIZES_MM[:, None] * (phases * _BETWEEN_PERIODS)[:, None]) ** 2)
    normal = np.einsum("tsn,tni,tnj->tsij", weight, system, system, optimize=True) + prior[:, :, None] * np.eye(3)
    about = places - places[-1]
    right = np.einsum("tsn,tni,nm->tsim", weight, system, about, optimize=True)
    covariance = np.linalg.inv(normal)
    parts = covariance @ right
    explained = (parts * right).sum(axis=(2, 3))
    spread = np.linalg.slogdet(normal)[1] - np.log(prior).sum(axis=-1) - np.log(weight / (2.0 * np.pi)).sum(axis=-1)
    whole = weight @ (about**2).sum(axis=1)
    parts[:, :, 0] += places[-1]
    # every size in mm is as likely as another beforehand: the list of them is logarithmic
    return np.log(SIZES_MM) - 0.5 * (whole - explained + about.shape[1] * spread), parts, covariance


def _amplitude(parts: Array, covariance: Array, weights: Array) -> float:
    """What the longer half-axis of the swing's ellipse does not exceed, with a probability of 95 %."""
    longest = np.linalg.norm(parts[:, :, 1:], ord=2, axis=(2, 3))
    spread = np.sqrt(np.linalg.eigvalsh(covariance[..., 1:, 1:])[..., -1])
    lengths = np.concatenate([np.abs(longest + z * spread).ravel() for z, _ in _NODES])
    shares = np.concatenate([share * weights.ravel() for _, share in _NODES])
    order = np.argsort(lengths)
    at = int(np.searchsorted(np.cumsum(shares[order]), _SURE))
    return float(lengths[order][min(at, len(lengths) - 1)])
