"""Columns placed by the crossings of a grid."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.design.ifc.text.test_prepared import check_whole, read
from tests.design.step_yard import Step, Yard, polyline, yard


def on_grid(schema: str, offsets: str = "(0.,0.,0.)", towards: str = "$") -> Callable[[Step], str]:
    """A crossing of x = 8000 and y = 6000 of a grid at (1000, 2000)."""

    def placed(step: Step) -> str:
        grid = step.placement("$", 1000.0, 2000.0, 0.0)
        lines = [
            polyline(step, (8000.0, 0.0), (8000.0, 9000.0)),
            polyline(step, (0.0, 6000.0), (9000.0, 6000.0)),
            polyline(step, (0.0, 0.0), (0.0, 9000.0)),
        ]
        u, v, w = (step.add(f"IFCGRIDAXIS('{tag}',{line},.T.)") for tag, line in zip("B2A", lines, strict=True))
        step.add(f"IFCGRID({step.global_id()},$,'G',$,$,{grid},$,({w},{u}),({v}),$,$)")
        at = step.add(f"IFCVIRTUALGRIDINTERSECTION(({u},{v}),{offsets})")
        other = step.add(f"IFCVIRTUALGRIDINTERSECTION(({w},{v}),(0.,0.))")
        direction = {"$": "$", "direction": step.direction(1.0, 0.0), "crossing": other}[towards]
        relative = f"{grid}," if schema.startswith("IFC4X3") else ""
        return step.add(f"IFCGRIDPLACEMENT({relative}{at},{direction})")

    return placed


@pytest.mark.parametrize("schema", ["IFC4", "IFC4X3_ADD2"])
@pytest.mark.parametrize(
    ("towards", "x_axis"), [("$", (0.0, 1.0)), ("direction", (1.0, 0.0)), ("crossing", (-1.0, 0.0))]
)
def test_columns_that_stand_on_grid_crossings(
    schema: str, towards: str, x_axis: tuple[float, float], tmp_path: Path
) -> None:
    """The first axis runs along y, so the element's x does, unless something else is pointed at."""
    model = read(tmp_path, yard(Yard(schema=schema, placed=on_grid(schema, towards=towards))))
    check_whole(model, 9000.0, 8000.0)
    (column,) = model.columns
    assert column.grid == "B/2"
    assert column.T_model_column is not None
    assert column.T_model_column[:2, 0] == pytest.approx(x_axis, abs=1e-9)


def test_offsets_from_grid_axes_go_to_their_left(tmp_path: Path) -> None:
    """Left of an axis along +y is -x, left of one along +x is +y; the third is the height."""
    model = read(tmp_path, yard(Yard(placed=on_grid("IFC4", "(100.,30.,5.)"))))
    T = model.columns[0].T_model_column
    assert T is not None
    assert T[:3, 3] == pytest.approx([8900.0, 8030.0, 5.0], abs=1e-3)


def test_a_curved_or_parallel_grid_is_said_to_be_one(tmp_path: Path) -> None:
    text = yard(Yard(placed=on_grid("IFC4")))
    crossing = next(line for line in text.splitlines() if "IFCVIRTUALGRIDINTERSECTION" in line)
    first = crossing.partition("((")[2].partition(",")[0]
    same = crossing.replace(crossing.partition("((")[2].partition(")")[0], f"{first},{first}")
    model = read(tmp_path, text.replace(crossing, same))
    assert model.columns == ()
    assert any("do not cross" in warning for warning in model.warnings)
