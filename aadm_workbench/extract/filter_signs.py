"""What a camera's filters leave behind in a depth map: ramps in the air, noise that neighbours share.

Where a surface ends, a camera returns the next one, nothing, or single points between the two. A surface that falls
evenly from pixel to pixel through the air was made by a filter: one that smooths over the step, or one that fills what
was not measured. Organised scans alone can tell; the signs of a cloud are zero.

Depths that a camera's software copied over an edge: pixels that say what their neighbour says, to the last digit.

Software that fills shadows with the nearest surface, with the one from the left, or lets near surfaces grow over far
ones, repeats a depth. Noise makes each pixel another, as far as the steps of the depths allow: how often two neighbours
are equal by right is seen away from edges.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.edges.bend import BLURRED
from aadm_workbench.extract.patches import Patches
from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray, Reason, Scan
from aadm_workbench.model.measured import TO_SIGMA
from aadm_workbench.model.special import median

_FALL_MM = (1.0, 60.0)  # from pixel to pixel on a ramp
_SOME = 8  # runs: noise is the same in all
_FALL_SIGMAS = 2.0  # of single pixels: noise falls by more three times in a row once in a hundred thousand runs
_EVEN = 6.0  # the steepest fall of three over the flattest
_OFF_WALL_MM, _OFF_LEAN = 2.5, 0.08  # ribs and chamfers stay nearer to a wall; bars that lean by four degrees do
_BELOW_MM = 3.0  # of the surface that a feature lies in
_WITHIN_MM = 1.5  # of it, where its noise is looked at
_OWN_NOISE = 0.55  # noise of which half is shared over a pixel and more comes to 0.7, a median of three to 0.5
# over four pixels: 0.49 and more without a filter, on both cameras; a mean or a median over a window has a quarter
_FAR, _FAR_NOISE = 4, 0.4
# relative variance of a mean square times the number of differences: 2 of normal noise, 1.5 once the largest are cut
# off, twice that as neighbouring differences share two points of three; 95 %
_FINE_VARIANCE, _FINE_SIGMAS = 3.0, 2.0
_RAMPED, _RAMPED_UNLOST = 0.1, 0.03  # slips of the fringe order and flying pixels come to 0.02
# a camera loses one pixel in two thousand at least (path-traced scans of concrete), so that of so many it loses ten;
# with none lost a few ramps tell of a filter that path-traced scans, which lose some, never showed
_UNLOST, _UNLOST_OF, _RAMPED_COMPLETE = 1e-4, 20_000, 0.005

SMOOTHED = Reason("extract.smoothed")
GAPS_FILLED = Reason("extract.gaps_filled")
"""Reasons of what is not measured: what a filter made of an edge nobody knows."""

_KEPT = 0.9  # of second differences; strays and edges make the largest
_EVERY = 3  # rows: noise is the same in all
_FEWEST = 200  # points of a surface whose noise is looked at


@dataclass(frozen=True)
class FilterSigns:
    """Signs of filters about the features of one scan.

    ``ramps``: places of even fall through the air, for each pixel of the features' outlines; ``usual_ramps`` those of
    a feature in the middle: the side of one that is thicker than it should be looks like a ramp. ``fine``: second
    differences of heights over one pixel against those over two, squared; 1 for noise that every pixel has of its own,
    0 for what is smooth; ``far`` against those over four: a window that is wider than one pixel leaves steps, which are
    half of what they are over two. ``fine_u`` and ``far_u`` are standard uncertainties. ``lost``: share of pixels
    without a point among such with points on all sides; ``looked_at``: how many these are.
    """

    ramps: float = 0.0
    fine: float = 1.0
    lost: float = 0.0
    looked_at: int = 0
    fine_u: float = 0.0
    usual_ramps: float = 0.0
    far: float = 1.0
    far_u: float = 0.0

    @property
    def complete(self) -> bool:
        """Whether no pixel was lost where a camera loses some."""
        return self.lost == 0.0 and self.looked_at > _UNLOST_OF

    def reason(self, *, blurred: bool) -> str:
        """Why nothing is to be measured in such a scan; empty where neither a filter shows nor a blur."""
        smooth = self.fine + _FINE_SIGMAS * self.fine_u < _OWN_NOISE
        if smooth or self.far + _FINE_SIGMAS * self.far_u < _FAR_NOISE:
            return SMOOTHED
        if self.lost < _UNLOST and self.ramps > (_RAMPED_COMPLETE if self.complete else _RAMPED_UNLOST):
            return GAPS_FILLED
        if blurred:
            return BLURRED
        return SMOOTHED if self.usual_ramps > _RAMPED else ""


def filter_signs(
    patches: Patches, centre: Array, radius_mm: float, pitch_mm: float, side: float, *, flat: bool = True
) -> FilterSigns:
    """The signs about features at ``centre`` (k, 2) of their patches; ``side`` +1 for mouths, -1 for tops of bars.

    Of a surface that is not ``flat`` the noise is not looked at.
    """
    if not patches.columns or not len(centre):
        return FilterSigns()
    x, y = patches.x - centre[:, :1].astype(np.float32), patches.y - centre[:, 1:].astype(np.float32)
    inside = np.float32(side) * (np.float32(radius_mm) - np.sqrt(x * x + y * y))
    shape = (len(centre), -1, patches.columns)
    height = patches.height.reshape(shape)
    off_wall = inside > np.float32(_OFF_WALL_MM) - np.float32(_OFF_LEAN) * patches.height
    in_air = (off_wall & (patches.height < -_BELOW_MM)).ravel()
    on_surface = ((inside < -2.0 * pitch_mm) & (np.abs(patches.height) < _WITHIN_MM)).reshape(shape)
    size = height.shape[1] * height.shape[2]
    runs = [_ramps(patches.height.ravel(), in_air, step) // size for step in (1, patches.columns)]
    each = np.bincount(np.concatenate(runs), minlength=len(centre)) / (2.0 * np.pi * radius_mm / pitch_mm)
    ramps, usual = float(each.mean()), float(median(each))
    rows = slice(None, None, _EVERY)
    first, second, fourth = (
        _roughness(height[:, rows], on_surface[:, rows], step) if flat else None for step in (1, 2, _FAR)
    )
    (fine, fine_u), (far, far_u) = _ratio(first, second), _ratio(first, fourth)
    return FilterSigns(ramps, fine, *_lost(height), fine_u, usual, far, far_u)


def _ratio(one: tuple[float, int] | None, other: tuple[float, int] | None) -> tuple[float, float]:
    """Of two mean squares of so many, and its standard uncertainty; 1 where one is not known."""
    if one is None or other is None or not other[0]:
        return 1.0, 0.0
    ratio = one[0] / other[0]
    return ratio, ratio * float(np.sqrt(_FINE_VARIANCE / one[1] + _FINE_VARIANCE / other[1]))


def _ramps(height: FloatArray, in_air: BoolArray, step: int) -> IntArray:
    """Where (m,) four pixels so many apart fall evenly, those in the middle in the air; all flattened."""
    at = np.flatnonzero(in_air)
    at = at[(at >= step) & (at < len(height) - 2 * step)]
    at = at[in_air[at + step]]
    if not len(at):
        return at
    run = np.stack([height[at + step * place] for place in (-1, 0, 1, 2)])
    fall = np.diff(run, axis=0)
    least_mm = max(_FALL_MM[0], _FALL_SIGMAS * _noise_mm(fall[1, ::_SOME] - fall[0, ::_SOME]))
    fall = np.where(fall[1] < 0, -fall, fall)
    low, high = fall.min(axis=0), fall.max(axis=0)
    return np.asarray(at[(low > least_mm) & (high < _FALL_MM[1]) & (high < _EVEN * low)])


def _noise_mm(bend: FloatArray) -> float:
    """Standard deviation of single pixels by their second differences (n,), where most lie on a floor far below."""
    bend = np.abs(bend[np.isfinite(bend)])
    return float(TO_SIGMA * median(bend) / np.sqrt(6.0)) if len(bend) else 0.0  # 6 = 1² + 2² + 1²


def _roughness(height: FloatArray, on_surface: BoolArray, step: int) -> tuple[float, int] | None:
    """Mean square of the smaller second differences over so many pixels, mm², of how many; None where few are seen.

    Rounded heights have few different ones: a median would say nothing.
    """
    at = np.nonzero(on_surface[..., : -2 * step] & on_surface[..., step:-step] & on_surface[..., 2 * step :])
    if len(at[0]) < _FEWEST:
        return None
    before, own, behind = (height[at[0], at[1], at[2] + shift] for shift in (0, step, 2 * step))
    bend = np.abs(before - 2 * own + behind)
    widest = np.partition(bend, int(_KEPT * len(bend)))[int(_KEPT * len(bend))]
    return float(np.mean(np.minimum(bend, widest) ** 2)), len(bend)


def _lost(height: FloatArray) -> tuple[float, int]:
    """Share of pixels without a point among such with points on all sides, and how many these are."""
    there = np.isfinite(height)
    around = there[:, :-2, 1:-1] & there[:, 2:, 1:-1] & there[:, 1:-1, :-2] & there[:, 1:-1, 2:]
    count = int(around.sum())
    return float((around & ~there[:, 1:-1, 1:-1]).sum() / max(count, 1)), count


_COPIED_EVERY = 12  # rows, then columns: edges have thousands of pixels, and hundreds tell
_STEP_MM, _FLAT_MM = 5.0, 2.0  # as cameras' software tells edges; neighbours on one surface that is seen well
_NEAR_PIXELS, _INNER_PIXELS = 2, 4  # from an edge: what fattening of one pixel repeats, and what no fill reaches
_FEWEST_PAIRS = 60  # pairs; a share of fewer is known to worse than the least excess
_LEAST_EXCESS = 0.1  # three pixels out of ten are copies where edges grow by a single pixel
_SIGMAS = 6.0  # of a difference of two shares: none of ten million sound scans

COPIED = Reason("extract.copied")
"""Reason of what is not measured: how far an edge was moved nobody knows."""


def copies_depths(scan: Scan) -> bool:
    """Whether neighbours are equal far more often at depth steps, and at gaps, than within surfaces.

    False for clouds, whose neighbours nobody knows.
    """
    if not scan.organised:
        return False
    depth = scan.points[..., 2]
    return any(_is_copied(np.ascontiguousarray(part)) for part in (depth[::_COPIED_EVERY], depth[:, ::_COPIED_EVERY].T))


def _is_copied(depth: FloatArray) -> bool:
    """Whether neighbours in rows (n, m) are: software that copies from the left leaves columns as they were."""
    at_edges, of_edges, within, of_within = _equal_pairs(depth)
    if at_edges == 0 or min(of_edges, of_within) < _FEWEST_PAIRS:
        return False
    excess = at_edges / of_edges - within / of_within
    share = (at_edges + within) / (of_edges + of_within)
    u = float(np.sqrt(share * (1.0 - share) * (1.0 / of_edges + 1.0 / of_within)))
    return excess > max(_LEAST_EXCESS, _SIGMAS * u)


def _equal_pairs(depth: FloatArray) -> tuple[int, int, int, int]:
    """Equal pairs of neighbours in rows (n, m) and all pairs: near edges, then away from them."""
    apart = np.abs(depth[:, 1:] - depth[:, :-1])
    equal = apart == 0.0
    if not equal.any():
        return 0, 0, 0, 0
    edge = ~(apart <= _STEP_MM)
    flat, near = apart < _FLAT_MM, _within(edge, _NEAR_PIXELS)
    edges, inner = flat & near, flat & ~_within(edge, _INNER_PIXELS)
    return int((edges & equal).sum()), int(edges.sum()), int((inner & equal).sum()), int(inner.sum())


def _within(marked: BoolArray, reach: int) -> BoolArray:
    """What lies so many places or less from a mark (n, m) in its row."""
    wide = marked.copy()
    for shift in range(1, reach + 1):
        wide[:, shift:] |= marked[:, :-shift]
        wide[:, :-shift] |= marked[:, shift:]
    return wide
