"""Write floor/floor3.ifc: eight precast columns of one floor, as a precast yard would export them.

Run ``python samples/make_model.py`` from anywhere, or with the name of another file to write. The same bytes come out
each time: GlobalIds follow from names, and the time stamp is fixed. Millimetres; IFC4; geometry mapped from types, as
large exporters write it.

What is in it
    Columns C-301 to C-308 on grid axes C and D, each an IfcElementAssembly (the cast unit) of an IfcColumn of
    600 x 600 x 3000 mm and twelve grouting sleeves in its foot, in a square ring of 160 mm spacing. Every second
    column is turned by 90 degrees; those on axis D stand 100 mm off it. All come from one mould: PieceMark PCZ-1.
    Under each, in the storey below, twelve connecting rebars whose tops are 160 mm over the floor. And what must not
    be taken for either: stirrups, the column's own bars, sockets for lifting and for bracing.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from ifc_author import Model, Point

STOREYS_MM = {"2F": 3600.0, "3F": 7200.0}
GRID_X_MM = {"1": 0.0, "2": 7800.0, "3": 15600.0, "4": 23400.0}
GRID_Y_MM = {"A": 0.0, "B": 6600.0, "C": 13200.0, "D": 19800.0}
OFF_AXIS_D_MM = -100.0

SIZE_MM, HEIGHT_MM = 600.0, 3000.0
RING_MM = [
    (x, y) for x in (-240.0, -80.0, 80.0, 240.0) for y in (-240.0, -80.0, 80.0, 240.0) if max(abs(x), abs(y)) == 240.0
]
SLEEVE_INNER_MM, SLEEVE_OUTER_MM, SLEEVE_LENGTH_MM = 36.0, 48.0, 310.0
REBAR_MM, REBAR_LENGTH_MM, REBAR_ABOVE_FLOOR_MM = 20.0, 560.0, 160.0
PIECE_MARK = "PCZ-1"


def columns() -> list[tuple[str, str, Point, float]]:
    """(tag, grid position, foot in the model mm, turn in degrees) of each column."""
    places = [(letter, number) for letter in ("C", "D") for number in GRID_X_MM]
    found = []
    for index, (letter, number) in enumerate(places):
        y = GRID_Y_MM[letter] + (OFF_AXIS_D_MM if letter == "D" else 0.0)
        turn_deg = 90.0 * (index % 2)
        found.append((f"C-{301 + index}", f"{letter}/{number}", (GRID_X_MM[number], y, STOREYS_MM["3F"]), turn_deg))
    return found


def build() -> Any:
    """The model, as an ifcopenshell file."""
    model = Model("floor3.ifc", "示范工程 Sample project")
    storeys = _structure(model)
    types = _types(model)
    occurrences: dict[str, list[Any]] = {name: [] for name in types}
    units = [_cast_unit(model, types, occurrences, storeys["3F"], *column) for column in columns()]
    model.contain("columns in 3F", storeys["3F"], [*units, _slab(model, storeys["3F"])])
    rebars = [bar for column in columns() for bar in _rebars(model, types, storeys["2F"], *column)]
    occurrences["rebar"] = rebars
    model.contain("rebars in 2F", storeys["2F"], rebars)
    for name, of_type in types.items():
        model.rooted("IfcRelDefinesByType", f"type of {name}", RelatedObjects=occurrences[name], RelatingType=of_type)
    model.properties(
        "piece mark", "Pset_PrecastConcreteElementFabrication", occurrences["column"], PieceMark=PIECE_MARK
    )
    return model.file


def _structure(model: Model) -> dict[str, Any]:
    origin = model.placement(None)
    site = model.rooted("IfcSite", "site", Name="场地 Site", ObjectPlacement=origin)
    building = model.rooted("IfcBuilding", "building", Name="1号楼 Building 1", ObjectPlacement=model.placement(origin))
    storeys = {
        name: model.rooted(
            "IfcBuildingStorey",
            f"storey {name}",
            Name=name,
            Elevation=elevation,
            ObjectPlacement=model.placement(building.ObjectPlacement, (0.0, 0.0, elevation)),
        )
        for name, elevation in STOREYS_MM.items()
    }
    model.aggregate("project of site", model.project, [site])
    model.aggregate("site of building", site, [building])
    model.aggregate("building of storeys", building, list(storeys.values()))
    model.contain("grid in 3F", storeys["3F"], [_grid(model, storeys["3F"])])
    return storeys


def _grid(model: Model, storey: Any) -> Any:
    low, high = -2000.0, 26000.0

    def axis(tag: str, start: tuple[float, float], end: tuple[float, float]) -> Any:
        line = model.new("IfcPolyline", Points=[model.point(*start), model.point(*end)])
        return model.new("IfcGridAxis", AxisTag=tag, AxisCurve=line, SameSense=True)

    rows = [axis(tag, (low, y), (high, y)) for tag, y in GRID_Y_MM.items()]
    lines = [axis(tag, (x, low), (x, high)) for tag, x in GRID_X_MM.items()]
    curves = model.new("IfcGeometricCurveSet", Elements=[line.AxisCurve for line in (*rows, *lines)])
    drawn = model.new(
        "IfcShapeRepresentation",
        ContextOfItems=model.plan,
        RepresentationIdentifier="FootPrint",
        RepresentationType="GeometricCurveSet",
        Items=[curves],
    )
    return model.rooted(
        "IfcGrid",
        "grid",
        Name="轴网 Grid",
        ObjectPlacement=model.placement(storey.ObjectPlacement),
        Representation=model.new("IfcProductDefinitionShape", Representations=[drawn]),
        UAxes=rows,
        VAxes=lines,
    )


def _types(model: Model) -> dict[str, Any]:
    square = model.new("IfcRectangleProfileDef", ProfileType="AREA", XDim=SIZE_MM, YDim=SIZE_MM)
    tube = model.new(
        "IfcCircleHollowProfileDef",
        ProfileType="AREA",
        Radius=SLEEVE_OUTER_MM / 2.0,
        WallThickness=(SLEEVE_OUTER_MM - SLEEVE_INNER_MM) / 2.0,
    )
    socket = model.new("IfcCircleHollowProfileDef", ProfileType="AREA", Radius=17.0, WallThickness=5.0)
    own = [model.bar([(x, y, 290.0), (x, y, HEIGHT_MM - 40.0)], REBAR_MM) for x, y in RING_MM]
    side = 270.0
    corners = [(-side, -side), (side, -side), (side, side), (-side, side), (-side, -side)]
    ties = [model.bar([(x, y, z) for x, y in corners], 10.0) for z in (100.0, 200.0, 300.0)]
    return {
        "column": model.type(
            "IfcColumnType",
            "column type",
            "SweptSolid",
            [model.extrusion(square, HEIGHT_MM)],
            Name=f"{PIECE_MARK} 600x600",
            PredefinedType="COLUMN",
        ),
        "sleeve": model.type(
            "IfcDiscreteAccessoryType",
            "sleeve type",
            "SweptSolid",
            [model.extrusion(tube, SLEEVE_LENGTH_MM)],
            Name="灌浆套筒 Grouting sleeve GTQ4Z-20",
            ElementType="GTQ4Z-20",
            PredefinedType="USERDEFINED",
        ),
        "lifting": model.type(
            "IfcDiscreteAccessoryType",
            "lifting socket type",
            "SweptSolid",
            [model.extrusion(socket, 150.0)],
            Name="吊装套筒 Lifting socket M24",
            ElementType="M24x150",
            PredefinedType="USERDEFINED",
        ),
        "bracing": model.type(
            "IfcDiscreteAccessoryType",
            "bracing socket type",
            "SweptSolid",
            [model.extrusion(socket, 100.0, _inwards(model))],
            Name="斜撑套筒 Bracing socket M20",
            ElementType="M20x100",
            PredefinedType="USERDEFINED",
        ),
        "rebar": model.type(
            "IfcReinforcingBarType",
            "rebar type",
            "AdvancedSweptSolid",
            [model.bar([(0.0, 0.0, -REBAR_LENGTH_MM), (0.0, 0.0, 0.0)], REBAR_MM)],
            Name="连接钢筋 Connecting rebar HRB400 20",
            PredefinedType="ANCHORING",
            NominalDiameter=REBAR_MM,
            BarLength=REBAR_LENGTH_MM,
        ),
        "own": model.type(
            "IfcReinforcingBarType",
            "own bars type",
            "AdvancedSweptSolid",
            own,
            Name="纵筋 Longitudinal bars HRB400 20",
            PredefinedType="MAIN",
            NominalDiameter=REBAR_MM,
            BarLength=HEIGHT_MM - 330.0,
        ),
        "ties": model.type(
            "IfcReinforcingBarType",
            "stirrup type",
            "AdvancedSweptSolid",
            ties,
            Name="箍筋 Stirrup HPB300 10",
            PredefinedType="LIGATURE",
            NominalDiameter=10.0,
            BarLength=8.0 * side,
        ),
    }


def _inwards(model: Model) -> Any:
    """Axes on the column's +x face, z into the concrete."""
    return model.new(
        "IfcAxis2Placement3D",
        Location=model.point(0.0, 0.0, 0.0),
        Axis=model.direction(-1.0, 0.0, 0.0),
        RefDirection=model.direction(0.0, 1.0, 0.0),
    )


