"""Yards at random: columns with sleeves and bars whose truth is known, in the manners of many programs at once."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.model import Array
from tests.design import dialects
from tests.design.authoring import Author
from tests.design.frames import axes, mapped, motion, on, placement, shift

SLEEVE_NAMES = (
    ("IfcDiscreteAccessory", "灌浆套筒 GTQ4Z-20"),
    ("IfcDiscreteAccessory", "全灌浆套筒_{}"),
    ("IfcBuildingElementProxy", "半灌浆套筒:{}"),
    ("IfcBuildingElementProxy", "GROUTING_SLEEVE_{}"),
    ("IfcMechanicalFastener", "Grouted splice sleeve NMB 8U-X"),
    ("IfcMechanicalFastener", "Rebar Coupler:Sleeve20: {}"),
    ("IfcBuildingElementProxy", "スリーブ D25用 {}"),
    ("IfcDiscreteAccessory", "モルタル充填式継手"),
    ("IfcBeam", "灌漿套筒"),
    ("IfcFlowSegment", "金属波纹管 {}"),
)
BAR_NAMES = (
    *(" ", "连接钢筋 HRB400", "插筋{}", "Starter bar {}", "差し筋 D25"),
    *("Rebar Bar:25M : Shape 00:{}", "主筋", "REBAR"),
)
COLUMN_NAMES = ("预制柱 PCZ-{}", "PC柱{}", "Precast column {}", "プレキャスト柱 C{}", "KZ{}", "Column")
OTHERS = (
    ("IfcDiscreteAccessory", "吊装套筒 M24"),
    ("IfcDiscreteAccessory", "斜撑套筒"),
    ("IfcBuildingElementProxy", "Lifting socket RD30"),
    ("IfcBuildingElementProxy", "防水套管 DN100"),
    ("IfcBuildingElementProxy", "インサート M16"),
)


@dataclass
class Truth:
    """A column as it was drawn, mm, model frame."""

    name: str
    sleeves: Array
    tops: Array
    x: Array
    z: Array
    bore: float
    diameter: float
    size: tuple[float, float]


@dataclass
class Yard:
    """A model under construction; ``T_model_yard`` is where everything stands, in placements and coordinates."""

    model: Author
    rng: np.random.Generator
    T_model_yard: Array
    site: Any
    truths: list[Truth] = field(default_factory=list)

    def pick(self, options: Sequence[Any]) -> Any:
        return options[int(self.rng.integers(len(options)))]

    def element(self, ifc_class: str, draw: Callable[[Array], list[Any]], T: Array, **said: Any) -> Any:
        """An element at ``T`` in the yard, by placement, through mapped items, baked in, or some of each."""
        share = [motion(self.rng, 900.0) if self.rng.random() < 0.5 else np.eye(4) for _ in range(3)]
        placed, outer, inner = share
        baked = np.linalg.inv(placed @ outer @ inner) @ T
        items = draw(baked)
        for through in (inner, outer):
            if self.rng.random() < 0.5 or not np.array_equal(through, np.eye(4)):
                items = [mapped(self.model, items, through)]
        made = self.model.element(ifc_class, items, placement(self.model, self.site, placed), **said)
        if self.rng.random() < 0.3:
            self._draw_in_plan(made)
        return made

    def _draw_in_plan(self, element: Any) -> None:
        """A footprint before the body, in a context of its own whose origin is elsewhere."""
        model = self.model
        plan = model.new("IfcGeometricRepresentationContext", None, "Plan", 2, 1e-5, model.axes((9e5, 0.0, 0.0)))
        outline = model.polygon([(0.0, 0.0), (50.0, 0.0), (50.0, 50.0)])
        curves = model.new("IfcGeometricCurveSet", [outline])
        shape = model.new("IfcShapeRepresentation", plan, "FootPrint", "GeometricCurveSet", [curves])
        drawn = element.Representation
        drawn.Representations = [shape, *drawn.Representations]

    def column(self, number: int) -> None:
        """A column with its sleeves and the bars under it."""
        rng = self.rng
        T = motion(rng, 200.0, upright=True)
        T[:3, 3] = (12_000.0 * number, rng.uniform(-500.0, 500.0), 3600.0 + rng.uniform(-50.0, 50.0))
        pattern, size = self._pattern()
        bar = float(self.pick((16.0, 20.0, 25.0, 32.0)))
        bore, length = round(bar * rng.uniform(1.4, 1.9), 1), 8.0 * bar + rng.uniform(60.0, 250.0)
        top = rng.uniform(0.5, 0.9) * length
        name = f"{self.pick(COLUMN_NAMES)}".format(number)
        manner = self.pick(("element", "element", "opening", "voiding", "profile", "body", "boolean"))
        if self.model.schema == "IFC2X3" and manner == "voiding":
            manner = "opening"
        if manner == "element":
            column = self._solid_column(T, size, name, number)
            sleeves = self._sleeves(T, pattern, bore, length)
            if rng.random() < 0.5:
                whole = self.model.rooted("IfcElementAssembly", Name=f"Unit {number}", Tag=f"U-{number}")
                self.model.aggregate(whole, [column, *sleeves])
        elif manner in ("opening", "voiding"):
            column = self._solid_column(T, size, name, number)
            ifc_class = "IfcOpeningElement" if manner == "opening" else "IfcVoidingFeature"
            self._openings(T, pattern, bore, length, column, ifc_class)
        else:
            self._pierced_column(T, size, name, number, pattern, bore, length, manner)
        self._bars(T, pattern, bar, top)
        self._others(T, size)
        T_model = self.T_model_yard @ T
        self.truths.append(
            Truth(
                name=f"T-{number}",
                sleeves=on(T_model, [(x, y, 0.0) for x, y in pattern]),
                tops=on(T_model, [(x, y, top) for x, y in pattern]),
                x=T_model[:3, 0],
                z=T_model[:3, 2],
                bore=bore,
                diameter=bar,
                size=size,
            )
        )

    def _pattern(self) -> tuple[list[tuple[float, float]], tuple[float, float]]:
        """A ring of a grid, not in the middle of its column."""
        nx, ny = (int(self.rng.integers(2, 5)) for _ in range(2))
        dx, dy = (float(self.rng.uniform(110.0, 200.0)) for _ in range(2))
        off = self.rng.uniform(-15.0, 15.0, 2)
        grid = [(i, j) for i in range(nx) for j in range(ny) if i in (0, nx - 1) or j in (0, ny - 1)]
        places = [((i - (nx - 1) / 2) * dx + off[0], (j - (ny - 1) / 2) * dy + off[1]) for i, j in grid]
        return places, ((nx - 1) * dx + 160.0, (ny - 1) * dy + 160.0)

    def _solid_column(self, T: Array, size: tuple[float, float], name: str, number: int) -> Any:
        profile = self.model.profile("IfcRectangleProfileDef", XDim=size[0], YDim=size[1])
        downwards = self.rng.random() < 0.5
        flip = shift(z=3000.0) @ np.diag([1.0, -1.0, -1.0, 1.0]) if downwards else shift()

        def draw(baked: Array) -> list[Any]:
            return [self.model.extrusion(profile, 3000.0, axes(self.model, baked @ flip))]

        return self._upright(draw, T, name, number)

    def _upright(self, draw: Callable[[Array], list[Any]], T: Array, name: str, number: int) -> Any:
        """A column element: its placement gives the column frame its x, so that stays as it is."""
        through = motion(self.rng, 900.0) if self.rng.random() < 0.5 else np.eye(4)
        items = draw(np.linalg.inv(through))
        items = [mapped(self.model, items, through)]
        at = placement(self.model, self.site, T)
        return self.model.element("IfcColumn", items, at, Name=name, Tag=f"T-{number}")

    def _sleeves(self, T: Array, pattern: Sequence[tuple[float, float]], bore: float, length: float) -> list[Any]:
        known = dict(dialects.SLEEVES)
        if self.model.schema != "IFC2X3":
            known |= dialects.SLEEVES_SINCE_IFC4
        draw = known[self.pick(sorted(known))]
        ifc_class, name = self.pick(SLEEVE_NAMES)

        def items(at: Array) -> Callable[[Array], list[Any]]:
            return lambda baked: [draw(self.model, baked @ at, bore, bore + 12.0, length)]

        if self.rng.random() < 0.2:
            drawn = lambda baked: [draw(self.model, baked @ shift(x, y), bore, bore + 12.0, length) for x, y in pattern]  # noqa: E731
            return [self.element(ifc_class, drawn, T, Name=name.format(0))]
        return [
            self.element(ifc_class, items(shift(x, y)), T, Name=name.format(7 * k + 1))
            for k, (x, y) in enumerate(pattern)
        ]

    def _openings(
        self, T: Array, pattern: Sequence[tuple[float, float]], bore: float, length: float, column: Any, ifc_class: str
    ) -> None:
        below, related, twice = self.rng.uniform(0.0, 30.0), self.rng.random() < 0.7, self.rng.random() < 0.3
        for x, y in pattern:
            for depth in (length, 0.6 * length) if twice else (length,):

                def draw(baked: Array, x: float = x, y: float = y, depth: float = depth) -> list[Any]:
                    at = axes(self.model, baked @ shift(x, y, -below))
                    return [self.model.cylinder(bore / 2.0, depth + below, at)]

                opening = self.element(ifc_class, draw, T, Name=self.pick(("", "Opening", "洞口")))
                if related:
                    self.model.void(column, opening)

    def _pierced_column(
        self,
        T: Array,
        size: tuple[float, float],
        name: str,
        number: int,
        pattern: Sequence[tuple[float, float]],
        bore: float,
        length: float,
        manner: str,
    ) -> None:
        """A column whose own body has the holes."""
        model = self.model
        half = np.array(size) / 2.0
        square = [(-half[0], -half[1]), (half[0], -half[1]), (half[0], half[1]), (-half[0], half[1])]

        def profile(baked: Array) -> list[Any]:
            at = [model.new("IfcAxis2Placement2D", model.point(place), None) for place in pattern]
            holes = [model.new("IfcCircle", place, model.length(bore / 2.0)) for place in at]
            outline = model.polygon(square)
            pierced = model.new("IfcArbitraryProfileDefWithVoids", "AREA", None, outline, holes)
            whole = model.new("IfcArbitraryClosedProfileDef", "AREA", None, outline)
            foot = model.extrusion(pierced, length, axes(model, baked))
            return [foot, model.extrusion(whole, 3000.0 - length, axes(model, baked @ shift(z=length)))]

        def boolean(baked: Array) -> list[Any]:
            rectangle = model.profile("IfcRectangleProfileDef", XDim=size[0], YDim=size[1])
            body = model.extrusion(rectangle, 3000.0, axes(model, baked))
            for x, y in pattern:
                tool = model.cylinder(bore / 2.0, length + 10.0, axes(model, baked @ shift(x, y, -10.0)))
                body = model.new("IfcBooleanResult", "DIFFERENCE", body, tool)
            return [body]

        def body(baked: Array) -> list[Any]:
            return [dialects.pierced_box(model, baked, square, pattern, bore, length)]

        self._upright({"profile": profile, "boolean": boolean, "body": body}[manner], T, name, number)

    def _bars(self, T: Array, pattern: Sequence[tuple[float, float]], diameter: float, top: float) -> None:
        """Upright bars from 500 mm below the foot, in one element or several."""
        known = {**dialects.STRAIGHT, **dialects.BENT}
        if self.model.schema != "IFC2X3":
            known |= dialects.BENT_SINCE_IFC4
        draw = known[self.pick(sorted(known))]
        name, schema = self.pick(BAR_NAMES), self.model.schema
        said = {"NominalDiameter": self.model.length(diameter), "CrossSectionArea": math.pi * (diameter / 2000.0) ** 2}
        said |= {"BarRole": "MAIN"} if schema == "IFC2X3" else {}
        rows = self.pick(([[place] for place in pattern], [pattern], [pattern[::2], pattern[1::2]]))
        for k, row in enumerate(rows):

            def items(baked: Array, row: Sequence[tuple[float, float]] = row) -> list[Any]:
                bars = [draw(self.model, baked @ shift(x, y, -500.0), diameter, 500.0 + top) for x, y in row]
                return [item for bar in bars for item in bar]

            self.element("IfcReinforcingBar", items, T, Name=name.format(k), **said)

    def _others(self, T: Array, size: tuple[float, float]) -> None:
        """What must not be taken: stirrups, the column's own bars, sockets in its head and its sides."""
        x, y = size[0] / 2.0 - 35.0, size[1] / 2.0 - 35.0
        corners = [(-x, -y), (x, -y), (x, y), (-x, y), (-x, -y)]
        tie = lambda baked: [self.model.disk(on(baked, [(*c, 150.0) for c in corners]).tolist(), 8.0)]  # noqa: E731
        self.element("IfcReinforcingBar", tie, T, Name=self.pick(("箍筋", "Stirrup", "フープ", "M_T1")))
        own = lambda baked: dialects.swept_polyline(self.model, baked @ shift(x, y, 700.0), 20.0, 2200.0)  # noqa: E731
        self.element("IfcReinforcingBar", own, T, Name=self.pick(("纵筋", "", "Longitudinal")))
        ifc_class, name = self.pick(OTHERS)
        socket = lambda baked: [dialects.hollow_extrusion(self.model, baked, 24.0, 36.0, 140.0)]  # noqa: E731
        self.element(ifc_class, socket, T @ shift(z=2860.0), Name=name)


def random_yard(folder: Path, rng: np.random.Generator) -> Yard:
    """A yard of two columns, somewhere on earth."""
    schema = ("IFC2X3", "IFC4", "IFC4X3")[int(rng.integers(3))]
    unit = ("mm", "m", "foot", "inch")[int(rng.integers(4))]
    far = np.array([6_700_000_123.25, -4_100_000_789.5, 45_678.75]) * float(rng.integers(2))
    in_context = rng.random() < 0.5
    model = Author(folder, schema=schema, unit=unit, wcs=tuple(far) if in_context else (0.0, 0.0, 0.0))
    T_site = motion(rng, 10_000.0, upright=True)
    if not in_context:
        T_site[:3, 3] += far
    if schema != "IFC2X3" and rng.random() < 0.5:
        crs = model.new("IfcProjectedCRS", Name="EPSG:4547")
        context = model.project.RepresentationContexts[0]
        model.new("IfcMapConversion", context, crs, 5e5, 3.4e6, 12.5, 0.8, 0.6, 0.001)
    site = placement(model, None, T_site)
    world = shift(*far) if in_context else shift()
    yard = Yard(model, rng, world @ T_site, site)
    for number in (1, 2):
        yard.column(number)
    return yard
