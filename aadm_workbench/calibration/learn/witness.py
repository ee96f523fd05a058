"""How much of each centre is left to discs that are set right by what a camera loses at edges: what scatters least."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.calibration.learn.capture import PlateCapture, captured_plate
from aadm_workbench.calibration.learn.losses import Losses
from aadm_workbench.calibration.learn.stretch import Stretches, wider_for
from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.model import CameraProfile, IntArray, Kind, LearnedEdges, Measure

_UNKNOWN = Measure(0.0, 0.0)  # nothing is taken off, and nothing added


def by_discs(capture: PlateCapture, plate: Plate, losses: Losses) -> PlateCapture:
    """The same capture, its centres by discs alone."""
    edges = {kind: LearnedEdges(_UNKNOWN, 0.0, 0.0, _UNKNOWN, losses.lost[kind], share=1.0) for kind in Kind}
    profile = CameraProfile(
        "", "", "", "", "", 0, capture.camera, (0.0, 0.0), (0.0, 0.0), _UNKNOWN, edges, projector_mm=losses.projector_mm
    )
    return captured_plate(replace(capture.scan, learned=profile), plate)


def shares_of(
    captures: Sequence[PlateCapture], discs: Sequence[PlateCapture], fits: tuple[Stretches, Stretches], plate: Plate
) -> dict[Kind, float]:
    """Of discs in each kind's centres, 0 to 1, so that what is left of both ``fits`` scatters least."""
    found = {}
    for kind in Kind:
        across = squares = 0.0
        for capture, other, left, apart in zip(captures, discs, fits[0].left_mm, fits[1].left_mm, strict=True):
            here, there = _shared(capture, other, plate, kind)
            step = apart[there] - left[here]
            across -= float((left[here] * step).sum())
            squares += float((step**2).sum())
        found[kind] = min(max(across / squares, 0.0), 1.0) if squares > 0.0 else 0.0
    return found


def apart_mm(
    captures: Sequence[PlateCapture], discs: Sequence[PlateCapture], fits: tuple[Stretches, Stretches], plate: Plate
) -> float:
    """How far, per axis, all centres of a kind may be off together, as far as a plate tells: mm.

    Where it lies before the camera is known from its own centres alone. But holes and pins, each by the fit of all and
    by discs, are bent by amounts of their own: how these four differ says how large such amounts are.
    """
    steps = []
    for capture, other in zip(captures, discs, strict=True):
        here, there = _shared(capture, other, plate, Kind.SLEEVE)
        steps.append((other.flat[there] - capture.flat[here]).mean(axis=0))
    holes = np.mean(steps, axis=0)
    pins, pins_by_discs = (np.array([axis.value for axis in fit.apart]) for fit in fits)
    four = np.array([[0.0, 0.0], holes, pins, holes + pins_by_discs])
    return wider_for(2 * (len(four) - 1)) * float(np.sqrt(four.var(axis=0, ddof=1).mean()))


def mixed(capture: PlateCapture, discs: PlateCapture, shares: dict[Kind, float], plate: Plate) -> PlateCapture:
    """A capture whose centres are drawn to those of discs by the share of their kind."""
    flat = capture.flat.copy()
    for kind in Kind:
        here, there = _shared(capture, discs, plate, kind)
        flat[here] += shares[kind] * (discs.flat[there] - flat[here])
    return replace(capture, flat=flat)


def _shared(one: PlateCapture, other: PlateCapture, plate: Plate, kind: Kind) -> tuple[IntArray, IntArray]:
    """Numbers (n,) in both of the places of a kind that both have."""
    of_other = {int(place): number for number, place in enumerate(other.place)}
    pairs = [
        (number, of_other[int(place)])
        for number, place in enumerate(one.place)
        if int(place) in of_other and plate.places[place].kind is kind
    ]
    here, there = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    return here, there
