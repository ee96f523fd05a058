"""A frame that begins where the last one of its camera ended: nothing is searched, and only windows are read.

From frame to frame a hanging column moves by little and its bars not at all. So the face is where it was but for some
mm, and every sleeve and bar is looked for in a window about its last place. What does not find them so has lost them,
and the frame is measured as if it were the first.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.pose.eopa import wrap
from aadm_workbench.extract.plane import refined_plane
from aadm_workbench.hoisting.bars.search import SeenBars
from aadm_workbench.hoisting.foot.face import FootFace
from aadm_workbench.hoisting.foot.fit import FootFit
from aadm_workbench.hoisting.foot.mouths import window_over
from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.hoisting.match import Laid, Matched
from aadm_workbench.hoisting.offsets import HungFit
from aadm_workbench.hoisting.sequence.sighting import Sighting
from aadm_workbench.model import Array, Plane

_AFRESH_EVERY = 30  # frames: once a second at video rate all is searched again, for what came into the picture since
_FACE_POINTS, _FACE_FEWEST = 6_000, 300  # as many as a search measures the face on; fewer carry no plane
_FACE_PIXELS = 30_000  # of them: two of three look into mouths, past the foot, or are lost
_FACE_MOVES_MM, _FACE_BIN_MM = 12.0, 0.5  # a hoist lowers by a centimetre from frame to frame; the scatter of a face
_BAND_SIGMAS = 3.5  # as in foot/face.py
_MOVED_MAX_MM, _TURNED_MAX = 3.0, np.radians(1.0)  # of the foot from frame to frame: what a window still holds wholly
_BARS_MOVED_MM = 2.0  # bars that moved by more have another camera before them
_FLAT_MM = 0.05  # a face that bends by more is fitted anew in each frame: its plane hangs on which points are asked
_LOST_SHARE = 0.8  # of what was seen before: with less in view something stands in between, or is not where it was
_SURE_TURN = np.radians(35.0)  # five degrees before a frame is held back: a search asks that anew


@dataclass(frozen=True, eq=False)
class Found:
    """Where foot and bars are, and which is which; ``earlier`` is what was fitted in the frame that was followed."""

    face: FootFace
    bars: SeenBars
    matched: Matched
    earlier: HungFit | None = None


def follow(frame: HoistingFrame, last: Sighting) -> Found | None:
    """Begin a frame where the last one of the same camera ended; None where it cannot be so."""
    fits = frame.shape == last.shape and frame.lens == last.frame.lens
    if not fits or last.tracked >= _AFRESH_EVERY or last.off_declared > _SURE_TURN or last.orientation == "ambiguous":
        return None
    if last.hung.face.bend_mm > _FLAT_MM:
        return None
    face = _face(frame, last.hung)
    if face is None:
        return None
    hung = last.hung
    seen = np.flatnonzero(hung.bars.seen)
    tops = face.local(hung.axes.to_frame(hung.bars.tops[seen]))
    turned = face.axes @ hung.face.axes.T
    bars = SeenBars(
        tops[:, :2],
        tops[:, 2],
        face.axes @ hung.axes.axes[2],
        True,
        None if hung.floor is None else turned @ hung.floor,
    )
    at = np.full(len(hung.bars.seen), -1)
    at[seen] = np.arange(len(seen))
    matched = Matched(
        Laid(hung.foot.pose, np.arange(len(hung.foot.centres)), 0.0),
        Laid(hung.bars.pose, at, 0.0),
        last.orientation,
        last.off_declared,
    )
    return Found(face, bars, matched, hung)


def has_lost_foot(foot: FootFit, before: FootFit) -> bool:
    """Whether a frame that followed another did not find the foot that was there."""
    moved_mm = float(np.hypot(*(foot.pose - before.pose)[:2]))
    turned = abs(wrap(float(foot.pose[2] - before.pose[2])))
    enough = (foot.seen & before.seen).sum() >= _LOST_SHARE * before.seen.sum()
    # what was fitted to nothing is no number, and no comparison holds for it
    return not (moved_mm <= _MOVED_MAX_MM and turned <= _TURNED_MAX and enough)


def has_lost_bars(hung: HungFit, before: HungFit) -> bool:
    """Whether a frame that followed another did not find the bars that were there."""
    both = hung.bars.seen & before.bars.seen
    if both.sum() < _LOST_SHARE * before.bars.seen.sum():
        return True
    apart = hung.axes.to_frame(hung.bars.tops[both]) - before.axes.to_frame(before.bars.tops[both])
    return not float(np.median(np.linalg.norm(apart, axis=1))) <= _BARS_MOVED_MM


def _face(frame: HoistingFrame, before: HungFit) -> FootFace | None:
    """The face by least squares, near where it was."""
    old = before.face
    points = _about_mouths(frame, before)
    height = (points - old.origin) @ old.axes[2]
    height = height[np.abs(height) < _FACE_MOVES_MM]
    if len(height) < _FACE_FEWEST:
        return None
    counts, edges = np.histogram(height, np.arange(-_FACE_MOVES_MM, _FACE_MOVES_MM + _FACE_BIN_MM, _FACE_BIN_MM))
    moved_mm = float(edges[counts.argmax()] + 0.5 * _FACE_BIN_MM)
    plane = Plane(-old.axes[2], float(-old.axes[2] @ old.origin) - moved_mm, old.residual_mm)
    band_mm = max(_BAND_SIGMAS * old.residual_mm, _FACE_BIN_MM)
    near = points[np.abs(plane.height(points)) < 2.0 * band_mm]
    if len(near) < _FACE_FEWEST:
        return None
    # refined_plane looks 2.5 times as far
    plane = refined_plane(near[:: len(near) // _FACE_POINTS + 1], plane, band_mm / 2.5)
    turned = old.along(old.axes @ -plane.normal)
    origin = old.origin - plane.normal * (float(plane.normal @ old.origin) - plane.offset)
    face = replace(old, axes=turned.axes, origin=origin, residual_mm=plane.residual_mm)
    return replace(face, mouths=face.local(old.to_frame(_flat(before.foot.centres)))[:, :2])


def _about_mouths(frame: HoistingFrame, before: HungFit) -> Array:
    """Points (n, 3) mm of the foot between its mouths, as many as a face is measured on and some more."""
    rows, columns = window_over(frame, before.face, before.foot.centres, before.foot.radius_mm)
    pixels = (rows.stop - rows.start) * (columns.stop - columns.start)
    step = max(1, int(np.sqrt(pixels / _FACE_PIXELS)))
    points = frame.points[rows.start : rows.stop : step, columns.start : columns.stop : step].reshape(-1, 3)
    return np.asarray(points[np.isfinite(points[:, 2])], np.float64)


def _flat(places: Array) -> Array:
    return np.column_stack([places, np.zeros(len(places))])
