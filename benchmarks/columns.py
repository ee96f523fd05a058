"""Columns as built whose true margin is known, and what a scan with stated uncertainties makes of them.

The truth is found in another way than by the code that is judged, and in two: :mod:`benchmarks.smooth_margin` for many
columns at once, and for single ones a linear program by SciPy, of polygons that lie around the discs by 0.1 %.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from scipy.optimize import linprog

from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, RepairReport
from aadm_workbench.twin.parts import ring
from benchmarks.smooth_margin import margins_mm

LIMIT_MM = 3.0
LONGEST_MARGIN_MM = 1.5

_CORNERS = 96
_HALVINGS = 12
_REWEIGHTED = 60
_OUTLIER_SCALE = 0.4
_ODD = 4.0

# What the product states of diameters and of the straightness of bars; benchmark and code must not share it.
_SIZE_U_MM = 0.06
_STRAIGHT_U_RAD = 0.002


PATTERNS = {
    "ring": ring(240.0, 240.0, 4),
    "row": np.column_stack([125.0 * np.arange(-4, 5), np.zeros(9)]),
    "double row": np.array([(200.0 * k - 500.0, side) for side in (-60.0, 60.0) for k in range(6)]),
    "four": ring(120.0, 120.0, 2),
}


@dataclass(frozen=True)
class Scene:
    """A kind of column and of scan.

    Parameters
    ----------
    sleeve_mm, outer_mm
        Inner diameter of the sleeves, and diameter of the bars over their ribs.
    lean_rad
        Spread, per axis, of how sleeves and bars lean, before all errors are scaled to the margin that is wanted.
    u_mm, u_lean_rad
        Standard uncertainty per axis of a centre and of a lean.
    u_worse_mm
        The same of the centres of two sleeves and two bars that were hardly seen.
    seen_mm
        Length of a bar below its top that the scan shows; below it the bar may have a kink.
    missing
        So many bars were not measured.
    law
        Of the offsets of bars from sleeves: normal, evenly over a disc, or normal with one bar four times as far off.
    """

    name: str
    sleeve_mm: float = 36.0
    outer_mm: float = 23.5
    lean_rad: float = 0.005
    u_mm: float = 0.1
    u_lean_rad: float = 0.001
    u_worse_mm: float | None = None
    seen_mm: float = 60.0
    missing: int = 0
    embedded_mm: float = 160.0
    pattern: str = "ring"
    law: Literal["normal", "disc", "odd"] = "normal"

    @property
    def u_pair_mm(self) -> float:
        """Standard uncertainty per axis of what a pair keeps: both centres and one lean."""
        return float(np.hypot(np.sqrt(2.0) * self.u_mm, self.u_lean_rad * self.embedded_mm))


SCENES = (
    Scene("36/20"),
    Scene("28/20", 28.0),
    Scene("26/18", 26.0, 21.3),
    Scene("leaning", 32.0, lean_rad=0.02, u_lean_rad=0.002),
    Scene("u 0.2", u_mm=0.2, u_lean_rad=0.002),
    Scene("u 0.2, 26/18", 26.0, 21.3, u_mm=0.2, u_lean_rad=0.002),
    Scene("u 0.3, 28/20", 28.0, u_mm=0.3, u_lean_rad=0.002),
    Scene("u 0.5", u_mm=0.5, u_lean_rad=0.004),
    Scene("u 1.0", u_mm=1.0, u_lean_rad=0.004),
    Scene("one odd bar, u 0.3", u_mm=0.3, law="odd"),
    Scene("even, u 0.3", u_mm=0.3, law="disc"),
    Scene("row of nine", 28.0, pattern="row"),
    Scene("double row, u 0.3", u_mm=0.3, pattern="double row"),
    Scene("four, u 0.2", 28.0, u_mm=0.2, pattern="four"),
    Scene("hardly seen", u_worse_mm=3.0),
    Scene("unmeasured", missing=1),
)


@dataclass(frozen=True, eq=False)
class Built:
    """A column as built and as measured: ``margin_mm`` is the slack of the best pose, all limits being in mm.

    ``seen_margin_mm`` is that of the pairs that were measured. ``tops``, ``feet``, ``mouths``, ``depths`` (n, 2) mm are
    where the bars' axes end and where the sleeves' do.
    """

    design: ColumnDesign
    sleeves: list[AssemblyPoint | None]
    rebars: list[AssemblyPoint | None]
    margin_mm: float
    seen_margin_mm: float
    truth: Truth

    def margin_after_mm(self, repair: RepairReport) -> float:
        """The true margin once the bars were bent as advised."""
        return float(self.truth.bent([bar.label for bar in self.design.rebars], repair).margins_mm()[0])


@dataclass(frozen=True, eq=False)
class Truth:
    """k columns as built: ``tops``, ``feet``, ``mouths``, ``depths`` (k, n, 2) mm, ``rooms_mm`` (k, n).

    ``kinks`` (k, n, 2) mm is how far a foot would be from under its top if the seen part of the bar were upright.
    """

    tops: Array
    feet: Array
    mouths: Array
    depths: Array
    rooms_mm: Array
    kinks: Array

    def margins_mm(self) -> Array:
        """Slack (k,) of the best pose of each."""
        source = np.concatenate([self.tops, self.feet, self.tops], axis=1)
        target = np.concatenate([self.mouths, self.mouths, self.depths], axis=1)
        limits = np.concatenate([np.full_like(self.rooms_mm, LIMIT_MM), self.rooms_mm, self.rooms_mm], axis=1)
        return margins_mm(source, target, limits)

    def only(self, case: int, kept: Array | None = None) -> Truth:
        """One of the columns, with the pairs ``kept`` (n,) alone."""
        chosen = slice(None) if kept is None else kept
        parts = (self.tops, self.feet, self.mouths, self.depths, self.rooms_mm, self.kinks)
        return Truth(*(part[case : case + 1, chosen] for part in parts))

    def off_mm(self) -> Array:
        """How far each bar (n,) of one column stands off the place that most of the others give it."""
        offsets, about = self.tops[0] - self.mouths[0], self.mouths[0] - self.mouths[0].mean(axis=0)
        rows = np.zeros((len(about), 2, 3))
        rows[:, 0, 0] = rows[:, 1, 1] = 1.0
        rows[:, :, 2] = np.column_stack([-about[:, 1], about[:, 0]]) / np.abs(about).max()
        left = offsets
        for _ in range(_REWEIGHTED):
            weight = 1.0 / np.maximum(np.hypot(*left.T), 1e-3)
            normal = np.einsum("n,nij,nik->jk", weight, rows, rows)
            pose = np.linalg.solve(normal, np.einsum("n,nij,ni->j", weight, rows, offsets))
            left = offsets - rows @ pose
        return np.asarray(np.hypot(*left.T))

    def bent(self, labels: list[str], repair: RepairReport) -> Truth:
        """One column once its bars were bent as advised."""
        tops, feet = self.tops.copy(), self.feet.copy()
        for step in repair.steps:
            bar = labels.index(step.rebar)
            tops[0, bar] += step.bend_mm or (0.0, 0.0)
            lean = self.kinks[0, bar] if step.upright else self.tops[0, bar] - self.feet[0, bar]
            feet[0, bar] = tops[0, bar] - lean
        return replace(self, tops=tops, feet=feet)


def true_margin_mm(source: Array, target: Array, limits_mm: Array) -> float:
    """The largest slack that a pose leaves to all gaps: source (n, 2) turned and moved onto target (n, 2)."""
    angle = 2.0 * np.pi * np.arange(_CORNERS) / _CORNERS
    normal = np.column_stack([np.cos(angle), np.sin(angle)])
    reach = float(np.abs(source).max())
    turning = np.column_stack([-source[:, 1], source[:, 0]]) / reach
    gap = source - target
    columns = [(turning @ normal.T).reshape(-1), np.tile(normal[:, 0], len(gap)), np.tile(normal[:, 1], len(gap))]
    rows = np.column_stack([*columns, np.ones(len(gap) * _CORNERS)])
    right = (limits_mm[:, None] - gap @ normal.T).reshape(-1)
    found = linprog([0.0, 0.0, 0.0, -1.0], A_ub=rows, b_ub=right, bounds=[(None, None)] * 4, method="highs")
    return float(found.x[3])


def build_columns(
    scene: Scene, cases: int, rng: np.random.Generator, *, outlier_mm: tuple[float, float] | None = None
) -> list[Built]:
    """Columns whose true margins are drawn uniformly from ±1.5 mm, and their scans.

    ``outlier_mm`` moves one bar of each by a length between these besides, and leaves the margin to chance.
    """
    design = _design(scene)
    mouths = np.array([point.centre[:2] for point in design.sleeves])
    shape = (cases, len(mouths), 2)
    offsets = _offsets(scene, shape, rng)
    bar_leans, sleeve_leans, kinks = (
        spread * rng.normal(size=shape) for spread in (scene.lean_rad, scene.lean_rad, _kink_mm(scene))
    )
    wider = rng.normal(0.0, _SIZE_U_MM, (2, *shape[:2]))
    rooms_mm = (scene.sleeve_mm - scene.outer_mm + wider[0] - wider[1]) / 2.0
    wanted_mm = rng.uniform(-LONGEST_MARGIN_MM, LONGEST_MARGIN_MM, cases)

    def built(scales: Array) -> Truth:
        size = scales[:, None, None]
        tops = mouths + size * offsets
        feet = tops - size * bar_leans * scene.embedded_mm - kinks
        places = np.broadcast_to(mouths, shape)
        return Truth(tops, feet, places, places + size * sleeve_leans * scene.embedded_mm, rooms_mm, kinks)

    scales = np.full(cases, _OUTLIER_SCALE)
    if outlier_mm is None:
        scales = _scaled(built, wanted_mm)
    else:
        angle, length = rng.uniform(0.0, 2.0 * np.pi, cases), rng.uniform(*outlier_mm, cases) / _OUTLIER_SCALE
        odd = np.column_stack([length * np.cos(angle), length * np.sin(angle)])
        offsets[np.arange(cases), rng.integers(shape[1], size=cases)] += odd
    truth, size = built(scales), scales[:, None, None]
    margins = truth.margins_mm()
    columns = []
    for case in range(cases):
        sleeves = _scanned(design.sleeves, 0.0 * offsets[case], (size * sleeve_leans)[case], scene, rng)
        rebars = _scanned(design.rebars, (size * offsets)[case], (size * bar_leans)[case], scene, rng)
        kept = np.ones(shape[1], dtype=bool)
        kept[rng.choice(shape[1], scene.missing, replace=False)] = False
        seen = [bar if there else None for bar, there in zip(rebars, kept.tolist(), strict=True)]
        margin_mm = float(margins[case])
        seen_margin_mm = float(truth.only(case, kept).margins_mm()[0]) if scene.missing else margin_mm
        columns.append(Built(design, list(sleeves), seen, margin_mm, seen_margin_mm, truth.only(case)))
    return columns


def _offsets(scene: Scene, shape: tuple[int, ...], rng: np.random.Generator) -> Array:
    """Offsets (k, n, 2) of bars from sleeves before they are scaled."""
    offsets = rng.normal(size=shape)
    if scene.law == "disc":
        offsets *= (np.sqrt(rng.uniform(size=shape[:2])) / np.hypot(offsets[..., 0], offsets[..., 1]))[..., None]
    if scene.law == "odd":
        offsets[np.arange(shape[0]), rng.integers(shape[1], size=shape[0])] *= _ODD
    return offsets


def _kink_mm(scene: Scene) -> float:
    """Spread of where a bar's foot is, for a bar that may be bent by 2 mm a metre below what was seen of it."""
    return _STRAIGHT_U_RAD * max(scene.embedded_mm - scene.seen_mm, 0.0)


