"""How long it takes to find sleeves and connecting rebars in the IFC model of a whole floor.

    python benchmarks/design.py [--columns 200] [--others 20000] [--keep floor.ifc]

A floor is written with so many columns, twelve grouting sleeves and twelve connecting rebars each, and so many elements
that are neither: walls with openings, beams, pipes, the cages of the columns, brackets and fittings of facets, all with
property sets. It is then read as ``aadm design`` reads it. Parsing is what ifcopenshell needs to open the file; reading
is all that comes after it. Every centre is compared with what the floor was written from.
"""

from __future__ import annotations

import argparse
import math
import platform
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.design.model_design import ModelDesign

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "samples"))
from ifc_author import Model, Point

RING_MM = [
    (x, y) for x in (-240.0, -80.0, 80.0, 240.0) for y in (-240.0, -80.0, 80.0, 240.0) if max(abs(x), abs(y)) == 240.0
]
BAY_MM, ROW = 6000.0, 20
FACETS = 24


@dataclass(frozen=True)
class Timing:
    """Seconds to parse the file and to read it afterwards; ``worst_mm`` is the largest error of a centre."""

    columns: int
    points: int
    parse: float
    read: float
    worst_mm: float


def write_floor(path: Path, columns: int, others: int) -> None:
    """Write the floor; GlobalIds and order follow from the numbers alone."""
    floor = _Floor(Model(path.name, "Floor"), columns)
    for number in range(columns):
        floor.column(number)
    kinds = floor.others()
    for number in range(others):
        kinds[number % len(kinds)](number)
    floor.finish()
    floor.model.file.write(str(path))


