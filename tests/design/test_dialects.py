"""Sleeves and bars in every way of drawing, spread at random over placements and mapped items, to 0.001 mm."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.model import ColumnDesign
from tests.design import dialects
from tests.design.dialects import BENT, BENT_SINCE_IFC4, SLEEVES, SLEEVES_SINCE_IFC4, STRAIGHT
from tests.design.frames import axes, mapped, motion, on, placement, shift
from tests.design.yards import Truth, random_yard

EXACT_MM = 1e-3


@pytest.mark.parametrize("unit", ["mm", "m", "foot", "inch"])
@pytest.mark.parametrize("drawn", [*STRAIGHT, *BENT, *BENT_SINCE_IFC4])
def test_a_bar(author: Callable[..., Any], drawn: str, unit: str) -> None:
    """Its top, axis, diameter and length, wherever it stands."""
    rng = np.random.default_rng(len(drawn) * 100 + len(unit))
    model = author(unit=unit)
    draw = {**STRAIGHT, **BENT, **BENT_SINCE_IFC4}[drawn]
    lean = shift()
    lean[:3, :3] = [[math.cos(0.02), 0.0, math.sin(0.02)], [0.0, 1.0, 0.0], [-math.sin(0.02), 0.0, math.cos(0.02)]]
    T = motion(rng, upright=True) @ lean
    # A part of the way in the placement, a part in the mapped item, a part baked in.
    placed, through = motion(rng), motion(rng)
    baked = np.linalg.inv(placed @ through) @ T
    items = [mapped(model, draw(model, baked, 25.0, 900.0), through)]
    model.element("IfcReinforcingBar", items, placement(model, None, placed))
    (point,) = read_ifc(model.write()).loose_rebars
    assert point.centre == pytest.approx(on(T, (0.0, 0.0, 900.0)), abs=EXACT_MM)
    assert point.axis == pytest.approx(T[:3, 2], abs=1e-7)
    assert point.diameter_mm == pytest.approx(25.0, abs=EXACT_MM)
    # The facets of a bend are chords of its arcs.
    within_mm = 1.0 if drawn == "bent facets" else EXACT_MM
    length_mm = 900.0 if drawn in STRAIGHT else dialects.bent_length(900.0)
    assert point.length_mm == pytest.approx(length_mm, abs=within_mm)


@pytest.mark.parametrize("drawn", [*SLEEVES, *SLEEVES_SINCE_IFC4])
@pytest.mark.parametrize("unit", ["mm", "m", "foot"])
def test_a_sleeve(author: Callable[..., Any], drawn: str, unit: str) -> None:
    rng = np.random.default_rng(len(drawn) * 10 + len(unit))
    model = author(unit=unit)
    draw = {**SLEEVES, **SLEEVES_SINCE_IFC4}[drawn]
    T = motion(rng, upright=True)
    placed, outer, inner = motion(rng), motion(rng), motion(rng)
    baked = np.linalg.inv(placed @ outer @ inner) @ T
    item = mapped(model, [mapped(model, [draw(model, baked, 43.0, 58.0, 330.0)], inner)], outer)
    model.element("IfcDiscreteAccessory", [item], placement(model, None, placed), Name="スリーブ D25")
    (point,) = read_ifc(model.write()).loose_sleeves
    assert point.centre == pytest.approx(T[:3, 3], abs=EXACT_MM)
    assert point.axis == pytest.approx(T[:3, 2], abs=1e-7)
    assert point.diameter_mm == pytest.approx(43.0, abs=EXACT_MM)
    assert point.length_mm == pytest.approx(330.0, abs=EXACT_MM)


@pytest.mark.parametrize("drawn", [*SLEEVES, *SLEEVES_SINCE_IFC4])
def test_coordinates_of_6700_km(author: Callable[..., Any], drawn: str) -> None:
    """No placement at all: every number of the drawing is a map coordinate."""
    model = author()
    T = motion(np.random.default_rng(3), upright=True)
    T[:3, 3] = (6_700_000_000.125, -4_100_000_000.0, 45_678.9)
    profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
    body = model.extrusion(profile, 3000.0, axes(model, T))
    model.element("IfcColumn", [body], model.placement(), Name="C-1")
    places = [(-200.0, -200.0), (200.0, -200.0), (200.0, 200.0), (-200.0, 200.0)]
    draw = {**SLEEVES, **SLEEVES_SINCE_IFC4}[drawn]
    for x, y in places:
        tube = draw(model, T @ shift(x, y), 36.0, 48.0, 310.0)
        bar = dialects.bent_composite(model, T @ shift(x, y, -500.0), 20.0, 660.0)
        model.element("IfcDiscreteAccessory", [tube], model.placement(), Name="套筒")
        model.element("IfcReinforcingBar", bar, model.placement())
    (column,) = read_ifc(model.write()).columns
    assert column.T_model_column is not None
    assert column.T_model_column[:3, 3] - T[:3, 3] == pytest.approx(np.zeros(3), abs=EXACT_MM)
    for points, z in ((column.sleeves, 0.0), (column.rebars, 160.0)):
        truth = np.array([(x, y, z) for x, y in places]) @ T[:3, :3].T
        found = np.array([point.centre for point in points])
        apart_mm = np.linalg.norm(found[:, np.newaxis] - truth, axis=2)
        assert apart_mm.min(axis=0) == pytest.approx(np.zeros(4), abs=EXACT_MM)


@pytest.mark.parametrize("seed", range(24))
def test_a_yard_at_random(tmp_path: Path, seed: int) -> None:
    """Every column with its sleeves and bars, exact in the model and in its own frame; nothing else is taken."""
    yard = random_yard(tmp_path, np.random.default_rng(seed))
    read = read_ifc(yard.model.write())
    assert len(read.columns) == 2, read.hint
    for truth in yard.truths:
        check(read.column(truth.name), truth)
    assert (read.loose_sleeves, read.loose_rebars) == ((), ())


def check(column: ColumnDesign, truth: Truth) -> None:
    T = column.T_model_column
    assert T is not None
    assert T[:3, 2] == pytest.approx(truth.z, abs=1e-9)
    assert T[:3, 0] == pytest.approx(truth.x, abs=1e-9)
    assert T[:3, 3] - truth.sleeves.mean(axis=0) == pytest.approx(np.zeros(3), abs=EXACT_MM)
    for points, drawn in ((column.sleeves, truth.sleeves), (column.rebars, truth.tops)):
        assert len(points) == len(drawn)
        own = (drawn - truth.sleeves.mean(axis=0)) @ T[:3, :3]
        found = np.array([point.centre for point in points])
        apart_mm = np.linalg.norm(found[:, np.newaxis] - own, axis=2)
        assert apart_mm.min(axis=0) == pytest.approx(np.zeros(len(drawn)), abs=EXACT_MM)
        in_model = found @ T[:3, :3].T + (T[:3, 3] - drawn[0])
        assert np.linalg.norm(in_model[:, np.newaxis] - (drawn - drawn[0]), axis=2).min(axis=0).max() < EXACT_MM
        assert np.array([point.axis for point in points]) == pytest.approx(
            np.tile([0.0, 0.0, 1.0], (len(own), 1)), abs=1e-6
        )
    assert [point.diameter_mm for point in column.sleeves] == pytest.approx(
        [truth.bore] * len(truth.sleeves), abs=EXACT_MM
    )
    assert [point.diameter_mm for point in column.rebars] == pytest.approx(
        [truth.diameter] * len(truth.tops), abs=EXACT_MM
    )
    assert column.size_mm == pytest.approx(truth.size, abs=EXACT_MM)
    pairs = zip(column.sleeves, column.rebars, strict=True)
    assert max(np.linalg.norm(s.centre[:2] - r.centre[:2]) for s, r in pairs) < EXACT_MM