def _scaled(built: Callable[[Array], Truth], wanted_mm: Array) -> Array:
    """Factors (k,) of all errors that give the wanted margins, by halving; zero where none is large enough."""
    low, high = np.zeros(len(wanted_mm)), np.full(len(wanted_mm), 1.0)
    while (built(high).margins_mm() > wanted_mm).any():
        high = np.where(built(high).margins_mm() > wanted_mm, 2.0 * high, high)
    for _ in range(_HALVINGS):
        middle = (low + high) / 2.0
        enough = built(middle).margins_mm() > wanted_mm
        low, high = np.where(enough, middle, low), np.where(enough, high, middle)
    return low


def _design(scene: Scene) -> ColumnDesign:
    table = {
        "centres": PATTERNS[scene.pattern].tolist(),
        "sleeve_diameter": scene.sleeve_mm,
        "rebar_diameter": 18.0,
        "rebar_outer_diameter": scene.outer_mm,
        "embedded_length": scene.embedded_mm,
    }
    return inline_design("built", table)


def _scanned(
    points: tuple[AssemblyPoint, ...], offsets: Array, leans: Array, scene: Scene, rng: np.random.Generator
) -> list[AssemblyPoint]:
    u_mm = np.full(len(points), scene.u_mm)
    if scene.u_worse_mm is not None:
        u_mm[rng.choice(len(points), 2, replace=False)] = scene.u_worse_mm
    scanned = []
    for point, offset, lean, u in zip(points, offsets, leans, u_mm, strict=True):
        measured = lean + rng.normal(0.0, scene.u_lean_rad, 2)
        axis = np.array([*measured, 1.0]) / np.sqrt(1.0 + measured @ measured)
        scanned.append(
            replace(
                point,
                centre=point.centre + np.array([*(offset + rng.normal(0.0, u, 2)), 0.0]),
                axis=axis,
                covariance=u**2 * np.eye(3),
                axis_covariance=scene.u_lean_rad**2 * (np.eye(3) - np.outer(axis, axis)),
                seen_length_mm=scene.seen_mm,
            )
        )
    return scanned