def feet(columns: int) -> Iterator[tuple[Point, float]]:
    """Where the foot of each column stands, mm, and by how much it is turned, degrees."""
    for number in range(columns):
        yield (BAY_MM * (number % ROW), BAY_MM * (number // ROW), 7200.0), 90.0 * (number % 4)


def measure(path: Path, columns: int) -> Timing:
    """Read the floor, and compare every centre with what it was written from."""
    read = read_ifc(path)
    points = sum(len(column.sleeves) + len(column.rebars) for column in read.columns)
    return Timing(len(read.columns), points, read.parse_seconds, read.seconds, worst_error_mm(read, columns))


def worst_error_mm(read: ModelDesign, columns: int) -> float:
    """Largest distance of a sleeve's or a bar's centre from the nearest place where one was drawn."""
    worst_mm = 0.0
    for column, (foot, _) in zip(read.columns, feet(columns), strict=True):
        T = column.T_model_column
        assert T is not None
        for points, height_mm in ((column.sleeves, 0.0), (column.rebars, 160.0)):
            found = np.array([T[:3, :3] @ point.centre + T[:3, 3] for point in points]) - foot
            truth = np.column_stack([RING_MM, np.full(len(RING_MM), height_mm)])
            apart_mm = np.linalg.norm(found[:, np.newaxis] - truth, axis=2)
            worst_mm = max(worst_mm, float(apart_mm.min(axis=0).max()))
    return worst_mm


class _Floor:
    """A floor under construction."""

    def __init__(self, model: Model, columns: int) -> None:
        self.model = model
        self.feet = list(feet(columns))
        self.typed: dict[str, list[Any]] = {}
        self.elements: list[Any] = []
        self.origin = model.placement(None, (0.0, 0.0, 0.0))
        hollow = model.new("IfcCircleHollowProfileDef", ProfileType="AREA", Radius=24.0, WallThickness=6.0)
        square = model.new("IfcRectangleProfileDef", ProfileType="AREA", XDim=600.0, YDim=600.0)
        tie = [(-270.0, -270.0, 0.0), (270.0, -270.0, 0.0), (270.0, 270.0, 0.0), (-270.0, 270.0, 0.0)]
        self.types = {
            "column": self._type("IfcColumnType", "PCZ-1", model.extrusion(square, 3000.0)),
            "sleeve": self._type("IfcDiscreteAccessoryType", "灌浆套筒 GTQ4Z-20", model.extrusion(hollow, 310.0)),
            "rebar": self._type("IfcReinforcingBarType", "连接钢筋", model.bar([(0, 0, -560.0), (0, 0, 0)], 20.0)),
            "cage": self._type("IfcReinforcingBarType", "纵筋", model.bar([(0, 0, 310.0), (0, 0, 2960.0)], 20.0)),
            "tie": self._type("IfcReinforcingBarType", "箍筋", model.bar([*tie, tie[0]], 8.0)),
            "bracket": self._type("IfcDiscreteAccessoryType", "Bracket", self._facets(40.0, 30.0)),
        }
        self.typed = {name: [] for name in self.types}

    def _type(self, ifc_class: str, name: str, item: Any) -> Any:
        kind = "NOTDEFINED" if ifc_class != "IfcDiscreteAccessoryType" else "USERDEFINED"
        return self.model.type(ifc_class, f"{name} type", "SolidModel", [item], Name=name, PredefinedType=kind)

    def column(self, number: int) -> None:
        """A column with its sleeves and the bars under it."""
        foot, turn_deg = self.feet[number]
        at = self.model.placement(self.origin, foot, turn_deg)
        self._occurrence("column", "IfcColumn", number, at, Name="Precast column", Tag=f"C-{number + 1}")
        for index, (x, y) in enumerate(RING_MM):
            key = number * len(RING_MM) + index
            self._occurrence("sleeve", "IfcDiscreteAccessory", key, self.model.placement(at, (x, y, 0.0)))
            self._occurrence("rebar", "IfcReinforcingBar", key, self.model.placement(at, (x, y, 160.0)))

    def others(self) -> list[Callable[[int], None]]:
        """What else a floor is made of, in equal numbers."""
        return [self._wall, self._pipe, self._cage, self._tie, self._fitting, self._bracket, self._opening, self._beam]

    def finish(self) -> None:
        """Types and property sets, in a few relations as exporters write them."""
        for name, occurrences in self.typed.items():
            self.model.rooted(
                "IfcRelDefinesByType", f"of {name}", RelatedObjects=occurrences, RelatingType=self.types[name]
            )
        for begin in range(0, len(self.elements), 50):
            group = self.elements[begin : begin + 50]
            self.model.properties(
                f"properties {begin}", "Pset_Phase", group, Phase="3F", Level="主体结构", Status="new"
            )

    def _occurrence(self, name: str, ifc_class: str, number: int, at: Any, **attributes: Any) -> None:
        said = {"Name": self.types[name].Name} | attributes
        element = self.model.occurrence(ifc_class, f"{name} {number}", self.types[name], at, **said)
        self.typed[name].append(element)
        self.elements.append(element)

    def _element(self, ifc_class: str, number: int, item: Any, at: Any, **attributes: Any) -> Any:
        shape = self.model.new("IfcProductDefinitionShape", Representations=[self.model.drawn("SolidModel", [item])])
        element = self.model.rooted(
            ifc_class, f"{ifc_class} {number}", ObjectPlacement=at, Representation=shape, **attributes
        )
        self.elements.append(element)
        return element

    def _somewhere(self, number: int, height: float) -> Any:
        x, y = 700.0 + 37.0 * (number % 3000), 900.0 + 211.0 * (number % 257)
        return self.model.placement(self.origin, (x, y, height), float(number % 360))

    def _box(self, x_mm: float, y_mm: float, depth_mm: float) -> Any:
        profile = self.model.new("IfcRectangleProfileDef", ProfileType="AREA", XDim=x_mm, YDim=y_mm)
        return self.model.extrusion(profile, depth_mm)

    def _wall(self, number: int) -> None:
        self._element("IfcWall", number, self._box(3000.0, 200.0, 3000.0), self._somewhere(number, 7200.0), Name="Wall")

    def _beam(self, number: int) -> None:
        self._element("IfcBeam", number, self._box(300.0, 600.0, 5000.0), self._somewhere(number, 10200.0), Name="梁")

    def _opening(self, number: int) -> None:
        profile = self.model.new("IfcCircleProfileDef", ProfileType="AREA", Radius=50.0 + number % 7)
        item = self.model.extrusion(profile, 400.0)
        self._element("IfcOpeningElement", number, item, self._somewhere(number, 8000.0), Name="Opening")

    def _pipe(self, number: int) -> None:
        profile = self.model.new("IfcCircleHollowProfileDef", ProfileType="AREA", Radius=30.0, WallThickness=3.0)
        item = self.model.extrusion(profile, 2000.0)
        self._element("IfcFlowSegment", number, item, self._somewhere(number, 9500.0), Name="Pipe DN50")

    def _cage(self, number: int) -> None:
        (x, y, z), _ = self.feet[number % len(self.feet)]
        at = self.model.placement(self.origin, (x + 20.0 * (number % 11), y + 30.0, z))
        self._occurrence("cage", "IfcReinforcingBar", number, at)

    def _tie(self, number: int) -> None:
        (x, y, z), _ = self.feet[number % len(self.feet)]
        at = self.model.placement(self.origin, (x, y, z + 100.0 + number % 2500))
        self._occurrence("tie", "IfcReinforcingBar", number, at)

    def _bracket(self, number: int) -> None:
        self._occurrence("bracket", "IfcDiscreteAccessory", number, self._somewhere(number, 9000.0))

    def _fitting(self, number: int) -> None:
        """A body of facets of its own, as exporters write what they have no better word for."""
        item = self._facets(60.0 + number % 5, 90.0)
        self._element("IfcBuildingElementProxy", number, item, self._somewhere(number, 9000.0), Name="族 Fitting")

    def _facets(self, radius_mm: float, height_mm: float) -> Any:
        """A faceted cylinder."""
        turn = [2.0 * math.pi * k / FACETS for k in range(FACETS)]
        rings = [
            [self.model.point(radius_mm * math.cos(a), radius_mm * math.sin(a), z) for a in turn]
            for z in (0.0, height_mm)
        ]
        loops = [rings[0][::-1], rings[1]]
        loops += [[rings[0][k - 1], rings[0][k], rings[1][k], rings[1][k - 1]] for k in range(FACETS)]
        faces = [self._face(loop) for loop in loops]
        return self.model.new("IfcFacetedBrep", Outer=self.model.new("IfcClosedShell", CfsFaces=faces))

    def _face(self, loop: list[Any]) -> Any:
        around = self.model.new("IfcPolyLoop", Polygon=loop)
        return self.model.new("IfcFace", Bounds=[self.model.new("IfcFaceOuterBound", Bound=around, Orientation=True)])


def main() -> None:
    """Print the machine, the model and the times."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--columns", type=int, default=200)
    parser.add_argument("--others", type=int, default=20_000)
    parser.add_argument("--keep", type=Path, metavar="FILE", help="write the floor to this file, and keep it")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path = options.keep or Path(folder) / "floor.ifc"
        write_floor(path, options.columns, options.others)
        size_mb = path.stat().st_size / 1e6
        timing = measure(path, options.columns)
    print(f"{platform.machine()}, Python {platform.python_version()}, {platform.system()}")
    print(f"{timing.columns} columns, {timing.points} points, {options.others} other elements, {size_mb:.1f} MB")
    print(f"parse {timing.parse:.2f} s, read {timing.read:.2f} s, largest error of a centre {timing.worst_mm:.6f} mm")


if __name__ == "__main__":
    main()
