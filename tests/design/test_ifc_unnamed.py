"""Sleeves that nothing but their place and their bars tells, chamfered mouths, columns by other names."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.errors import DesignError
from tests.design.ifc.test_sleeves import Ring, check, draw


@pytest.mark.parametrize("voiding", [0, 5, 11], ids=["no relation", "some relations", "all but one"])
def test_openings_of_which_some_lack_the_relation(author: Callable[..., Any], ring: Ring, voiding: int) -> None:
    """Those that void the column are not all: a column checked for these only would pass wrongly, without a word."""
    model = author()
    column = model.column(model.placement(), Name="C-1")
    openings = draw(model, lambda: [model.cylinder(18.0, 310.0)], ring, "IfcOpeningElement")
    for opening in openings[:voiding]:
        model.void(column, opening)
    check(read_ifc(model.write()), ring)


@pytest.mark.parametrize("entered", [True, False])
def test_the_few_of_another_bore_are_told_by_their_bars(author: Callable[..., Any], ring: Ring, entered: bool) -> None:
    """Ten like holes and two wider ones, all without a name: sleeves where bars go into them, else only said."""
    model = author()
    model.column(model.placement(), Name="C-1")
    draw(model, lambda: [model.tube()], ring[:10], "IfcBuildingElementProxy")
    draw(model, lambda: [model.tube(41.0, 51.0, 410.0)], ring[10:], "IfcBuildingElementProxy")
    model.rebars(model.placement(), ring if entered else ring[:10])
    (read,) = read_ifc(model.write()).columns
    bores = [point.diameter_mm for point in read.sleeves]
    assert bores == pytest.approx([36.0] * 10 + [41.0] * (2 if entered else 0), abs=1e-3)
    assert len(read.rebars) == len(bores)
    assert any(warning.startswith("2 more round holes") for warning in read.warnings) is not entered


def test_a_chamfered_mouth_is_not_the_bore(author: Callable[..., Any], ring: Ring) -> None:
    """Turned, and of facets: Ø 36 behind a chamfer of 2 mm, which opens to Ø 40."""
    model = author()
    model.column(model.placement(), Name="C-1")
    corners = [(20.0, 0.0), (24.0, 0.0), (24.0, 310.0), (18.0, 310.0), (18.0, 2.0)]
    profile = model.new("IfcArbitraryClosedProfileDef", "AREA", None, model.polygon(corners))
    axis = model.new("IfcAxis1Placement", model.point((0.0, 0.0, 0.0)), model.direction((0.0, 1.0, 0.0)))
    upright = model.axes((0.0, 0.0, 0.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0))
    draw(
        model,
        lambda: [model.new("IfcRevolvedAreaSolid", profile, upright, axis, 360.0)],
        ring[:6],
        "IfcDiscreteAccessory",
        Name="套筒",
    )
    draw(model, lambda: [faceted_turning(model, corners)], ring[6:], "IfcDiscreteAccessory", Name="套筒")
    check(read_ifc(model.write()), ring)


def faceted_turning(model: Any, corners: Sequence[tuple[float, float]], sides: int = 24) -> Any:
    """Corners (r, z) turned about z: quadrangles between neighbours, halved."""
    angles = np.arange(sides) * 2.0 * np.pi / sides
    points = [[r * np.cos(a), r * np.sin(a), z] for r, z in corners for a in angles]
    faces = []
    for first in range(len(corners)):
        second = (first + 1) % len(corners)
        for k in range(sides):
            a, b = first * sides + k + 1, first * sides + (k + 1) % sides + 1
            c, d = second * sides + (k + 1) % sides + 1, second * sides + k + 1
            faces += [(a, b, c), (a, c, d)]
    coordinates = model.new("IfcCartesianPointList3D", [[model.length(value) for value in point] for point in points])
    return model.new("IfcTriangulatedFaceSet", coordinates, None, True, faces)


def test_the_only_column_of_a_file_answers_to_the_file_s_name(author: Callable[..., Any], ring: Ring) -> None:
    """Meshes and bare STEP bodies have no names of their own: a job says C-301 and means C-301.stl."""
    model = author()
    model.column(model.placement(), Name="body-1")
    model.sleeves(model.placement(), ring)
    assert read_ifc(model.write("C-301.ifc")).column("C-301").id == "body-1"
    model.column(model.placement(None, (5000.0, 0.0, 0.0)), Name="body-2")
    model.sleeves(model.placement(None, (5000.0, 0.0, 0.0)), ring)
    with pytest.raises(DesignError, match="no column called 'C-302'"):
        read_ifc(model.write("C-302.ifc")).column("C-302")


def test_a_round_column_is_no_bar(author: Callable[..., Any], ring: Ring) -> None:
    model = author()
    model.element("IfcColumn", [model.cylinder(350.0, 3000.0)], model.placement(), Name="Column, starter bars 12 x 20")
    model.sleeves(model.placement(), [(x * 0.8, y * 0.8) for x, y in ring])
    model.rebars(model.placement(), [(x * 0.8, y * 0.8) for x, y in ring])
    read = read_ifc(model.write())
    (column,) = read.columns
    assert (len(column.sleeves), len(column.rebars), read.loose_rebars) == (12, 12, ())
    assert [left.reason for left in read.not_taken] == ["is 700 mm thick: no reinforcing bar"]