def _cast_unit(
    model: Model,
    types: dict[str, Any],
    occurrences: dict[str, list[Any]],
    storey: Any,
    tag: str,
    _: str,
    foot: Point,
    turn_deg: float,
) -> Any:
    """A column with what is cast into it, as an assembly in its storey."""
    at = model.placement(storey.ObjectPlacement, (foot[0], foot[1], 0.0), turn_deg)
    unit = model.rooted(
        "IfcElementAssembly",
        f"{tag} unit",
        Name=f"预制构件 Cast unit {tag}",
        Tag=tag,
        ObjectPlacement=at,
        AssemblyPlace="FACTORY",
        PredefinedType="USERDEFINED",
        ObjectType="PRECAST_COLUMN",
    )

    def part(kind: str, number: int, ifc_class: str, origin: Point, **attributes: Any) -> Any:
        called = attributes.pop("Name", types[kind].Name)
        element = model.occurrence(
            ifc_class, f"{tag} {kind} {number}", types[kind], model.placement(at, origin), Name=called, **attributes
        )
        occurrences[kind].append(element)
        return element

    half, head = SIZE_MM / 2.0, HEIGHT_MM
    column = part(
        "column",
        1,
        "IfcColumn",
        (0.0, 0.0, 0.0),
        Name=f"预制柱 Precast column {tag}",
        Tag=tag,
        PredefinedType="COLUMN",
    )
    sleeves = [
        part("sleeve", number, "IfcDiscreteAccessory", (x, y, 0.0), ObjectType="GTQ4Z-20")
        for number, (x, y) in enumerate(RING_MM, start=1)
    ]
    sockets = [
        part("lifting", number, "IfcDiscreteAccessory", (x, 0.0, head - 150.0))
        for number, x in enumerate((-150.0, 150.0), start=1)
    ]
    brace = part("bracing", 1, "IfcDiscreteAccessory", (half, 0.0, 2000.0))
    own = part("own", 1, "IfcReinforcingBar", (0.0, 0.0, 0.0))
    ties = part("ties", 1, "IfcReinforcingBar", (0.0, 0.0, 0.0))
    model.aggregate(f"{tag} parts", unit, [column, *sleeves, *sockets, brace, own, ties])
    return unit


