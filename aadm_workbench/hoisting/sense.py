"""Whether what was fitted in a hoisting frame can be this column over these bars."""

from __future__ import annotations

import numpy as np

from aadm_workbench.hoisting.bars.fit import BarFit
from aadm_workbench.hoisting.bars.search import SeenBars
from aadm_workbench.hoisting.foot.face import FootFace
from aadm_workbench.hoisting.foot.fit import FootFit
from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.hoisting.match import Matched
from aadm_workbench.hoisting.offsets import HungFit
from aadm_workbench.hoisting.pattern_fit import placed
from aadm_workbench.hoisting.unseen import hidden_shares
from aadm_workbench.model import Array, BoolArray, Reason

_FEWEST_SEEN = 3  # a pose has three unknowns, and two points leave nothing to check it by
_SLEEVE_MISFIT, _BAR_MISFIT = 0.08, 0.15  # relative, as in sleeves.py and rebars.py
_OUT_OF_PICTURE_SHARE = 1 / 3  # of the sleeves: a foot is aimed at wholly or by half
_RESIDUAL_MM = 6.0  # twice the limit: what is farther off belongs to no place
# a tool may stand about; a third of the bars may hide behind hoses and hands: a choice, not tuned since
_UNEXPECTED_MAX, _ABSENT_SHARE = 1, 0.34
_STRAY_SHARE = 0.3  # of the openings: some are those of lifting anchors and vents; a choice, not tuned since
_COVERED_SHARE = 0.5  # of a bar's width: with less in view nobody can say that it is not there


def shown_sleeves(frame: HoistingFrame, face: FootFace, foot: FootFit) -> BoolArray:
    """Which sleeves (k,) are in the picture, with something returned about them."""
    in_picture = _in_picture(frame, face.to_frame(np.column_stack([foot.centres, np.zeros(len(foot.centres))])))
    return np.asarray(in_picture & foot.shown)


def why_half(shown_here: BoolArray) -> str:
    """Whether so little of the foot is in view that it stands for a part of the column only; empty if not."""
    shown, count = int(shown_here.sum()), len(shown_here)
    if shown >= (1.0 - _OUT_OF_PICTURE_SHARE) * count:
        return ""
    return Reason("hoisting.half", shown=shown, count=count)


def why_not_foot(face: FootFace, foot: FootFit, diameter_mm: float) -> str:
    """What speaks against the foot; empty where nothing does."""
    apart = np.hypot(*(face.mouths[:, None] - foot.centres[None]).transpose(2, 0, 1)).min(axis=1)
    # openings are found to half their radius
    stray = int((apart > max(_RESIDUAL_MM, 0.6 * foot.radius_mm)).sum())
    if stray > max(1.0, _STRAY_SHARE * len(face.mouths)):
        return Reason("hoisting.stray", stray=stray)
    if foot.seen.sum() < _FEWEST_SEEN:
        return Reason("hoisting.few_measured", seen=int(foot.seen.sum()))
    if abs(2.0 * foot.radius_mm / diameter_mm - 1.0) > _SLEEVE_MISFIT:
        return Reason("hoisting.other_sleeves", measured_mm=2.0 * foot.radius_mm, diameter_mm=diameter_mm)
    return ""


def why_not_bars(frame: HoistingFrame, hung: HungFit, found: SeenBars, matched: Matched, diameter_mm: float) -> str:
    """What speaks against the bars; empty where nothing does."""
    bars = hung.bars
    if bars.seen.sum() < _FEWEST_SEEN:
        return Reason("hoisting.few_bars_measured", seen=int(bars.seen.sum()))
    if abs(2.0 * bars.radius_mm / diameter_mm - 1.0) > _BAR_MISFIT:
        return Reason("hoisting.other_bars", measured_mm=2.0 * bars.radius_mm, diameter_mm=diameter_mm)
    unexpected = _unexpected(hung, found, matched)
    if unexpected > _UNEXPECTED_MAX:
        return Reason("hoisting.unexpected_bars", unexpected=unexpected)
    absent, expected = _absent(frame, hung)
    if absent > max(1.0, _ABSENT_SHARE * expected):
        return Reason("hoisting.absent_bars", absent=absent, expected=expected)
    return ""


def _in_picture(frame: HoistingFrame, points: Array) -> BoolArray:
    pixels = frame.pixels_of(points)
    inside = (pixels >= 0.0).all(axis=1) & (pixels < np.array(frame.shape[::-1])).all(axis=1)
    return np.asarray(inside & (points[:, 2] > 0.0))


def _unexpected(hung: HungFit, found: SeenBars, matched: Matched) -> int:
    """How many round bars stand within the pattern's outline and belong to none of its places."""
    places = placed(matched.rebars.pose, hung.bars.places)
    known = set(matched.rebars.matched.tolist())
    low, high = places.min(axis=0), places.max(axis=0)
    middle, reach = 0.5 * (low + high), 0.5 * float(np.hypot(*(high - low)))
    extra = [c for k, c in enumerate(found.centres) if k not in known and np.hypot(*(c - middle)) < reach]
    return len(extra)


def _absent(frame: HoistingFrame, hung: HungFit) -> tuple[int, int]:
    """How many of the bars that nothing hides show nothing or stand far off, and how many nothing hides."""
    bars = hung.bars
    eye = hung.axes.eye[:2]
    # as much of a side as shows a bar
    in_view = _in_picture(frame, hung.axes.to_frame(np.column_stack([bars.tops[:, :2], _levels(bars) - 20.0])))
    clear = in_view & (hidden_shares(placed(bars.pose, bars.places), eye, bars.radius_mm) < _COVERED_SHARE)
    off_mm = np.hypot(*(bars.tops[:, :2] - placed(bars.pose, bars.places)).T)
    absent = clear & (~bars.seen | (off_mm > _RESIDUAL_MM))
    return int(absent.sum()), int(clear.sum())


def _levels(bars: BarFit) -> Array:
    level = float(np.nanmedian(np.where(bars.seen, bars.tops[:, 2], np.nan)))
    return np.where(np.isfinite(bars.tops[:, 2]), bars.tops[:, 2], level)
