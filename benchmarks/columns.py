"""Columns as built whose true margin is known, and what a scan with stated uncertainties makes of them.

The truth is found in another way than by the code that is judged: discs become polygons and a small turn is linear, so
that the largest slack in millimetres over all poses is a linear program, solved by SciPy. The polygons lie around their
discs by 0.1 %, and a turn by a milliradian is linear to 0.1 µm.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import linprog

from aadm_workbench.design.pattern import inline_design
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, RepairReport

LIMIT_MM = 3.0
LONGEST_MARGIN_MM = 1.5

_CORNERS = 96
_REACHED_MM = 0.02

# What the product states of diameters and of the straightness of bars; benchmark and code must not share it.
_SIZE_U_MM = 0.06
_STRAIGHT_U_RAD = 0.002


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

    @property
    def u_pair_mm(self) -> float:
        """Standard uncertainty per axis of what a pair keeps: both centres and one lean."""
        return float(np.hypot(np.sqrt(2.0) * self.u_mm, self.u_lean_rad * self.embedded_mm))


SCENES = (
    Scene("36/20"),
    Scene("28/20", 28.0),
    Scene("26/18", 26.0, 21.3),
    Scene("leaning", 32.0, lean_rad=0.02, u_lean_rad=0.002),
    Scene("u 0.2", 36.0, u_mm=0.2, u_lean_rad=0.002),
    Scene("u 0.3, 28/20", 28.0, u_mm=0.3, u_lean_rad=0.002),
    Scene("hardly seen", u_worse_mm=3.0),
    Scene("unmeasured", missing=1),
)


@dataclass(frozen=True, eq=False)
class Built:
    """A column as built and as measured: ``margin_mm`` is the slack of the best pose, all limits being in mm.

    ``tops``, ``feet``, ``mouths``, ``depths`` (n, 2) mm are where the bars' axes end and where the sleeves' do.
    """

    design: ColumnDesign
    sleeves: list[AssemblyPoint | None]
    rebars: list[AssemblyPoint | None]
    margin_mm: float
    tops: Array
    feet: Array
    mouths: Array
    depths: Array
    rooms_mm: Array

    def margin_after_mm(self, repair: RepairReport) -> float:
        """The true margin once the bars were bent as advised."""
        labels = [bar.label for bar in self.design.rebars]
        by = np.zeros_like(self.tops)
        for step in repair.steps:
            by[labels.index(step.rebar)] = step.bend_mm or (0.0, 0.0)
        return _margin_mm(self.tops + by, self.feet + by, self.mouths, self.depths, self.rooms_mm)


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


def _margin_mm(tops: Array, feet: Array, mouths: Array, depths: Array, rooms_mm: Array) -> float:
    source, target = np.concatenate([tops, feet, tops]), np.concatenate([mouths, mouths, depths])
    return true_margin_mm(source, target, np.concatenate([np.full(len(tops), LIMIT_MM), rooms_mm, rooms_mm]))


def build_column(scene: Scene, centres: Array, rng: np.random.Generator, *, outlier_mm: float = 0.0) -> Built:
    """A column whose true margin is drawn uniformly from ±1.5 mm, and its scan.

    ``outlier_mm`` moves one bar by so much besides, and leaves the margin to chance.
    """
    design = _design(scene, centres)
    mouths, count = np.array([point.centre[:2] for point in design.sleeves]), len(centres)
    offsets, bar_leans, sleeve_leans, kinks = (
        spread * rng.normal(size=(count, 2)) for spread in (1.0, scene.lean_rad, scene.lean_rad, _kink_mm(scene))
    )
    wider = rng.normal(0.0, _SIZE_U_MM, (2, count))
    rooms_mm = (scene.sleeve_mm - scene.outer_mm + wider[0] - wider[1]) / 2.0
    wanted_mm = rng.uniform(-LONGEST_MARGIN_MM, LONGEST_MARGIN_MM)

    def built(scale: float) -> tuple[Array, Array, Array]:
        tops = mouths + scale * offsets
        return (
            tops,
            tops - scale * bar_leans * scene.embedded_mm - kinks,
            mouths + scale * sleeve_leans * scene.embedded_mm,
        )

    if outlier_mm:
        angle, scale = rng.uniform(0.0, 2.0 * np.pi), 0.4
        offsets[int(rng.integers(count))] += outlier_mm / scale * np.array([np.cos(angle), np.sin(angle)])
    else:
        scale = _scaled(lambda factor: _margin_mm(*built(factor)[:2], mouths, built(factor)[2], rooms_mm), wanted_mm)
    tops, feet, depths = built(scale)
    sleeves = _scanned(design.sleeves, 0.0 * offsets, scale * sleeve_leans, scene, rng)
    rebars = _scanned(design.rebars, scale * offsets, scale * bar_leans, scene, rng)
    for index in rng.choice(count, scene.missing, replace=False).tolist():
        rebars[index] = None
    margin_mm = _margin_mm(tops, feet, mouths, depths, rooms_mm)
    return Built(design, sleeves, rebars, margin_mm, tops, feet, mouths, depths, rooms_mm)


def _kink_mm(scene: Scene) -> float:
    """Spread of where a bar's foot is, for a bar that may be bent by 2 mm a metre below what was seen of it."""
    return _STRAIGHT_U_RAD * max(scene.embedded_mm - scene.seen_mm, 0.0)


def _scaled(margin_mm: Callable[[float], float], wanted_mm: float) -> float:
    """A factor of all errors that gives the wanted margin, by secants; zero where none is large enough."""
    points = [(0.0, margin_mm(0.0)), (1.5, margin_mm(1.5))]
    for _ in range(8):
        (low, at_low), (high, at_high) = points[-2:]
        if abs(at_high - at_low) < 1e-9:
            break
        scale = max(low + (wanted_mm - at_low) * (high - low) / (at_high - at_low), 0.0)
        points.append((scale, margin_mm(scale)))
        if abs(points[-1][1] - wanted_mm) < _REACHED_MM or scale == 0.0:
            break
    return points[-1][0]


def _design(scene: Scene, centres: Array) -> ColumnDesign:
    table = {
        "centres": centres.tolist(),
        "sleeve_diameter": scene.sleeve_mm,
        "rebar_diameter": 18.0,
        "rebar_outer_diameter": scene.outer_mm,
        "embedded_length": scene.embedded_mm,
    }
    return inline_design("built", table)


def _scanned(
    points: tuple[AssemblyPoint, ...], offsets: Array, leans: Array, scene: Scene, rng: np.random.Generator
) -> list[AssemblyPoint | None]:
    u_mm = np.full(len(points), scene.u_mm)
    if scene.u_worse_mm is not None:
        u_mm[rng.choice(len(points), 2, replace=False)] = scene.u_worse_mm
    scanned: list[AssemblyPoint | None] = []
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
