"""report.json: the names of the contract, numbers that are numbers, the same bytes, and a schema that notices slips."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

from aadm_workbench.model import (
    AbsolutePoint,
    AbsolutePosition,
    Candidate,
    Capability,
    ColumnReport,
    ControlResidual,
    Correction,
    Fit,
    GroupReport,
    HoistingPair,
    HoistingReport,
    JobReport,
    Kind,
    MouldDrift,
    PairResult,
    PointResult,
    PoseWindow,
    Profile,
    RepairAction,
    RepairReport,
    RepairStep,
    Rule,
    RuleResult,
    SleeveDrift,
    SpacingResult,
    TrialPose,
    TrialReport,
    TurnResult,
    Verdict,
)
from aadm_workbench.report.json import encode, encoded_report, report_schema, write_report

ROOT = Path(__file__).resolve().parents[2]
T = np.array([[0.0, -1.0, 0.0, 1e6 / 3], [1.0, 0.0, 0.0, -2.0], [0.0, 0.0, 1.0, 1.0 / 3], [0.0, 0.0, 0.0, 1.0]])
RULE = Rule("sleeve_position", "sleeve_position", 2.0, None, "T/CCES 30-2022, 4.3.3", "should", "verified")
RESULT = RuleResult("sleeve_position", "T/CCES 30-2022, 4.3.3", "verified", Verdict.FAIL, True, "S1", 2.4123456)


def group(kind: Kind) -> GroupReport:
    """Two points, one of them not measured."""
    first, second = f"{kind.letter}1", f"{kind.letter}2"
    measured = PointResult(
        first,
        "0" * 22,
        (-90.0, -90.0, 0.0),
        (1.0 / 3, 2.0, 800.0),
        (-88.0, -90.0, -0.0),
        26.0,
        0.3,
        (2.4, 0.0),
        2.4123456789,
        0.05,
        2.0,
        Verdict.FAIL,
        f"{first} is 2.41 mm from design",
        0.0001,
        119.5,
    )
    lost = PointResult(
        second, None, (90.0, -90.0, 0.0), None, None, None, None, None, None, None, 2.0, Verdict.NOT_MEASURED, "plugged"
    )
    spacing = SpacingResult((first, second), 180.0, None, None, None, (-2.0, 2.0), Verdict.NOT_MEASURED, "S2")
    fit = Fit(T, 0.5, 2.4, "ambiguous", (Candidate(0.0, 0.5, 2.4, 1, 90.0, Verdict.FAIL), Candidate(90.0, 0.6, 2.5, 1)))
    quality = {"pitch_mm": np.float32(0.3), "points": np.int64(12), "nothing": float("nan"), "list": (1, None, True)}
    return GroupReport(
        f"scans/{kind.plural}.tiff",
        "a" * 64,
        "refined",
        2,
        1,
        Verdict.FAIL,
        (measured, lost),
        (spacing,),
        fit,
        (RESULT,),
        (f"{first} is 2.41 mm from design",),
        ("absolute position not checked",),
        quality,
        absolute(first) if kind is Kind.REBAR else None,
    )


def absolute(label: str) -> AbsolutePosition:
    """A group of bars that stands off, by two control points."""
    points = tuple(
        ControlResidual(name, (1.0, 2.0, 3.0), (4.0, 5.0, 6.0), (0.1, -0.1, 0.0), 0.5) for name in ("G1", "G2")
    )
    bar = AbsolutePoint(label, (9.0, 0.0), 9.0, 0.4, 8.0, Verdict.FAIL, 0.01, "R1 is 9.00 mm from its place")
    return AbsolutePosition(
        Verdict.FAIL,
        "the group",
        points,
        T,
        "scan",
        0.14,
        (9.0, 0.0),
        9.0,
        0.4,
        0.12,
        0.05,
        8.0,
        "a clause",
        0.01,
        (bar,),
    )


def repair(pose: TrialPose) -> RepairReport:
    """A bend and a sleeve to reject."""
    bend = RepairStep(
        RepairAction.BEND, "S1", "R1", (-3.0, 0.5), 3.04, 1.2, False, 3.1, 0.4, 2.0, 0.1, "R1 then is where it belongs"
    )
    reject = RepairStep(
        RepairAction.REJECT_SLEEVE, "S2", "R2", None, None, None, True, 0.3, None, None, 6.0, "S2 is off"
    )
    return RepairReport(
        RepairAction.REJECT_SLEEVE, "reject S2", (bend, reject), True, pose, 0.2, 0.99, 5.0, "no clause", notes=("one",)
    )


def mould() -> MouldDrift:
    """A sleeve that drifts, and one without scatter."""
    capable = Capability("x", 1.5, (0.9, 2.1), 1.2, (0.6, 1.8))
    drifting = SleeveDrift("S1", 3, (1.0, 0.0), (0.2, 0.2), (0.1, 0.1), 0.001234567, True, False, (capable,))
    still = SleeveDrift(
        "S2", 3, (0.0, 0.0), (0.0, 0.0), (0.0, 0.0), None, False, False, (Capability("y", *[None] * 4),)
    )
    ids = ("C-1", "C-2", "C-3")
    return MouldDrift("PCZ-1", ids, 0.002, 0.1, 2.0, 1.41421356, "the square", (drifting, still), "S1 by 1 mm")


def full_report() -> JobReport:
    """A report that uses every noun there is."""
    pair = PairResult("S1", "R1", (0.1, -0.0), 0.1, 0.07, 3.0, 2.4, Verdict.PASS, probability=1.0)
    pose = TrialPose(T, 0.1, 0.1, 0.0, (pair,))
    trial = TrialReport(
        Verdict.NOT_MEASURED,
        pose,
        pose,
        (),
        ("S2",),
        ("S2 is missing",),
        (),
        0.987654321,
        0.966666666,
        PoseWindow((-1.0, 1.0), (-1.0, 1.0), (-0.5, 0.5)),
        0.0,
        (TurnResult(0.0, 0.1, Verdict.PASS), TurnResult(90.0, None, Verdict.NOT_MEASURED)),
        160.0,
        ("diameter over the ribs after GB/T 1499.2",),
    )
    hanging = HoistingReport(
        "hoist-1.tiff",
        ("S1",),
        1.0,
        1.5,
        0.25,
        Verdict.FAIL,
        (
            HoistingPair("S1", "R1", (0.0, 0.0, 500.0), (0.0, 0.0, 700.0), (1.0, 0.0), 1.0, 0.1, True),
            HoistingPair("S2", "R2", None, None, None, None, None, False, "out of view"),
        ),
        Correction(1.0, -0.0, 0.1),
        ("move it",),
        "b" * 64,
        "refined",
    )
    full = ColumnReport(
        "柱-301",
        Verdict.FAIL,
        Verdict.NOT_MEASURED,
        ("S1 is 2.41 mm from design",),
        group(Kind.SLEEVE),
        group(Kind.REBAR),
        trial,
        (hanging,),
        "0" * 22,
        "PCZ-1",
        "3F",
        "C/1",
        (250, 250),
        T,
        (RESULT,),
        ("a note",),
        repair(pose),
    )
    bare = ColumnReport("C-302", Verdict.ERROR, Verdict.NOT_ASSESSED, ("no such file",))
    return JobReport(
        {"name": "aadm", "version": "0.1.0"},
        {"name": "Floor 3", "sha256": "c" * 64},
        {"date": "2026-11-20"},
        {"source": "floor3.ifc", "sha256": "d" * 64},
        Profile("cn", "China", (RULE,), 5.0),
        (full, bare),
        (mould(),),
    )


def valid(document: Any) -> bool:
    """Whether a document is what the schema describes."""
    return bool(jsonschema.Draft202012Validator(report_schema()).is_valid(document))


@pytest.fixture
def document() -> Any:
    """report.json as it is read back."""
    return json.loads(encoded_report(full_report()))


def test_schema_is_one() -> None:
    jsonschema.Draft202012Validator.check_schema(report_schema())


def test_full_report_is_valid(document: Any) -> None:
    jsonschema.Draft202012Validator(report_schema()).validate(document)


CONTRACT = {
    "": "schema tool job capture model profile summary columns",
    "columns.0": "id global_id piece_mark storey grid size_mm T_model_column verdict goes_on reasons sleeves rebars "
    "trial_assembly hoisting",
    "columns.0.sleeves": "source sha256 method expected found quality points spacing fit",
    "columns.0.sleeves.points.0": "label global_id design_mm scan_mm aligned_mm diameter_mm axis_tilt_deg offset_mm "
    "deviation_mm u_mm limit_mm verdict reason",
    "columns.0.sleeves.spacing.0": "between design_mm measured_mm deviation_mm u_mm limit_mm verdict",
    "columns.0.sleeves.fit": "T_design_scan rms_mm max_mm orientation candidates",
    "columns.0.rebars.points.0": "label exposed_length_mm",
    "columns.0.trial_assembly": "least_squares minimax collisions verdict",
    "columns.0.trial_assembly.minimax": "T_sleeves_rebars max_mm mean_mm sd_mm pairs",
    "columns.0.trial_assembly.least_squares.pairs.0": "sleeve rebar offset_mm distance_mm u_mm clearance_mm verdict",
    "columns.0.hoisting.0": "source keys mean_mm max_mm column_tilt_deg verdict pairs correction",
    "columns.0.hoisting.0.pairs.0": "sleeve rebar sleeve_scan_mm rebar_scan_mm offset_mm distance_mm u_mm seen",
    "columns.0.hoisting.0.correction": "dx_mm dy_mm yaw_deg",
}


def at(document: Any, path: str) -> Any:
    """What stands at ``columns.0.id``."""
    for key in path.split(".") if path else ():
        document = document[int(key) if isinstance(document, list) else key]
    return document


@pytest.mark.parametrize("path", CONTRACT)
def test_keys_of_the_contract(document: Any, path: str) -> None:
    assert set(CONTRACT[path].split()) <= set(at(document, path))


def test_only_bars_stick_out(document: Any) -> None:
    assert "exposed_length_mm" not in at(document, "columns.0.sleeves.points.0")
    assert at(document, "columns.0.rebars.points.0.exposed_length_mm") == 119.5
    assert "absolute" not in at(document, "columns.0.sleeves")
    assert at(document, "columns.0.rebars.absolute.offset_mm") == [9.0, 0.0]


def test_advice_and_moulds(document: Any) -> None:
    assert at(document, "columns.0.repair.steps.0.bend_mm") == [-3.0, 0.5]
    assert at(document, "columns.0.repair.steps.1.bend_mm") is None
    assert at(document, "columns.0.repair.subject_to") == "the engineer's release"
    assert at(document, "columns.1.repair") is None
    assert at(document, "mould_drift.0.sleeves.0.p_value") == 0.001235
    assert at(document, "mould_drift.0.axis_limit_mm") == 1.4142


def test_numbers(document: Any) -> None:
    assert at(document, "columns.0.sleeves.points.0.deviation_mm") == 2.4123
    assert at(document, "columns.0.sleeves.points.0.scan_mm") == [0.3333, 2.0, 800.0]
    assert at(document, "columns.0.size_mm") == [250.0, 250.0]
    assert at(document, "columns.0.trial_assembly.probability") == 0.987654
    assert at(document, "columns.0.T_model_column") == [
        [0.0, -1.0, 0.0, 333333.333333],
        [1.0, 0.0, 0.0, -2.0],
        [0.0, 0.0, 1.0, 0.333333],
        [0.0, 0.0, 0.0, 1.0],
    ]
    assert at(document, "columns.0.sleeves.quality") == {
        "pitch_mm": 0.3,
        "points": 12,
        "nothing": None,
        "list": [1, None, True],
    }
    assert at(document, "profile.rules.0")["upper_mm"] == 2.0
    assert at(document, "profile.rules.0")["lower_mm"] is None
    text = encoded_report(full_report()).decode()
    assert not any(word in text for word in ("NaN", "Infinity", "-0.0"))


def test_vectors_stand_on_one_line_and_texts_are_left_alone() -> None:
    assert encode({"a": [1.5, None, -2], "b": "[\\n 1,\\n 2]", "c": [], "d": ["x"]}).decode().splitlines() == [
        "{",
        ' "a": [1.5, null, -2],',
        ' "b": "[\\\\n 1,\\\\n 2]",',
        ' "c": [],',
        ' "d": [',
        '  "x"',
        " ]",
        "}",
    ]


def test_last_bits_do_not_show(tmp_path: Path) -> None:
    report = full_report()
    write_report(report, tmp_path / "a.json")
    moved = T * (1.0 + 1e-16)
    moved[0, 3] += 1e-9
    first = replace(report.columns[0], T_model_column=moved)
    jittered = replace(report, columns=(first, *report.columns[1:]))
    write_report(jittered, tmp_path / "b.json")
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()
