"""One column with eight sleeves and eight bars as plain STEP text, written without any IFC library.

The ring is 150 mm around the column's axis, bores have 40 mm, bars end 150 mm above the foot.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

RING = tuple((x, y) for x in (-150.0, 0.0, 150.0) for y in (-150.0, 0.0, 150.0) if (x, y) != (0.0, 0.0))
HEADER = "FILE_DESCRIPTION((''),'2;1');\nFILE_NAME('{name}','2026-01-01T00:00:00',(''),(''),'','','');\n"


def number(value: float) -> str:
    """A real as STEP writes it."""
    return f"{value:.6f}"


@dataclass
class Step:
    """Lines of a STEP file, numbered as they come."""

    lines: list[str] = field(default_factory=list)

    def add(self, text: str) -> str:
        """An entity; returns its reference."""
        self.lines.append(f"#{len(self.lines) + 1}={text};")
        return f"#{len(self.lines)}"

    def global_id(self) -> str:
        return f"'{len(self.lines):022d}'"

    def point(self, *values: float) -> str:
        return self.add(f"IFCCARTESIANPOINT(({','.join(map(number, values))}))")

    def direction(self, *values: float) -> str:
        return self.add(f"IFCDIRECTION(({','.join(map(number, values))}))")

    def axes(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> str:
        return self.add(f"IFCAXIS2PLACEMENT3D({self.point(x, y, z)},$,$)")

    def placement(self, parent: str = "$", x: float = 0.0, y: float = 0.0, z: float = 0.0) -> str:
        return self.add(f"IFCLOCALPLACEMENT({parent},{self.axes(x, y, z)})")

    def shape(self, item: str) -> str:
        drawn = self.add(f"IFCSHAPEREPRESENTATION(#1,'Body','SolidModel',({item}))")
        return self.add(f"IFCPRODUCTDEFINITIONSHAPE($,$,({drawn}))")

    def extruded(self, profile: str, depth: float) -> str:
        return self.add(
            f"IFCEXTRUDEDAREASOLID({profile},{self.axes()},{self.direction(0.0, 0.0, 1.0)},{number(depth)})"
        )

    def flat(self) -> str:
        return self.add(f"IFCAXIS2PLACEMENT2D({self.point(0.0, 0.0)},$)")

    def disk(self, points: Sequence[Sequence[float]], radius: float = 10.0) -> str:
        line = self.add(f"IFCPOLYLINE(({','.join(self.point(*point) for point in points)}))")
        return self.add(f"IFCSWEPTDISKSOLID({line},{number(radius)},$,$,$)")

    def tube(self) -> str:
        profile = self.add(f"IFCCIRCLEHOLLOWPROFILEDEF(.AREA.,$,{self.flat()},24.,4.)")
        return self.extruded(profile, 310.0)

    def bar(self, item: str, placement: str, name: str = "Starter bar") -> str:
        drawn = self.shape(item)
        return self.add(f"IFCREINFORCINGBAR({self.global_id()},$,'{name}',$,$,{placement},{drawn},$,$,20.,$,$,$,$)")


@dataclass(frozen=True)
class Yard:
    """What a yard is made of; texts stand in the file as they are given here."""

    schema: str = "IFC4"
    file_name: str = ""
    column_name: str = "Precast column"
    column_tag: str = "C-1"
    sleeve_name: str = "Grouting sleeve"
    bar_name: str = "Starter bar"
    sleeve_class: str = "IFCDISCRETEACCESSORY"
    head_down: bool = False
    sleeve: Callable[[Step], str] = Step.tube
    more: Callable[[Step, str], None] = lambda step, placement: None
    placed: Callable[[Step], str] = Step.placement


def yard(how: Yard | None = None) -> str:
    """The text of the model; whoever writes it chooses the encoding."""
    how = how or Yard()
    step = Step()
    step.lines += [
        "#1=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#3,$);",
        "#2=IFCCARTESIANPOINT((0.,0.,0.));",
        "#3=IFCAXIS2PLACEMENT3D(#2,$,$);",
        "#4=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);",
        "#5=IFCUNITASSIGNMENT((#4));",
        "#6=IFCPROJECT('0000000000000000000006',$,'P',$,$,$,$,(#1),#5);",
    ]
    at = how.placed(step)
    outline = step.add(f"IFCRECTANGLEPROFILEDEF(.AREA.,$,{step.flat()},400.,400.)")
    body = step.shape(step.extruded(outline, 3000.0))
    step.add(f"IFCCOLUMN({step.global_id()},$,'{how.column_name}',$,$,{at},{body},'{how.column_tag}',$)")
    for x, y in RING:
        placed = step.placement(at, x, y, 3000.0 - 310.0 if how.head_down else 0.0)
        drawn = step.shape(how.sleeve(step))
        kind = "$,.COUPLER." if how.sleeve_class == "IFCMECHANICALFASTENER" else "$"
        sizes = "$,$,.COUPLER." if how.sleeve_class == "IFCMECHANICALFASTENER" else kind
        step.add(f"{how.sleeve_class}({step.global_id()},$,'{how.sleeve_name}',$,$,{placed},{drawn},$,{sizes})")
        step.bar(step.disk([(x, y, -800.0), (x, y, 150.0)]), at, how.bar_name)
    how.more(step, at)
    header = (
        f"ISO-10303-21;\nHEADER;\n{HEADER.format(name=how.file_name)}FILE_SCHEMA(('{how.schema}'));\nENDSEC;\nDATA;\n"
    )
    return header + "\n".join(step.lines) + "\nENDSEC;\nEND-ISO-10303-21;\n"


def polyline(step: Step, *points: tuple[float, ...]) -> str:
    return step.add(f"IFCPOLYLINE(({','.join(step.point(*point) for point in points)}))")
