"""The nouns of the product: what passes from one stage to the next.

Units inside are millimetres, radians and float64. A transform is named by what it maps,
``T_to_from @ point_from = point_to``, a (4, 4) matrix for column vectors.

Frames: *scan frame* (x right, y down, z forward from the camera, or the frame of the file),
*column frame* (origin on the foot face at the centroid of the design sleeve centres, z up along
the column) and *model frame* (of the IFC or FreeCAD model).
"""

from __future__ import annotations

from aadm_workbench.model.absolute import (
    AbsolutePoint,
    AbsolutePosition,
    ControlPoint,
    ControlResidual,
)
from aadm_workbench.model.camera import (
    Camera,
    CameraProfile,
    LearnedEdges,
    Measure,
)
from aadm_workbench.model.drift import (
    Capability,
    MouldDrift,
    SleeveDrift,
)
from aadm_workbench.model.findings import (
    Finding,
)
from aadm_workbench.model.hoisting import (
    Bend,
    CameraMove,
    Correction,
    HoistingMeasurement,
    HoistingPair,
    HoistingReport,
    MovedSince,
    Repair,
)
from aadm_workbench.model.measured import (
    AXES_UNKNOWN,
    CAMERA_AXES,
    OPENGL_AXES,
    UP_DEG,
    Array,
    AssemblyPoint,
    BoolArray,
    ColumnDesign,
    Extraction,
    Figure,
    Figures,
    FloatArray,
    IntArray,
    Json,
    Plane,
    Scan,
    Vector2,
    Vector3,
)
from aadm_workbench.model.reason import (
    Reason,
    codes_of,
    in_one,
)
from aadm_workbench.model.repairs import (
    RepairAction,
    RepairReport,
    RepairStep,
)
from aadm_workbench.model.reports import (
    ColumnReport,
    GridAxis,
    JobReport,
)
from aadm_workbench.model.results import (
    AimedPose,
    BestPair,
    BestPose,
    Candidate,
    Fit,
    GroupReport,
    Orientation,
    PairResult,
    PointResult,
    PoseWindow,
    RuleResult,
    SpacingResult,
    TrialPose,
    TrialReport,
    TurnResult,
)
from aadm_workbench.model.rules import (
    Deviation,
    Profile,
    Rule,
)
from aadm_workbench.model.stack import (
    SettingReport,
    StackSettings,
)
from aadm_workbench.model.verdicts import (
    SUMMED,
    WORST_FIRST,
    Kind,
    Verdict,
    worst,
)

__all__ = [
    "AXES_UNKNOWN",
    "CAMERA_AXES",
    "OPENGL_AXES",
    "SUMMED",
    "UP_DEG",
    "WORST_FIRST",
    "AbsolutePoint",
    "AbsolutePosition",
    "AimedPose",
    "Array",
    "AssemblyPoint",
    "Bend",
    "BestPair",
    "BestPose",
    "BoolArray",
    "Camera",
    "CameraMove",
    "CameraProfile",
    "Candidate",
    "Capability",
    "ColumnDesign",
    "ColumnReport",
    "ControlPoint",
    "ControlResidual",
    "Correction",
    "Deviation",
    "Extraction",
    "Figure",
    "Figures",
    "Finding",
    "Fit",
    "FloatArray",
    "GridAxis",
    "GroupReport",
    "HoistingMeasurement",
    "HoistingPair",
    "HoistingReport",
    "IntArray",
    "JobReport",
    "Json",
    "Kind",
    "LearnedEdges",
    "Measure",
    "MouldDrift",
    "MovedSince",
    "Orientation",
    "PairResult",
    "Plane",
    "PointResult",
    "PoseWindow",
    "Profile",
    "Reason",
    "Repair",
    "RepairAction",
    "RepairReport",
    "RepairStep",
    "Rule",
    "RuleResult",
    "Scan",
    "SettingReport",
    "SleeveDrift",
    "SpacingResult",
    "StackSettings",
    "TrialPose",
    "TrialReport",
    "TurnResult",
    "Vector2",
    "Vector3",
    "Verdict",
    "codes_of",
    "in_one",
    "worst",
]
