"""What may be said of a pair that the frame of a hanging column does not show.

A pattern tells where a hidden sleeve and its bar should be, and not that they are there: a bar may be absent or bent, a
mouth may be taped. So what was not seen fails where even its pattern is beyond the limit, and never passes by itself; a
scan from before hoisting may speak for it.

How much of each bar stands behind nearer ones.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.assembly.decision import PASS_PROBABILITY
from aadm_workbench.model import Array, AssemblyPoint, HoistingPair, Reason, Verdict, in_one

_RAYS = 41  # over the width of a bar: shares to 2.5 %


def verdict_unseen(verdict: Verdict, unseen: Sequence[str], before: Sequence[str]) -> Verdict:
    """The verdict of a pair, given its verdict by value, the labels it hides, and those measured before hoisting."""
    inferred = set(unseen) - set(before)
    return Verdict.INCONCLUSIVE if inferred and verdict is Verdict.PASS else verdict


def unseen_in_words(unseen: Sequence[str], before: Sequence[str], missing: Sequence[Reason] = ()) -> str:
    """Of a pair: which of its points were not seen, and where their places come from; empty where both were seen.

    What is ``missing``, said already, was seen not to be there: where its place comes from is of no account.
    """
    inferred = [label for label in unseen if label not in before]
    resting = [label for label in unseen if label in before]
    said = [*missing]
    said += [Reason("hoisting.inferred", labels=inferred)] if inferred else []
    said += [Reason("hoisting.resting", labels=resting)] if resting else []
    return in_one(said)


def would_pass(pair: HoistingPair) -> bool:
    """Whether only that a pair was not seen keeps it from passing."""
    sure = pair.probability is None or pair.probability >= PASS_PROBABILITY
    return pair.verdict is Verdict.INCONCLUSIVE and sure


def look_again(pairs: Sequence[HoistingPair], missing: Sequence[str] = ()) -> tuple[str, ...]:
    """A sentence on the pairs that only their own evidence could let pass, where there are any.

    At what is ``missing`` no other corner need look.
    """
    points = [point for pair in pairs for point in _hidden(pair) if point not in missing]
    text = Reason("hoisting.look_again", labels=points)
    return (text,) if points else ()


def measured_labels(before: Sequence[AssemblyPoint | None] | None, design: Sequence[AssemblyPoint]) -> tuple[str, ...]:
    """Labels of the design points that were measured before hoisting."""
    return tuple(target.label for target, point in zip(design, before or (), strict=False) if point is not None)


def _hidden(pair: HoistingPair) -> list[str]:
    return [label for label, seen in ((pair.sleeve, pair.sleeve_seen), (pair.rebar, pair.rebar_seen)) if not seen]


def hidden_shares(centres: Array, eye: Array, radius_mm: float) -> Array:
    """Share (k,) of the width of each round thing (k, 2) that nearer ones of the same radius hide from an eye (2,)."""
    about = centres - eye
    distance = np.hypot(about[:, 0], about[:, 1])
    angle = np.arctan2(about[:, 1], about[:, 0])
    half = np.arcsin(np.clip(radius_mm / distance, 0.0, 1.0))
    shares = np.zeros(len(centres))
    for k in range(len(centres)):
        rays = angle[k] + half[k] * np.linspace(-1.0, 1.0, _RAYS)
        hidden = np.zeros(_RAYS, bool)
        for other in np.flatnonzero(distance < distance[k] - radius_mm):
            hidden |= np.abs(np.mod(rays - angle[other] + np.pi, 2 * np.pi) - np.pi) < half[other]
        shares[k] = hidden.mean()
    return shares
