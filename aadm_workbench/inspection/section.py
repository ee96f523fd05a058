"""The section of a column's foot, from the scan of its sleeves."""

from __future__ import annotations

import math

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule
from aadm_workbench.assembly.matching.match import Match
from aadm_workbench.assembly.section.inspect import inspect_section
from aadm_workbench.extract.sample import Thinned, thinned
from aadm_workbench.extract.section.face_heights import FaceHeights, face_heights
from aadm_workbench.extract.section.outline import section_edges
from aadm_workbench.model import Array, ColumnDesign, Extraction, Profile, Scan
from aadm_workbench.model.section import SectionReport

_SAMPLE = 30_000  # points: a hundred in each cell of the face, whose median is then known to an eighth of the noise
_ROUGH_FACE_MM = 1.5  # scatter about the plane: feet that are roughened by order have no flatness


def section_of(
    design: ColumnDesign,
    scan: Scan,
    extraction: Extraction,
    match: Match,
    profile: Profile,
    decision: DecisionRule,
    rng: np.random.Generator,
) -> SectionReport | None:
    """The section of a foot; None where the design gives none, or where nothing says which edge is which."""
    if design.size_mm is None or design.section_middle_mm is None or extraction.plane is None or not match:
        return None
    if match.orientation == "ambiguous":
        return None
    T_column_scan = match.placements[0].T_design_scan
    middle, half = np.array(design.section_middle_mm), np.array(design.size_mm) / 2.0
    outline = middle + half * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    sample = thinned(scan, _SAMPLE, rng)
    T_scan_column = np.asarray(np.linalg.inv(T_column_scan), np.float64)
    bores_mm = [point.diameter_mm for point in design.sleeves]
    seen = section_edges(scan, sample, extraction, T_scan_column, outline, bores_mm)
    heights = _heights(design, sample, extraction, T_column_scan, middle, half)
    fit_u_mm = _fit_u_mm(extraction)
    places = np.array([point.centre[:2] for point in design.sleeves])
    spread_mm = float(np.sqrt(np.mean(np.sum((places - places.mean(axis=0)) ** 2, axis=1))))
    return inspect_section(
        design, seen, heights, profile, fit_u_mm=fit_u_mm, fit_u_turn=fit_u_mm / spread_mm, decision=decision
    )


def _heights(
    design: ColumnDesign,
    sample: Thinned,
    extraction: Extraction,
    T_column_scan: Array,
    middle: Array,
    half: Array,
) -> FaceHeights | None:
    assert extraction.plane is not None
    if extraction.plane.residual_mm > _ROUGH_FACE_MM:
        return None
    mouths = np.array([point.centre[:2] for point in design.sleeves])
    radius_mm = max(point.diameter_mm for point in design.sleeves) / 2.0
    return face_heights(sample, extraction.plane, T_column_scan, middle - half, middle + half, mouths, radius_mm)


def _fit_u_mm(extraction: Extraction) -> float:
    """Standard uncertainty per axis of the mean of all centres, but for what shifts them all: that moves edges, too."""
    own = [float(np.trace(point.covariance)) / 3.0 for point in extraction.points if point.covariance is not None]
    return math.sqrt(float(np.mean(own)) / len(own)) if own else 0.0
