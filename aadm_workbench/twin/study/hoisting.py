"""Runs methods over frames of a hanging column: the paper's parameter studies, on scenes whose truth is known."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from aadm_workbench.assembly.pose.eopa import NoFit
from aadm_workbench.assembly.pose.minimax import fit_minimax
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.hoisting.measure import HoistingSettings, measure_hoisting
from aadm_workbench.hoisting.pairs import key_labels
from aadm_workbench.hoisting.published import measure_published
from aadm_workbench.model import Array, ColumnDesign, HoistingMeasurement, Scan
from aadm_workbench.twin.hoisting import Hang, HoistingScan, Stand, hoisting_scan
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.scenes import FIELD, LAB, Setting, random_bars, random_foot

REFINED = "refined"
NEAR = (-1, -1)
"""The corner that the camera stands at: signs of x and y."""
LOST_MM = 15.0
"""A key pair whose distance is this far off is another pair: the method has lost it."""

# 0.93 mm along the diagonal, by which the column hangs off where a study does not say: a choice
_SHIFT_MM = (0.66, -0.66)
_LIMIT_MM = 3.0  # GB/T 51231-2016, 10.4


@dataclass(frozen=True)
class Cell:
    """One setting of a study: ``name`` or ``value`` of its parameter, and the scene that it stands for."""

    name: str
    value: float
    setting: Setting
    hang: Hang
    stand: Stand


@dataclass(frozen=True)
class FrameResult:
    """One method on one frame.

    ``keys`` are errors, mm, of the left, middle and right key pairs, None where one was lost; ``seen``, ``inferred``
    the errors of all pairs that were seen, and of the others; ``correction`` the error of the move (mm, degrees);
    ``seconds`` without reading; ``reason`` why nothing was measured.
    """

    cell: str
    scene: int
    method: str
    keys: tuple[float | None, float | None, float | None]
    seen: tuple[float, ...]
    inferred: tuple[float, ...]
    covered: tuple[bool, ...]
    correction: tuple[float, float] | None
    seconds: float
    reason: str


@dataclass(frozen=True)
class HoistingStudy:
    """All that was measured in a run, with what is needed to repeat it."""

    name: str
    seed: int
    scenes: int
    methods: tuple[str, ...]
    cells: tuple[Cell, ...]
    results: tuple[FrameResult, ...]

    def of(self, cell: Cell, method: str) -> tuple[FrameResult, ...]:
        """The results of one method in one cell."""
        return tuple(r for r in self.results if (r.cell, r.method) == (cell.name, method))


def cells_of(study: str) -> tuple[Cell, ...]:
    """The cells of the paper's studies: ``distance``, ``height``, ``angle``, ``spacing`` and ``conditions``."""
    if study == "distance":
        return tuple(_cell(d, 90.0, d) for d in (550.0, 650.0, 750.0, 850.0, 950.0, 1050.0))
    if study == "height":
        return tuple(_cell(h, h, 850.0) for h in (90.0, 120.0, 150.0, 180.0, 210.0))
    if study == "angle":
        return tuple(_cell(a, 180.0, 850.0, angle=a) for a in (0.0, 10.0, 20.0, 30.0, 40.0))
    if study == "spacing":
        return tuple(_cell(s, 180.0, 850.0, angle=30.0, spacing=s) for s in (0.0, 20.0, 40.0, 60.0, 80.0, 100.0))
    return (
        _cell(0.0, 180.0, 850.0, name="180 mm high"),
        _cell(1.0, 180.0, 850.0, angle=30.0, name="and turned 30 degrees"),
        _cell(2.0, 180.0, 850.0, angle=30.0, spacing=100.0, name="and 100 mm aside"),
        _cell(3.0, 180.0, 720.0, setting=FIELD, name="field, 720 mm away"),
    )


def _cell(
    value: float,
    height: float,
    distance: float,
    *,
    angle: float = 0.0,
    spacing: float = 0.0,
    setting: Setting = LAB,
    name: str | None = None,
) -> Cell:
    hang = Hang(height, angle, spacing, shift=_SHIFT_MM)
    return Cell(f"{value:g}" if name is None else name, value, setting, hang, Stand(distance))


