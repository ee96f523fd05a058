"""Valid IFC models that mutations start from: small yards in which sleeves and bars are drawn in every way."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from tests.design.authoring import Author
from tests.design.dialects import BENT, BENT_SINCE_IFC4, SLEEVES, SLEEVES_SINCE_IFC4, STRAIGHT
from tests.design.frames import mapped, shift

_GLOBAL_ID = re.compile(r"'[0-3][0-9A-Za-z_$]{21}'")
_TIME = re.compile(r"'\d{4}-\d\d-\d\dT[\d:]+'")
CORNERS = [(-150.0, -150.0), (150.0, -150.0), (150.0, 150.0), (-150.0, 150.0)]


def yard(author: Author, sleeve: Any, bar: Any, name: str) -> None:
    """A column in a storey with four sleeves and bars, mapped ones, an opening, an assembly, a grid and marks."""
    site = author.rooted("IfcSite", ObjectPlacement=author.placement(), CompositionType="ELEMENT")
    storey = author.rooted(
        "IfcBuildingStorey",
        Name="3F",
        ObjectPlacement=author.placement(site.ObjectPlacement),
        CompositionType="ELEMENT",
    )
    at = author.placement(storey.ObjectPlacement, (1000.0, 2000.0, 0.0))
    column = author.column(at, (400.0, 400.0), Name=f"预制柱 {name}", Tag=name)
    hole = author.element("IfcOpeningElement", [author.cylinder(20.0, 300.0)], at, Name="opening")
    author.void(column, hole)
    sleeves, bars = [], []
    for k, (x, y) in enumerate(CORNERS):
        drawn = sleeve(author, np.eye(4), 40.0, 52.0, 310.0)
        items = [mapped(author, [drawn], np.eye(4))] if k % 2 else [drawn]
        placed = author.placement(at, (x, y, 0.0))
        sleeves.append(author.element("IfcDiscreteAccessory", items, placed, Name="灌浆套筒 GTQ4Z-20"))
        items = bar(author, shift(x, y, -800.0), 20.0, 950.0)
        bars.append(author.element("IfcReinforcingBar", items, at, Name="插筋", NominalDiameter=20.0))
    unit = author.rooted("IfcElementAssembly", Name="CAST UNIT", Tag="PC/3", ObjectPlacement=at)
    author.aggregate(author.project, [site])
    author.aggregate(site, [storey])
    author.aggregate(unit, [column, *sleeves])
    author.contain(storey, [unit, *bars])
    single = author.new("IfcPropertySingleValue", "Mark", None, author.file.create_entity("IfcLabel", name), None)
    held = author.rooted("IfcPropertySet", Name="Identity Data", HasProperties=[single])
    author.rooted("IfcRelDefinesByProperties", RelatedObjects=[column], RelatingPropertyDefinition=held)
    _grid(author, storey)


def _grid(author: Author, storey: Any) -> None:
    axes = []
    for tag, points in (("A", [(0.0, 0.0), (0.0, 9000.0)]), ("1", [(0.0, 0.0), (9000.0, 0.0)])):
        line = author.new("IfcPolyline", [author.point(point) for point in points])
        axes.append(author.new("IfcGridAxis", tag, line, True))
    placed = author.placement(storey.ObjectPlacement)
    author.rooted("IfcGrid", Name="G", ObjectPlacement=placed, UAxes=axes[:1], VAxes=axes[1:])
    crossing = author.new("IfcVirtualGridIntersection", axes, [0.0, 0.0, 0.0])
    author.new("IfcGridPlacement", PlacementLocation=crossing)


@cache
def seeds() -> tuple[bytes, ...]:
    """One model for each way of drawing, in turn of the three schemas."""
    return tuple(_made())


def _made() -> Iterator[bytes]:
    old, new = list(SLEEVES.values()), list({**SLEEVES, **SLEEVES_SINCE_IFC4}.values())
    bars, new_bars = (
        [*STRAIGHT.values(), *BENT.values()],
        [*STRAIGHT.values(), *BENT.values(), *BENT_SINCE_IFC4.values()],
    )
    with TemporaryDirectory() as folder:
        for k in range(max(len(new), len(new_bars))):
            schema = ("IFC4", "IFC2X3", "IFC4X3")[k % 3]
            ways, other = (old, bars) if schema == "IFC2X3" else (new, new_bars)
            author = Author(Path(folder), schema, ("mm", "m", "foot")[k % 3])
            yard(author, ways[k % len(ways)], other[k % len(other)], f"C-{k}")
            yield _repeatable(author.write().read_text())


def _repeatable(text: str) -> bytes:
    """The same file in every process: GlobalIds and the time of writing follow from nothing but their order."""
    ids = {found: f"'{number:022d}'" for number, found in enumerate(_GLOBAL_ID.findall(text))}
    return _TIME.sub("'2026-01-01T00:00:00'", _GLOBAL_ID.sub(lambda found: ids[found.group()], text)).encode("ascii")


def packed(content: bytes) -> bytes:
    """A model as an .ifczip."""
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("model.ifc", content)
    return held.getvalue()
