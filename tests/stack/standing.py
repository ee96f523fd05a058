"""Columns that stand where a test puts them, checked without any scan: real fits, real trials, real control points."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any
from unittest import mock

import numpy as np
from scipy.spatial.transform import Rotation

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.inspection import measure
from aadm_workbench.inspection.check import check_column
from aadm_workbench.inspection.measure import CheckSettings, ColumnScans
from aadm_workbench.model import (
    Array,
    AssemblyPoint,
    ColumnReport,
    ControlPoint,
    Extraction,
    JobReport,
    Kind,
    Scan,
)
from aadm_workbench.report.json import encoded_report
from tests.report.checked_floor import CENTRES, DESIGN, DIAMETERS_MM, LOOKING_DOWN

PROFILE = load_profile("cn")
FROM_CAMERA = np.array([0.0, 0.0, 1300.0])
CORNERS = [(-900.0, -900.0, 0.0), (900.0, -900.0, 0.0), (900.0, 900.0, 0.0), (-900.0, 900.0, 0.0)]


@dataclass(frozen=True)
class Standing:
    """A column over its bars.

    ``place`` is where it stands in the model, mm, ``turned_deg`` how it is turned there; ``ground`` dx, dy mm and yaw
    degrees of its bars as a group, ``off`` of single points, mm, in the column frame (None: not seen). ``sleeves`` and
    ``bars`` (12, 2) are drawn errors of all. ``control_u_mm`` None: without control points. ``leans_deg`` (24, 2) are
    those of sleeves and bars, ``outer_mm`` the diameter of bars over their ribs.
    """

    name: str
    place: tuple[float, float, float] | None = (0.0, 0.0, 0.0)
    turned_deg: float = 0.0
    ground: tuple[float, float, float] = (0.0, 0.0, 0.0)
    off: Mapping[str, tuple[float, float] | None] = field(default_factory=dict)
    sleeves: Array = field(default_factory=lambda: np.zeros((12, 2)))
    bars: Array = field(default_factory=lambda: np.zeros((12, 2)))
    noise: Array = field(default_factory=lambda: np.zeros((28, 2)))
    u_mm: float = 0.05
    control_u_mm: float | None = 0.3
    kinds: tuple[Kind, ...] = (Kind.SLEEVE, Kind.REBAR)
    storey: str = "3F"
    leans_deg: Array = field(default_factory=lambda: np.zeros((24, 2)))
    outer_mm: float = 22.0

    @property
    def T_model_column(self) -> Array | None:
        if self.place is None:
            return None
        T = np.eye(4)
        T[:3, :3] = Rotation.from_euler("z", self.turned_deg, degrees=True).as_matrix()
        T[:3, 3] = self.place
        return T

    def true_bars(self) -> Array:
        """(12, 2) in the building, column frame."""
        dx, dy, yaw_deg = self.ground
        turn = Rotation.from_euler("z", yaw_deg, degrees=True).as_matrix()[:2, :2]
        return (CENTRES + self._off("R") + self.bars) @ turn.T + np.array([dx, dy])

    def true_sleeves(self) -> Array:
        """(12, 2) in the column."""
        return CENTRES + self._off("S") + self.sleeves

    def _off(self, letter: str) -> Array:
        return np.array([self.off.get(f"{letter}{number}") or (0.0, 0.0) for number in range(1, 13)])

    def report(self) -> ColumnReport:
        """What a check finds."""
        design = inline_design(self.name, DESIGN | {"rebar_outer_diameter": self.outer_mm})
        T = self.T_model_column
        design = replace(design, storey=self.storey, T_model_column=T, global_id=f"id-{self.name}"[:22])
        scans = {kind: (Scan(np.zeros((9, 3)), f"{self.name}-{kind.plural}.ply", "a" * 64),) for kind in self.kinds}
        up = {f"{kind.plural}_up_deg": 90.0 for kind in self.kinds}
        points = self._control_points() if Kind.REBAR in self.kinds else ()
        given = ColumnScans(scans.get(Kind.SLEEVE, ()), scans.get(Kind.REBAR, ()), **up, control_points=points)
        with mock.patch.object(measure, "extract_sizes", lambda scan, kind, *_, **__: self._found(kind)):
            return check_column(design, given, CheckSettings(PROFILE))

    def _control_points(self) -> tuple[ControlPoint, ...]:
        if self.control_u_mm is None:
            return ()
        found = []
        for number, (known, noise) in enumerate(zip(CORNERS, self.noise[24:], strict=True), start=1):
            scan = LOOKING_DOWN @ np.add(known, [*noise, 0.0]) + FROM_CAMERA
            found.append(ControlPoint(f"G{number}", known, tuple(scan), False, self.control_u_mm))
        return tuple(found)

    def _found(self, kind: Kind) -> Extraction:
        """Centres as measured, in a camera's frame: bars from above, the foot from below."""
        true = self.true_bars() if kind is Kind.REBAR else self.true_sleeves()
        noise = self.noise[12:24] if kind is Kind.REBAR else self.noise[:12]
        rotation = LOOKING_DOWN if kind is Kind.REBAR else LOOKING_DOWN @ np.diag([-1.0, 1.0, -1.0])
        points = []
        for number, xy in enumerate(true + noise, start=1):
            label = f"{kind.letter}{number}"
            if label in self.off and self.off[label] is None:
                continue
            place = rotation @ np.array([*xy, 0.0]) + FROM_CAMERA
            lean = np.tan(np.radians(self.leans_deg[number - 1 + 12 * (kind is Kind.REBAR)]))
            axis = rotation @ (np.array([*lean, 1.0]) / np.linalg.norm([*lean, 1.0]))
            points.append(AssemblyPoint("", kind, place, axis, DIAMETERS_MM[kind], self.u_mm**2 * np.eye(3)))
        up = rotation @ np.array([0.0, 0.0, 1.0])
        return Extraction(kind, "refined", tuple(points), None, up, "exact", quality={"point_pitch_mm": 0.5})


def report_of(*columns: Standing, name: str = "Floor 3") -> dict[str, Any]:
    """report.json of some columns, as it is read back."""
    report = JobReport(
        {"name": "aadm", "version": "0.0"},
        {"name": name, "sha256": "c" * 64},
        {},
        {"source": "floor3.ifc", "sha256": "d" * 64},
        PROFILE,
        tuple(column.report() for column in columns),
    )
    document: dict[str, Any] = json.loads(encoded_report(report))
    return document


def shifted(dx: float, dy: float, yaw_deg: float = 0.0) -> Array:
    """Offsets (12, 2) mm by which sleeves must be off for the trial to displace the column by that, against its bars.

    A column whose sleeves sit at −δ in it has to move by +δ for them to meet bars in their places.
    """
    turn = np.array(
        [
            [math.cos(math.radians(yaw_deg)), -math.sin(math.radians(yaw_deg))],
            [math.sin(math.radians(yaw_deg)), math.cos(math.radians(yaw_deg))],
        ]
    )
    return (CENTRES - np.array([dx, dy])) @ turn - CENTRES


def near(values: Sequence[float], expected: Sequence[float], within: float) -> bool:
    """Whether numbers agree one by one."""
    return bool(np.allclose(values, expected, rtol=0.0, atol=within))
