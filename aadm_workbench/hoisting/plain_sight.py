"""What a frame shows to be missing: a mouth that is closed, and a place in plain sight where no bar stands.

Not to see a point is one thing: something hides it, and a scan from before hoisting may speak for it. To see that it is
not there is another: rays that should have passed a mouth end on its face, or rays that should have ended on a bar
pass. Then nothing speaks for it, whatever was measured before.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.hoisting.foot.mouths import NOISE_SIGMAS, MouthView, view_mouth
from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.hoisting.offsets import HungFit
from aadm_workbench.model import BoolArray, ColumnDesign, Reason

_WITHIN = 0.7  # of the radius: clear of chamfers, of worn rims, and of a place that is known to a millimetre or two
_SHALLOW = 0.4  # of the height at which a ray would end on the bore's wall: less deep it ended on what closes the mouth
_CLOSED_SHARE, _PASSED_SHARE = 0.6, 0.6  # of the rays that tell: more than half, and as much again as noise leaves open
_FEWEST_RAYS = 20  # a share of so many is known to a tenth
_IN_FRONT_MM = 6.0  # of the face: farther in front a thing hides the mouth; caps and bulging tape stand out by less
# of a bar below the level of the tops: these differ by a centimetre, and the shortest of the settings stick out by 120
_FROM_MM, _TO_MM = 20.0, 70.0
_CORE_SHARE = 0.5  # of a bar's radius to either side of its axis: a place from a pattern is known to some mm
_BEHIND_DIAMETERS = 1.5  # behind a bar's axis: what lies nearer may be the bar itself, bent
_LEVELS = 26  # rows of points on a place: each as far from the next as rays are at 1.5 m


def missing_labels(frame: HoistingFrame, hung: HungFit, design: ColumnDesign) -> tuple[str, ...]:
    """Labels of sleeves that are closed, and of bars that are not there, in plain sight."""
    labels = [*design.sleeves, *design.rebars]
    missing = np.concatenate([_closed(frame, hung), _gone(frame, hung)])
    return tuple(labels[int(k)].label for k in np.flatnonzero(missing))


def missing_in_words(labels: tuple[str, ...], design: ColumnDesign) -> tuple[Reason, ...]:
    """A sentence on closed sleeves and one on bars that are not there, where there are any."""
    sleeves = [point.label for point in design.sleeves if point.label in labels]
    rebars = [point.label for point in design.rebars if point.label in labels]
    said = (("hoisting.closed", sleeves), ("hoisting.missing", rebars))
    return tuple(Reason(code, labels=those) for code, those in said if those)


def _closed(frame: HoistingFrame, hung: HungFit) -> BoolArray:
    """Which sleeves (k,) are not seen because something lies in their mouths."""
    foot, face = hung.foot, hung.face
    closed = np.zeros(len(foot.seen), bool)
    for k in np.flatnonzero(~foot.seen):
        view = view_mouth(frame, face, foot.centres[k], foot.radius_mm)
        closed[k] = view is not None and _is_closed(view, foot.centres[k], foot.radius_mm, face.residual_mm)
    return closed


def _is_closed(view: MouthView, centre: np.ndarray, radius_mm: float, noise_mm: float) -> bool:
    about = view.crossing - centre
    distance = np.hypot(about[:, 0], about[:, 1])
    length = np.hypot(view.slope[:, 0], view.slope[:, 1])
    along = np.einsum("ij,ij->i", about, view.slope) / length
    to_wall = np.sqrt(np.maximum(radius_mm**2 - distance**2 + along**2, 0.0)) - along
    wall_mm = to_wall * np.sqrt(np.maximum(1.0 - length**2, 0.0)) / length
    told = (distance < _WITHIN * radius_mm) & (_SHALLOW * wall_mm > NOISE_SIGMAS * noise_mm)
    height = view.points[:, 2]
    ended = told & (height < _SHALLOW * wall_mm) & (height > -_IN_FRONT_MM)
    return bool(told.sum() >= _FEWEST_RAYS and ended.sum() > _CLOSED_SHARE * told.sum())


def _gone(frame: HoistingFrame, hung: HungFit) -> BoolArray:
    """Which bars (k,) are not seen because rays pass where they should stand."""
    bars = hung.bars
    gone = np.zeros(len(bars.seen), bool)
    level_mm = float(np.nanmedian(np.where(bars.seen, bars.tops[:, 2], np.nan)))
    heights = level_mm - np.linspace(_FROM_MM, _TO_MM, _LEVELS)
    sideways = bars.radius_mm * _CORE_SHARE * np.linspace(-1.0, 1.0, 5)
    rows, columns = frame.shape
    for k in np.flatnonzero(~bars.seen):
        way = bars.tops[k, :2] - hung.axes.eye[:2]
        across = np.array([-way[1], way[0]]) / np.hypot(*way)
        plan = bars.tops[k, :2] + sideways[:, None] * across
        place = np.column_stack([np.repeat(plan, _LEVELS, axis=0), np.tile(heights, len(plan))])
        there = hung.axes.to_frame(place)
        there = there[there[:, 2] > 1.0]
        pixel = np.rint(frame.pixels_of(there)).astype(np.int64)
        inside = (pixel >= 0).all(axis=1) & (pixel < (columns, rows)).all(axis=1)
        depth = frame.points[pixel[inside, 1], pixel[inside, 0], 2]
        beyond = depth - there[inside, 2]
        told = np.isfinite(beyond)
        passed = beyond[told] > _BEHIND_DIAMETERS * 2.0 * bars.radius_mm
        gone[k] = told.sum() >= _FEWEST_RAYS and passed.sum() > _PASSED_SHARE * told.sum()
    return gone
