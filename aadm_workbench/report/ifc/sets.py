"""Property sets of one checked column: what each element of the model is told about itself, with its IFC types.

Property names and types are a contract: ``resources/aadm-results.ids`` checks them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from aadm_workbench.model import ColumnReport, JobReport, Kind, PointResult, SpacingResult
from aadm_workbench.report.clauses import clause_of
from aadm_workbench.report.ifc.addition import ENUMERATED, Property, Scalar

COLUMN_SET = "AADM_ColumnCheck"
SETTING_SET = "AADM_Setting"
POINT_SETS = {Kind.SLEEVE: "AADM_SleeveCheck", Kind.REBAR: "AADM_RebarCheck"}
_LENGTH, _POSITIVE, _LABEL, _TEXT = "IfcLengthMeasure", "IfcPositiveLengthMeasure", "IfcLabel", "IfcText"
_ANGLE, _SHARE, _RATIO = "IfcPlaneAngleMeasure", "IfcNormalisedRatioMeasure", "IfcRatioMeasure"
_DIAMETER_PER_U = 4.0
"""A range diameter of 95 to 100 % is as wide as two times k = 2 standard uncertainties."""


def column_properties(report: JobReport, column: ColumnReport) -> list[Property]:
    """AADM_ColumnCheck; what was not measured is left out, the verdict says so."""
    return list(_told([*_verdicts(column), *_largest(column), *_trial(column), *_hoisting(column), *_audit(report)]))


def point_properties(report: JobReport, column: ColumnReport, kind: Kind, point: PointResult) -> list[Property]:
    """AADM_SleeveCheck or AADM_RebarCheck of one point.

    Offsets are measured minus design in the column frame, the pair's are bar minus sleeve at the best pose;
    ``Uncertainty`` is per axis, k = 1.
    """
    offset = point.offset_mm or (None, None)
    built = point.aligned_mm or (None, None, None)
    clause = clause_of(report, f"{kind}_position", point.limit_mm)
    told: list[tuple[str, str, Scalar | None]] = [
        ("Label", _LABEL, point.label),
        ("Column", _TEXT, column.id),
        ("Verdict", _LABEL, point.verdict),
        ("Measured", "IfcBoolean", point.scan_mm is not None),
        ("OffsetX", _LENGTH, offset[0]),
        ("OffsetY", _LENGTH, offset[1]),
        ("Deviation", _LENGTH, point.deviation_mm),
        ("Uncertainty", _LENGTH, point.u_mm),
        ("Limit", _POSITIVE, point.limit_mm),
        ("Clause", _TEXT, clause.text or None),
        ("ClauseSource", _LABEL, clause.source or None),
        ("Probability", _SHARE, point.probability),
        ("MeasuredDiameter", _POSITIVE, point.diameter_mm or None),
        ("AxisTilt", _ANGLE, point.axis_tilt_deg),
        *((f"AsBuilt{axis}", _LENGTH, value) for axis, value in zip("XYZ", built, strict=True)),
        ("ExposedLength", _LENGTH, point.exposed_length_mm),
        *_pair(column, point.label),
        ("Reason", _TEXT, point.reason or None),
    ]
    return list(_told(told))


def tolerance_properties(report: JobReport, kind: Kind, point: PointResult) -> list[Property]:
    """Pset_Tolerance of IFC4X3: ranges are diameters, so a radial limit of 2 mm is 4 mm."""
    limit_mm = point.limit_mm
    if limit_mm is None:
        return []
    clause = clause_of(report, f"{kind}_position", limit_mm)
    said = f"Centre in the plane of the foot, radial limit {limit_mm:g} mm. {clause.text}".strip()
    return [
        Property("ToleranceDescription", _TEXT, said),
        Property("ToleranceBasis", ENUMERATED, "ASSEMBLY"),
        Property("HorizontalTolerance", _POSITIVE, 2.0 * limit_mm),
        Property("OrthogonalTolerance", _POSITIVE, 2.0 * limit_mm),
    ]


def uncertainty_properties(point: PointResult) -> list[Property]:
    """Pset_Uncertainty of IFC4X3: diameters that hold about 95 %, four standard uncertainties wide."""
    if not point.u_mm:
        return []
    said = f"Measured centre in the plane of the foot; standard uncertainty per axis {point.u_mm:g} mm (k = 1)."
    return [
        Property("UncertaintyDescription", _TEXT, said),
        Property("UncertaintyBasis", ENUMERATED, "MEASUREMENT"),
        Property("HorizontalUncertainty", _POSITIVE, _DIAMETER_PER_U * point.u_mm),
        Property("OrthogonalUncertainty", _POSITIVE, _DIAMETER_PER_U * point.u_mm),
    ]


def write_back_properties(report: JobReport) -> list[Property]:
    """What the project is told about the program and the check."""
    return list(_told(_audit(report)))


_Told = Iterable[tuple[str, str, Scalar | None]]


def _told(properties: _Told) -> Iterator[Property]:
    return (Property(name, measure, value) for name, measure, value in properties if value is not None)


def _verdicts(column: ColumnReport) -> _Told:
    yield "Verdict", _LABEL, column.verdict
    yield "GoesOn", _LABEL, column.goes_on
    yield "Reasons", _TEXT, "; ".join(column.reasons) or None
    repair = column.repair
    yield "Advice", _TEXT, repair.advice if repair else None


def _largest(column: ColumnReport) -> _Told:
    for kind, group in column.groups.items():
        name = kind.capitalize()
        yield f"{name}Verdict", _LABEL, group.verdict
        yield f"{name}sExpected", "IfcInteger", group.expected
        yield f"{name}sFound", "IfcInteger", group.found
        yield f"Largest{name}Deviation", _LENGTH, _extreme(group.points)
        yield f"Largest{name}SpacingDeviation", _LENGTH, _extreme(group.spacing)
        yield f"{name}Scan", _TEXT, group.source or None
        yield f"{name}ScanSha256", _LABEL, group.sha256 or None


def _extreme(entries: Iterable[PointResult | SpacingResult]) -> float | None:
    """The deviation furthest from zero, with its sign."""
    measured = [entry.deviation_mm for entry in entries if entry.deviation_mm is not None]
    return max(measured, key=abs, default=None)


def _trial(column: ColumnReport) -> _Told:
    trial = column.trial_assembly
    if not trial:
        return
    yield "TrialVerdict", _LABEL, trial.verdict
    for name, pose in (("LeastSquares", trial.least_squares), ("Minimax", trial.minimax)):
        yield f"{name}Distance", _LENGTH, pose.max_mm if pose else None
    yield "DistanceLimit", _POSITIVE, min((pair.limit_mm for pair in column.pairs if pair.limit_mm), default=None)
    known = [pair.clearance_mm for pair in column.pairs if pair.clearance_mm is not None]
    yield "SmallestClearance", _LENGTH, min(known, default=None)
    yield "Collisions", "IfcInteger", len(trial.collisions)
    yield "CollidingSleeves", _TEXT, ", ".join(trial.collisions) or None
    yield "TrialProbability", _SHARE, trial.probability
    yield "Margin", _RATIO, trial.margin


def _hoisting(column: ColumnReport) -> _Told:
    """The last frame that was measured, or what all of them tell together."""
    frames = [(frame, frame.correction) for frame in column.hoisting_frames if frame.correction is not None]
    for last, move in frames[-1:]:
        yield "HoistingVerdict", _LABEL, last.verdict
        yield "HoistingDistance", _LENGTH, last.max_mm
        yield "CorrectionX", _LENGTH, move.dx_mm
        yield "CorrectionY", _LENGTH, move.dy_mm
        yield "CorrectionTurn", _ANGLE, move.yaw_deg
        yield "ColumnTilt", _ANGLE, last.column_tilt_deg


def _audit(report: JobReport) -> _Told:
    yield "Profile", _LABEL, report.profile.name
    yield "Method", _LABEL, report.job.get("method")
    yield "Decision", _LABEL, report.job.get("decision")
    yield "CaptureDate", _LABEL, report.capture.get("date") or None
    yield "Operator", _TEXT, report.capture.get("operator") or None
    yield "CameraProfile", _TEXT, report.capture.get("camera_profile") or None
    yield "Job", _TEXT, report.job["name"]
    yield "JobSha256", _LABEL, report.job["sha256"]
    yield "Tool", _LABEL, f"{report.tool['name']} {report.tool['version']}"


def _pair(column: ColumnReport, name: str) -> _Told:
    """What the trial assembly says about a sleeve or a bar."""
    pair = next((pair for pair in column.pairs if name in (pair.sleeve, pair.rebar)), None)
    if pair is None or column.trial_assembly is None:
        return
    least = column.trial_assembly.least_squares
    squares = next((one for one in (least.pairs if least else ()) if name in (one.sleeve, one.rebar)), None)
    yield "PairedWith", _LABEL, pair.rebar if name == pair.sleeve else pair.sleeve
    yield "PairVerdict", _LABEL, pair.verdict
    yield "PairOffsetX", _LENGTH, pair.offset_mm[0]
    yield "PairOffsetY", _LENGTH, pair.offset_mm[1]
    yield "PairDistance", _LENGTH, pair.distance_mm
    yield "PairDistanceLeastSquares", _LENGTH, squares.distance_mm if squares else None
    yield "PairUncertainty", _LENGTH, pair.u_mm
    yield "PairLimit", _POSITIVE, pair.limit_mm
    yield "PairClearance", _LENGTH, pair.clearance_mm