def study_hoisting(
    name: str,
    cells: Sequence[Cell],
    methods: Sequence[str],
    *,
    scenes: int,
    seed: int,
    finished: Callable[[str], None] = lambda step: None,
    clock: Callable[[], float] = perf_counter,
) -> HoistingStudy:
    """Run methods over random scenes of some cells.

    Parameters
    ----------
    scenes
        How many of each cell.
    seed
        The same seed gives the same frames.
    finished
        Called after each frame with what it was.

    Raises
    ------
    MissingDependencyError
        Where the ray caster or what a method needs is not installed.
    """
    results: list[FrameResult] = []
    warm: set[str] = set()
    for number, cell in enumerate(cells):
        for scene in range(scenes):
            rng = np.random.default_rng([seed, *name.encode(), number, scene])
            truth = random_frame(cell, rng)
            design, scan = design_of(cell.setting), truth.frame.scan()
            for method in methods:
                if method not in warm:  # no import is part of a time
                    _run(scan, design, method)
                    warm.add(method)
                began = clock()
                found = _run(scan, design, method)
                results.append(_compared(cell, scene, method, found, truth, design, clock() - began))
            finished(f"{cell.name}, scene {scene + 1}")
    return HoistingStudy(name, seed, scenes, tuple(methods), tuple(cells), tuple(results))


def random_frame(cell: Cell, rng: np.random.Generator) -> HoistingScan:
    """A random foot over random bars, hung and seen as a cell says."""
    foot, bars = random_foot(cell.setting, rng), random_bars(cell.setting, rng)
    return hoisting_scan(foot, bars, cell.hang, cell.stand, CameraNoise.drawn(rng), rng, near=NEAR)


def design_of(setting: Setting) -> ColumnDesign:
    """The design of a setting's column."""
    table = {
        "sleeve_diameter": setting.sleeve_diameter,
        "rebar_diameter": setting.bar_diameter,
        "embedded_length": setting.exposed,
        "size": [setting.size, setting.size],
        "centres": setting.centres().tolist(),
    }
    return inline_design(f"{setting.name}-1", table)


def _run(scan: Scan, design: ColumnDesign, method: str) -> HoistingMeasurement:
    if method == REFINED:
        return measure_hoisting(scan, design, near=NEAR, settings=HoistingSettings())
    return measure_published(scan, design, method, near=NEAR, rng=np.random.default_rng(0))


def _compared(
    cell: Cell,
    scene: int,
    method: str,
    found: HoistingMeasurement,
    truth: HoistingScan,
    design: ColumnDesign,
    seconds: float,
) -> FrameResult:
    pairs = dict(zip((sleeve.label for sleeve in design.sleeves), truth.pairs, strict=True))
    errors = {
        pair.sleeve: abs(pair.distance_mm - pairs[pair.sleeve].distance_mm)
        for pair in found.report.pairs
        if pair.distance_mm is not None
    }
    seen = {pair.sleeve for pair in found.report.pairs if pair.seen}
    left, middle, right = (
        error if (error := errors.get(label)) is not None and error < LOST_MM else None
        for label in key_labels(design, NEAR)
    )
    covered: tuple[bool, ...] = ()
    correction = None
    if method == REFINED and not np.isnan(found.offsets_mm).all():
        covered = _covered(found, np.array([pair.offset_mm for pair in truth.pairs]))
        correction = _correction_error(found, truth)
    reason = "; ".join(found.report.reasons) if not errors else ""
    return FrameResult(
        cell.name,
        scene,
        method,
        (left, middle, right),
        tuple(error for label, error in errors.items() if label in seen),
        tuple(error for label, error in errors.items() if label not in seen),
        covered,
        correction,
        seconds,
        reason,
    )


def _covered(found: HoistingMeasurement, true: Array) -> tuple[bool, ...]:
    """Whether the 95 % region of each pair holds the truth."""
    off = found.offsets_mm - true
    squared = np.einsum("ki,kij,kj->k", off, np.linalg.inv(found.covariances), off)
    return tuple(bool(value) for value in squared < 5.991)


def _correction_error(found: HoistingMeasurement, truth: HoistingScan) -> tuple[float, float] | None:
    """How far the correction is from that of the true centres of the same pairs: mm, and degrees."""
    places = np.array([truth.T_bars_scan[:3, :3] @ pair.sleeve_scan_mm for pair in truth.pairs])
    origin = truth.T_bars_column[:3, 3] - truth.T_bars_scan[:3, 3]
    source = (places - origin)[:, :2]
    offsets = np.array([pair.offset_mm for pair in truth.pairs])
    move = found.report.correction
    if move is None:
        return None
    over = [k for k, pair in enumerate(found.report.pairs) if pair.sleeve in move.over]
    true = fit_minimax(source[over], (source + offsets)[over], np.full(len(over), _LIMIT_MM))
    if isinstance(true, NoFit):
        return None
    shift = float(np.hypot(move.dx_mm - true.shift[0], move.dy_mm - true.shift[1]))
    return shift, float(abs(move.yaw_deg - np.degrees(true.yaw)))
