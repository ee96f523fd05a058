"""Small IFC models with results to be written into: a column in any schema and unit, and the sample floor."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.validate

from tests.design.authoring import Author
from tests.report.floor_schemas import converted

FLOOR = Path(__file__).resolve().parents[2] / "samples" / "floor" / "floor3.ifc"
CORNERS = [(x, y) for x in (-240.0, 240.0) for y in (-200.0, 200.0)]


@cache
def _floor(schema: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        return converted(FLOOR, schema, Path(folder) / "floor.ifc").read_bytes()


def floor(folder: Path, schema: str) -> Path:
    """The sample floor in a schema."""
    path = folder / f"floor-{schema}.ifc"
    path.write_bytes(_floor(schema))
    return path


def to_micrometres(mm: Any) -> Any:
    """Lengths of a report as the model holds them."""
    if isinstance(mm, list | tuple):
        return [to_micrometres(value) for value in mm]
    return None if mm is None else round(mm, 3)


def one_column(
    folder: Path,
    schema: str = "IFC4",
    unit: str = "mm",
    *,
    wcs: tuple[float, float, float] = (0.0, 0.0, 0.0),
    far: tuple[float, float, float] = (1000.0, 2000.0, 0.0),
    name: str = "C-1",
    then: Callable[[Author, list[Any]], None] | None = None,
) -> Path:
    """A column that stands turned in a turned storey, with four sleeves and bars; ``then`` adds to it."""
    author = Author(folder, schema, unit, wcs)
    site = author.rooted("IfcSite", ObjectPlacement=author.placement(None, far), CompositionType="ELEMENT")
    turned = author.placement(site.ObjectPlacement, (0.0, 0.0, 3600.0), (0.0, 0.0, 1.0), (0.6, 0.8, 0.0))
    storey = author.rooted("IfcBuildingStorey", Name="2F", ObjectPlacement=turned, CompositionType="ELEMENT")
    own = author.placement(turned, (500.0, 700.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0))
    column = author.column(own, Name=name, Tag=name)
    sleeves, rebars = author.sleeves(own, CORNERS), author.rebars(own, CORNERS)
    author.aggregate(author.project, [site])
    author.aggregate(site, [storey])
    author.contain(storey, [column, *sleeves, *rebars])
    if then:
        then(author, sleeves)
    return author.write()


def entities(path: Path) -> dict[int, str]:
    return {entity.id(): str(entity) for entity in ifcopenshell.open(path)}


def complaints_about_additions(model: Path, written: Path) -> list[str]:
    """What ifcopenshell has against the entities that were added, express rules included."""
    logger = ifcopenshell.validate.json_logger()
    ifcopenshell.validate.validate(ifcopenshell.open(written), logger, express_rules=True)
    own = entities(model)
    return [
        f"{entry['instance']} {entry['message']}"
        for entry in logger.statements
        if not entry.get("instance") or entry["instance"].id() not in own
    ]
