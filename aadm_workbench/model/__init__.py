"""The nouns of the product: what passes from one stage to the next.

Units inside are millimetres, radians and float64. A transform is named by what it maps,
``T_to_from @ point_from = point_to``, a (4, 4) matrix for column vectors.

Frames: *scan frame* (x right, y down, z forward from the camera, or the frame of the file),
*column frame* (origin on the foot face at the centroid of the design sleeve centres, z up along
the column) and *model frame* (of the IFC or FreeCAD model).
"""

from __future__ import annotations

from aadm_workbench.model.arrays import (
    Array,
    BoolArray,
    FloatArray,
    IntArray,
    Vector2,
    Vector3,
)
from aadm_workbench.model.measured import (
    AssemblyPoint,
    Camera,
    ColumnDesign,
    Extraction,
    Plane,
    Scan,
)
from aadm_workbench.model.reports import (
    ColumnReport,
    Correction,
    HoistingPair,
    HoistingReport,
    JobReport,
)
from aadm_workbench.model.results import (
    Candidate,
    Fit,
    GroupReport,
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
from aadm_workbench.model.verdicts import (
    Kind,
    Verdict,
    worst,
)

__all__ = [
    "Array",
    "AssemblyPoint",
    "BoolArray",
    "Camera",
    "Candidate",
    "ColumnDesign",
    "ColumnReport",
    "Correction",
    "Deviation",
    "Extraction",
    "Fit",
    "FloatArray",
    "GroupReport",
    "HoistingPair",
    "HoistingReport",
    "IntArray",
    "JobReport",
    "Kind",
    "PairResult",
    "Plane",
    "PointResult",
    "PoseWindow",
    "Profile",
    "Rule",
    "RuleResult",
    "Scan",
    "SpacingResult",
    "TrialPose",
    "TrialReport",
    "TurnResult",
    "Vector2",
    "Vector3",
    "Verdict",
    "worst",
]