def _rebars(
    model: Model, types: dict[str, Any], storey: Any, tag: str, _: str, foot: Point, turn_deg: float
) -> list[Any]:
    """The bars that a column comes down on, in the storey below, placed by their tops."""
    top = foot[2] - STOREYS_MM["2F"] + REBAR_ABOVE_FLOOR_MM
    group = model.placement(storey.ObjectPlacement, (foot[0], foot[1], top), turn_deg)
    return [
        model.occurrence(
            "IfcReinforcingBar",
            f"{tag} rebar {number}",
            types["rebar"],
            model.placement(group, (x, y, 0.0)),
            Name=types["rebar"].Name,
        )
        for number, (x, y) in enumerate(RING_MM, start=1)
    ]


def _slab(model: Model, storey: Any) -> Any:
    """The floor, its upper face at the storey's level."""
    margin, thickness = 1000.0, 160.0
    width, depth = (max(axes.values()) + 2.0 * margin for axes in (GRID_X_MM, GRID_Y_MM))
    profile = model.new("IfcRectangleProfileDef", ProfileType="AREA", XDim=width, YDim=depth)
    origin = (width / 2.0 - margin, depth / 2.0 - margin, -thickness)
    shape = model.drawn("SweptSolid", [model.extrusion(profile, thickness)])
    return model.rooted(
        "IfcSlab",
        "floor",
        Name="叠合板 Floor slab",
        ObjectPlacement=model.placement(storey.ObjectPlacement, origin),
        Representation=model.new("IfcProductDefinitionShape", Representations=[shape]),
        PredefinedType="FLOOR",
    )


if __name__ == "__main__":
    target = Path(sys.argv[1]) if sys.argv[1:] else Path(__file__).parent / "floor" / "floor3.ifc"
    target.parent.mkdir(exist_ok=True)
    build().write(str(target))
