"""What the verdicts on a column would be if its centres were known without error."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.inspect import inspect_group
from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial.virtual import try_scans
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.model import AssemblyPoint, ColumnDesign, Extraction, Kind, TrialPose, TrialReport, Verdict, worst
from aadm_workbench.twin.parts import BarGroup, Foot
from aadm_workbench.twin.scene import TrueScan, truth_of
from aadm_workbench.twin.scenes import Setting

_UP = np.array([0.0, 0.0, 1.0])  # of the column frame


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
