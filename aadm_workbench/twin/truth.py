"""What the verdicts on a column would be if its centres were known without error."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.inspect import inspect_group
from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.pose.eopa import EopaFit, fit_eopa_planar
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial.virtual import try_scans
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.model import (
    AssemblyPoint,
    ColumnDesign,
    Extraction,
    Json,
    Kind,
    TrialPose,
    TrialReport,
    Verdict,
    worst,
)
from aadm_workbench.twin.parts import BarGroup, Foot
from aadm_workbench.twin.scene import TrueScan, truth_of
from aadm_workbench.twin.scenes import Setting

_UP = np.array([0.0, 0.0, 1.0])  # of the column frame
DECIMALS = 4
"""Of truth in millimetres: 0.1 µm is finer than anything that it is compared with."""


@dataclass(frozen=True)
class TrueVerdicts:
    """Verdicts by the profile on exact centres, compared as ``decision = "simple"`` does."""

    verdict: Verdict
    goes_on: Verdict
    least_squares: dict[str, object] | None
    minimax: dict[str, object] | None


def true_verdicts(design: ColumnDesign, foot: Foot, bars: BarGroup | None, profile: str = "cn") -> TrueVerdicts:
    """Judge as-built parts by their exact centres; a plugged sleeve counts as not measured."""
    rules = load_profile(profile)
    sleeves = tuple(p for p, s in zip(truth_of(foot), foot.sleeves, strict=True) if s.plugged_at is None)
    groups = {Kind.SLEEVE: _exact(Kind.SLEEVE, sleeves)}
    if bars is not None:
        groups[Kind.REBAR] = _exact(Kind.REBAR, truth_of(bars))
    matches = {
        kind: match_extraction(design.points(kind), found, up=90.0, image_up_scan=np.array([0.0, 1.0, 0.0]))
        for kind, found in groups.items()
    }
    verdicts = [
        inspect_group(design.points(kind), groups[kind], matches[kind], rules, decision="simple").verdict
        for kind in groups
    ]
    if bars is None:
        return TrueVerdicts(worst(verdicts), Verdict.NOT_ASSESSED, None, None)
    trial = try_scans(
        design,
        (groups[Kind.SLEEVE], matches[Kind.SLEEVE]),
        (groups[Kind.REBAR], matches[Kind.REBAR]),
        rules,
        np.random.default_rng(0),
        decision="simple",
    )
    verdicts.append(trial.verdict)
    return TrueVerdicts(worst(verdicts), trial.verdict, _said(trial, trial.least_squares), _said(trial, trial.minimax))


def _exact(kind: Kind, points: tuple[AssemblyPoint, ...]) -> Extraction:
    return Extraction(kind, "truth", points, None, _UP, "truth")


def _said(trial: TrialReport, pose: TrialPose | None) -> dict[str, object] | None:
    """The largest distance in a pose, and what it alone would come to."""
    if pose is None:
        return None
    fails = any(pair.verdict is Verdict.FAIL for pair in pose.pairs)
    verdict = Verdict.FAIL if fails else Verdict.NOT_MEASURED if trial.missing else Verdict.PASS
    return {"max_mm": round(pose.max_mm, 4), "verdict": verdict.value}


def sample_design(setting: Setting) -> ColumnDesign:
    """The design of a setting, as a job without a model would give it."""
    table = {
        "centres": setting.centres().tolist(),
        "sleeve_diameter": setting.sleeve_diameter,
        "rebar_diameter": setting.bar_diameter,
        "size": [setting.size, setting.size],
    }
    return inline_design(setting.name, table)


def listed(scan: TrueScan, foot: Foot) -> list[dict[str, object]]:
    """The true points of a scan as ``truth.json`` lists them; a plugged sleeve is not measurable."""
    return [
        {
            "label": point.label,
            "column_mm": np.round(point.centre, 4).tolist(),
            "scan_mm": np.round(in_scan, 4).tolist(),
            "diameter_mm": round(point.diameter_mm, 4),
            "measurable": not (point.label.startswith("S") and foot.sleeves[k].plugged_at is not None),
        }
        for k, (point, in_scan) in enumerate(zip(scan.points, scan.points_scan(), strict=True))
    ]


def section_truth(design: ColumnDesign, foot: Foot) -> dict[str, Json]:
    """The section of a foot as ``truth.json`` tells it; column frame that it was made in, mm and degrees.

    ``pattern_offset_mm`` and ``pattern_turn_deg``: of the sleeves as a group, fitted to their design, in the section;
    its turn is the mean of its edges'. ``squareness_deg``: turn of the edges -y and +y less that of -x and +x.
    ``flatness_mm``: the range of the whole face over its own plane; a rough one's is not told.
    """
    cast = foot.cast
    corners = foot.corners()
    built = np.array([[sleeve.x, sleeve.y] for sleeve in foot.sleeves])
    planned = np.array([point.centre[:2] for point in design.sleeves])
    fit = fit_eopa_planar(built, planned)
    told: dict[str, Json] = {
        "size_mm": [round(side, DECIMALS) for side in foot.size],
        "corners_mm": np.round(corners, DECIMALS).tolist(),
        "squareness_deg": round(float(np.degrees(cast.shear)), DECIMALS),
        "flatness_mm": None if foot.roughness is not None else round(_flatness(foot), DECIMALS),
        "breaks": [
            {"side": one.side, "at_mm": round(one.at, DECIMALS), "length_mm": length, "depth_mm": depth}
            for one in cast.breaks
            for depth in [round(one.depth, DECIMALS)]
            for length in [depth if len(one.side) == 4 else round(one.length, DECIMALS)]
        ],
    }
    if isinstance(fit, EopaFit):
        middle = corners.mean(axis=0) @ fit.R + fit.t
        designed = np.array(design.section_middle_mm or (0.0, 0.0))
        told["pattern_offset_mm"] = np.round(designed - middle, DECIMALS).tolist()
        told["pattern_turn_deg"] = round(float(np.degrees(cast.shear / 2.0 - cast.turn - fit.yaw)), DECIMALS)
    return told


def _flatness(foot: Foot) -> float:
    """Range of a smooth face over the plane through it by least squares, mm."""
    x, y = (part.ravel() for part in np.meshgrid(*(np.linspace(-side / 2, side / 2, 41) for side in foot.size)))
    level = foot.cast.level(foot.size, x, y)
    terms = np.column_stack([np.ones_like(x), x, y])
    return float(np.ptp(level - terms @ np.linalg.lstsq(terms, level, rcond=None)[0]))
