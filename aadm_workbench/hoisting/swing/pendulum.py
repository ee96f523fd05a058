"""A column that swings on its rope: where it would come to rest, how far it swings about that, and how fast.

All that is told of a swing is a handful of places with their times. The law is y(t) = e + a cos ωt + b sin ωt in each
axis, where people at tag lines let a and b fade; its period is known only to lie within what ropes give, so all
periods, all dampings and all sizes of swings are weighed by how likely they make what was seen. Frames that follow each
other fast, or at the pace of the swing itself, leave large swings likely, and the answer says so; frames of one moment
tell none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array

PERIODS_S = np.geomspace(1.5, 12.0, 45)
"""A free rope of 0.6 to 36 m, by T = 2π √(l/g); tag lines only shorten it."""

# standard deviation of a law that is even over the logarithm
_BETWEEN_PERIODS = float(np.log(PERIODS_S[1] / PERIODS_S[0])) / np.sqrt(12.0)

DAMPINGS = np.array([0.0, 0.1, 0.25])
"""Of what would bring it to rest without a swing: a free rope, lines held loosely, and firmly; each as likely."""

_PERIOD_OF_LAW, _DAMPING_OF_LAW = (part.ravel() for part in np.meshgrid(PERIODS_S, DAMPINGS, indexing="ij"))

SIZES_MM = np.geomspace(0.02, 25.0, 15)
"""Standard deviations of a swing's parts: from less than a frame's noise to what leaves the picture."""

_REST_MM = 30.0  # of the rest about the newest place: farther off no frame is measured
_PUSHES_MM = np.array([0.5, 1.0, 2.0, 5.0, 10.0, 20.0])  # how far a push moves it, per axis: each as likely
_PUSH_LOG_ODDS = np.log(0.3)  # of a push before a frame, against none: crews push after every third frame or so
_NODES = ((-np.sqrt(3.0), 1 / 6), (0.0, 2 / 3), (np.sqrt(3.0), 1 / 6))  # Gauss-Hermite, of a normal law
_FEWEST = 3  # frames: a rest and a swing have as many unknowns
_SHORTEST_S = 1.5  # a quarter of the period of 9 m of rope: in less, a column at the turn of its swing seems to stand
_SURE = 0.95  # as verdicts are


@dataclass(frozen=True)
class Swing:
    """What times and places say of a swing, mm and s.

    ``rest`` (m,) is the equilibrium and ``rest_u_mm`` its standard uncertainty per axis; ``amplitude_mm`` is what the
    swing about it does not exceed from now on, with a probability of 95 %; ``period_s`` is None where it hardly swings.
    ``frames`` counts the newest frames, since a push, that say so.
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
    None where fewer than three frames were taken since the last push, or all of them within a moment.
    """
    begin = _since_push(times_s, places, noise_mm)
    times_s, places = times_s[begin:] - times_s[-1], places[begin:]
    if len(times_s) < _FEWEST or -times_s[0] < _SHORTEST_S:
        return None
    log_odds, parts, covariance = _weighed(times_s, places, noise_mm)
    weights = np.exp(log_odds - log_odds.max())
    weights /= weights.sum()
    rest = np.einsum("ts,tsm->m", weights, parts[:, :, 0])
    apart = parts[:, :, 0] - rest
    variance = float((weights * (covariance[..., 0, 0] + (apart**2).mean(axis=-1))).sum())
    amplitude_mm = _amplitude(parts, covariance, weights)
    swings = amplitude_mm > 4.0 * noise_mm
    period_s = float(np.exp(weights.sum(axis=1) @ np.log(_PERIOD_OF_LAW))) if swings else None
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
    return float(np.logaddexp.reduce(log_odds.ravel()) - np.log(len(_PERIOD_OF_LAW) * len(SIZES_MM)))


def _weighed(times_s: Array, places: Array, noise_mm: float) -> tuple[Array, Array, Array]:
    """For each law (a period with a damping) and size of swing, times up to now being 0 and less.

    The log of the likelihood (t, s), the parts (t, s, 3, m) e, a, b, of now, and their covariance (t, s, 3, 3).
    """
    phases = 2.0 * np.pi * times_s[None, :] / _PERIOD_OF_LAW[:, None]
    larger = np.exp(-_DAMPING_OF_LAW[:, None] * phases)  # than now it swung then
    system = np.stack([np.ones_like(phases), larger * np.cos(phases), larger * np.sin(phases)], axis=-1)
    prior = np.stack([np.full_like(SIZES_MM, _REST_MM), SIZES_MM, SIZES_MM], axis=-1) ** -2.0
    # a true period between two of the list runs ahead of them by a phase that grows with the time
    weight = 1.0 / (noise_mm**2 + (SIZES_MM[:, None] * (larger * phases * _BETWEEN_PERIODS)[:, None]) ** 2)
    normal = np.einsum("tsn,tni,tnj->tsij", weight, system, system, optimize=True) + prior[:, :, None] * np.eye(3)
    about = places - places[-1]
    right = np.einsum("tsn,tni,nm->tsim", weight, system, about, optimize=True)
    covariance = np.linalg.inv(normal)
    parts = covariance @ right
    explained = (parts * right).sum(axis=(2, 3))
    spread = np.linalg.slogdet(normal)[1] - np.log(prior).sum(axis=-1) - np.log(weight / (2.0 * np.pi)).sum(axis=-1)
    whole = weight @ (about**2).sum(axis=1)
    parts[:, :, 0] += places[-1]
    # beforehand a swing of every order of magnitude is as likely as another: crews hold columns, and let them go
    return -0.5 * (whole - explained + about.shape[1] * spread), parts, covariance


def _amplitude(parts: Array, covariance: Array, weights: Array) -> float:
    """What the longer half-axis of the swing's ellipse does not exceed, with a probability of 95 %."""
    longest = np.linalg.norm(parts[:, :, 1:], ord=2, axis=(2, 3))
    spread = np.sqrt(np.linalg.eigvalsh(covariance[..., 1:, 1:])[..., -1])
    lengths = np.concatenate([np.abs(longest + z * spread).ravel() for z, _ in _NODES])
    shares = np.concatenate([share * weights.ravel() for _, share in _NODES])
    order = np.argsort(lengths)
    at = int(np.searchsorted(np.cumsum(shares[order]), _SURE))
    return float(lengths[order][min(at, len(lengths) - 1)])
