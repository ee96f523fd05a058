"""One bad element costs nothing but itself: it is left out, and named in a warning and in the list of what was left."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.ifc.geometry import kernel as ifc_kernel
from aadm_workbench.design.ifc.geometry.kernel import Kernel
from aadm_workbench.design.ifc.geometry.placement import UnreadableGeometryError
from aadm_workbench.design.ifc.model import read_ifc
from tests.design.authoring import Author
from tests.design.ifc.text.test_prepared import check_whole, read
from tests.design.step_yard import Step, Yard, polyline, yard

Item = Callable[[Step], str]


def swept(step: Step, curve: str, radius: str = "10.") -> str:
    return step.add(f"IFCSWEPTDISKSOLID({curve},{radius},$,$,$)")


def circle_profile(step: Step, radius: str = "10.") -> str:
    return step.add(f"IFCCIRCLEPROFILEDEF(.AREA.,$,{step.flat()},{radius})")


def trimmed_line(step: Step, begin: str, stop: str) -> str:
    along = step.add(f"IFCVECTOR({step.direction(0.0, 0.0, 1.0)},1.)")
    line = step.add(f"IFCLINE({step.point(0.0, 0.0, 0.0)},{along})")
    trims = f"(IFCPARAMETERVALUE({begin})),(IFCPARAMETERVALUE({stop}))"
    return step.add(f"IFCTRIMMEDCURVE({line},{trims},.T.,.PARAMETER.)")


def face_set(step: Step, corners: str, points: str = "((0.,0.,0.),(9.,0.,0.),(0.,9.,0.),(0.,0.,9.))") -> str:
    listed = step.add(f"IFCCARTESIANPOINTLIST3D({points})")
    return step.add(f"IFCTRIANGULATEDFACESET({listed},$,$,{corners},$)")


def scaled(step: Step, scale: str) -> str:
    shape = step.add(f"IFCSHAPEREPRESENTATION(#1,'Body','SolidModel',({step.extruded(circle_profile(step), 900.0)}))")
    source = step.add(f"IFCREPRESENTATIONMAP({step.axes()},{shape})")
    target = step.add(f"IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,{step.point(0.0, 0.0, 0.0)},{scale},$)")
    return step.add(f"IFCMAPPEDITEM({source},{target})")


def itself(text: str) -> Item:
    """An entity that names itself where the text says @."""

    def draw(step: Step) -> str:
        other = circle_profile(step)
        solid = step.extruded(other, 900.0)
        return step.add(text.replace("@", f"#{len(step.lines) + 1}").replace("%", solid))

    return draw


def endless_profile(step: Step) -> str:
    own = f"#{len(step.lines) + 1}"
    step.add(f"IFCCOMPOSITEPROFILEDEF(.AREA.,$,({own},{own}),$)")
    return step.extruded(own, 900.0)


def endless_curve(step: Step) -> str:
    segment, curve = (f"#{len(step.lines) + k}" for k in (1, 2))
    step.add(f"IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,{curve})")
    step.add(f"IFCCOMPOSITECURVE(({segment},{segment}),.F.)")
    return swept(step, curve)


def doubled_again_and_again(step: Step) -> str:
    """A boolean of two of the last, forty times: a million million solids in forty lines."""
    last = step.extruded(circle_profile(step), 900.0)
    for _ in range(40):
        last = step.add(f"IFCBOOLEANRESULT(.DIFFERENCE.,{last},{last})")
    return last


def nested(step: Step) -> str:
    last = step.extruded(circle_profile(step), 900.0)
    for _ in range(3000):
        last = step.add(f"IFCCSGSOLID({step.add(f'IFCBOOLEANRESULT(.UNION.,{last},{last})')})")
    return last


BROKEN: dict[str, Item] = {
    "no depth": lambda step: step.extruded(circle_profile(step), 0.0),
    "a depth of 1E308": lambda step: step.add(
        f"IFCEXTRUDEDAREASOLID({circle_profile(step)},{step.axes()},{step.direction(0.0, 0.0, 1.0)},1.E308)"
    ),
    "no radius": lambda step: step.extruded(circle_profile(step, "0."), 900.0),
    "coincident points": lambda step: swept(step, polyline(step, (1.0, 1.0, 1.0), (1.0, 1.0, 1.0))),
    "one point": lambda step: swept(step, polyline(step, (1.0, 1.0, 1.0))),
    "equal trims": lambda step: swept(step, trimmed_line(step, "5.", "5.")),
    "no direction": lambda step: step.add(
        f"IFCEXTRUDEDAREASOLID({circle_profile(step)},{step.axes()},{step.direction(0.0, 0.0, 0.0)},900.)"
    ),
    "a disk of no radius": lambda step: swept(step, polyline(step, (0.0, 0.0, 0.0), (0.0, 0.0, 900.0)), "0."),
    "no faces": lambda step: face_set(step, "()"),
    "no such corner": lambda step: face_set(step, "((1,2,3),(1,2,9))"),
    "corner nought": lambda step: face_set(step, "((0,1,2),(1,2,3))"),
    "points beyond all maps": lambda step: face_set(
        step, "((1,2,3),(1,2,4))", "((0.,0.,0.),(1.E308,0.,0.),(0.,9.,0.),(0.,0.,9.))"
    ),
    "scaled to nothing": lambda step: scaled(step, "0."),
    "a curve that is a point": lambda step: swept(step, step.point(0.0, 0.0, 0.0)),
    "nothing": lambda step: step.add("IFCEXTRUDEDAREASOLID($,$,$,900.)"),
    "a turn without end": lambda step: step.add(
        f"IFCREVOLVEDAREASOLID({circle_profile(step)},{step.axes()},"
        f"{step.add(f'IFCAXIS1PLACEMENT({step.point(50.0, 0.0, 0.0)},{step.direction(0.0, 1.0, 0.0)})')},1.E12)"
    ),
    "an arc without end": lambda step: step.add(
        f"IFCSURFACECURVESWEPTAREASOLID({circle_profile(step)},{step.axes()},"
        f"{step.add(f'IFCCIRCLE({step.axes()},50.)')},0.,1.E12,$)"
    ),
    "a boolean of itself": itself("IFCBOOLEANRESULT(.UNION.,@,%)"),
    "a boolean of its tool": itself("IFCBOOLEANRESULT(.DIFFERENCE.,%,@)"),
    "a tree of itself": itself("IFCCSGSOLID(@)"),
    "an endless profile": endless_profile,
    "an endless curve": endless_curve,
    "doubled": doubled_again_and_again,
    "nested": nested,
}


def stray(item: Item) -> Callable[[Step, str], None]:
    def add(step: Step, _: str) -> None:
        step.bar(item(step), step.placement("$", 9000.0, 0.0, 0.0), "stray")

    return add


@pytest.mark.parametrize("what", BROKEN)
def test_a_bar_that_is_none_costs_only_itself(what: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    model = read(tmp_path, yard(Yard(more=stray(BROKEN[what]))))
    check_whole(model)
    assert model.loose_rebars == ()
    assert any(
        left.name == "stray" and "no geometry that could be evaluated" in left.reason for left in model.not_taken
    )
    assert any("its geometry was left out" in warning for warning in model.warnings)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("what", BROKEN)
def test_a_column_that_is_none_is_said_to_be_none(what: str, tmp_path: Path) -> None:
    def add(step: Step, _: str) -> None:
        placed, drawn = step.placement("$", 9000.0, 0.0, 0.0), step.shape(BROKEN[what](step))
        step.add(f"IFCCOLUMN({step.global_id()},$,'stray',$,$,{placed},{drawn},'C-9',$)")

    model = read(tmp_path, yard(Yard(more=add)))
    check_whole(model)
    assert any(left.what == "column" and "C-9" in left.names for left in model.not_taken)


def placed_beyond(step: Step, at: str) -> None:
    point = step.add("IFCCARTESIANPOINT((1.E308,0.,0.))")
    far = step.add(f"IFCLOCALPLACEMENT($,{step.add(f'IFCAXIS2PLACEMENT3D({point},$,$)')})")
    step.bar(step.disk([(0.0, 0.0, 0.0), (0.0, 0.0, 900.0)]), far, "stray")


def placed_on_itself(step: Step, at: str) -> None:
    own = f"#{len(step.lines) + 4}"
    step.bar(step.disk([(0.0, 0.0, 0.0), (0.0, 0.0, 900.0)]), step.placement(own), "stray")


def mapped_in_itself(step: Step, at: str) -> None:
    shape = f"#{len(step.lines) + 4}"
    source = step.add(f"IFCREPRESENTATIONMAP({step.axes()},{shape})")
    step.add(f"IFCSHAPEREPRESENTATION(#1,'Body','MappedRepresentation',(#{len(step.lines) + 4}))")
    target = step.add(f"IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,{step.point(0.0, 0.0, 0.0)},$,$)")
    item = step.add(f"IFCMAPPEDITEM({source},{target})")
    step.bar(item, at, "stray")


def parts_of_each_other(step: Step, at: str) -> None:
    first = step.add(f"IFCELEMENTASSEMBLY({step.global_id()},$,'stray',$,$,{at},$,'A',$,$)")
    second = step.add(f"IFCELEMENTASSEMBLY({step.global_id()},$,'other',$,$,{at},$,'B',$,$)")
    for whole, part in ((first, second), (second, first), (first, first)):
        step.add(f"IFCRELAGGREGATES({step.global_id()},$,$,$,{whole},({part}))")


@pytest.mark.parametrize("more", [placed_beyond, placed_on_itself, mapped_in_itself, parts_of_each_other])
def test_placements_maps_and_parts_that_go_round_cost_nothing_else(
    more: Callable[[Step, str], None], tmp_path: Path
) -> None:
    model = read(tmp_path, yard(Yard(more=more)))
    check_whole(model)
    assert more is parts_of_each_other or any("stray" in left.name for left in model.not_taken)


def test_a_column_that_is_a_part_of_its_own_part_is_read(tmp_path: Path) -> None:
    def add(step: Step, at: str) -> None:
        column = next(line.partition("=")[0] for line in step.lines if "IFCCOLUMN" in line)
        whole = step.add(f"IFCELEMENTASSEMBLY({step.global_id()},$,'unit',$,$,{at},$,'A',$,$)")
        step.add(f"IFCRELAGGREGATES({step.global_id()},$,$,$,{whole},({column}))")
        step.add(f"IFCRELAGGREGATES({step.global_id()},$,$,$,{column},({whole}))")

    check_whole(read(tmp_path, yard(Yard(more=add))))


def test_twenty_thousand_placements_one_in_the_other(tmp_path: Path) -> None:
    def deep(step: Step) -> str:
        last = step.placement("$", 1000.0, 0.0, 0.0)
        still = step.axes()
        for _ in range(20_000):
            last = step.add(f"IFCLOCALPLACEMENT({last},{still})")
        return last

    check_whole(read(tmp_path, yard(Yard(placed=deep))), 1000.0)


def test_a_unit_defined_by_itself_is_refused(tmp_path: Path) -> None:
    loop = (
        "#4=IFCCONVERSIONBASEDUNIT(#900000,.LENGTHUNIT.,'FOOT',#900001);\n"
        "#900000=IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0);\n#900001=IFCMEASUREWITHUNIT(IFCREAL(0.3048),#4);"
    )
    text = yard().replace("#4=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);", loop)
    with pytest.raises(Exception, match=r"model\.ifc declares a unit of length that makes no sense"):
        read(tmp_path, text)


def cone_bored(mouth: float, begin: float, height: float) -> Item:
    """A cylinder of 48 mm with a conical bore whose base of radius ``mouth`` lies ``begin`` mm below its foot."""

    def draw(step: Step) -> str:
        body = step.add(f"IFCRIGHTCIRCULARCYLINDER({step.axes()},310.,24.)")
        cone = step.add(f"IFCRIGHTCIRCULARCONE({step.axes(z=-begin)},{height},{mouth})")
        cut = step.add(f"IFCBOOLEANRESULT(.DIFFERENCE.,{body},{cone})")
        return step.add(f"IFCCSGSOLID({cut})")

    return draw


@pytest.mark.parametrize(
    ("sleeve", "mouth_mm"),
    [
        (cone_bored(20.0, 0.0, 1500.0), 40.0),
        (cone_bored(22.0, 150.0, 1500.0), 2.0 * 22.0 * (1.0 - 150.0 / 1500.0)),
        (cone_bored(21.0, 20.0, 350.0), 2.0 * 21.0 * (1.0 - 20.0 / 350.0)),
    ],
)
def test_conical_bores(sleeve: Item, mouth_mm: float, tmp_path: Path) -> None:
    """By the rule of three: a cone's radius falls evenly from its base to its tip."""
    model = read(tmp_path, yard(Yard(sleeve=sleeve, sleeve_class="IFCMECHANICALFASTENER")))
    check_whole(model)
    assert [p.diameter_mm for p in model.columns[0].sleeves] == pytest.approx([mouth_mm] * 8, abs=1e-3)


def test_a_frustum_of_a_cone_as_tool(tmp_path: Path) -> None:
    """A cone cut off by a plane, bored into a cylinder: half-grouted, with a thread in its other end."""

    def draw(step: Step) -> str:
        body = step.add(f"IFCRIGHTCIRCULARCYLINDER({step.axes()},310.,24.)")
        cone = step.add(f"IFCRIGHTCIRCULARCONE({step.axes()},1500.,20.)")
        plane = step.add(f"IFCPLANE({step.axes(z=200.0)})")
        above = step.add(f"IFCHALFSPACESOLID({plane},.F.)")
        frustum = step.add(f"IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,{cone},{above})")
        cut = step.add(f"IFCBOOLEANRESULT(.DIFFERENCE.,{body},{frustum})")
        thread = step.add(f"IFCRIGHTCIRCULARCYLINDER({step.axes(z=200.0)},120.,10.)")
        return step.add(f"IFCBOOLEANRESULT(.DIFFERENCE.,{cut},{thread})")

    model = read(tmp_path, yard(Yard(sleeve=draw)))
    check_whole(model)
    assert [p.diameter_mm for p in model.columns[0].sleeves] == pytest.approx([40.0] * 8, abs=1e-3)


def test_sleeves_whose_shape_is_not_drawn_are_spoken_of(tmp_path: Path) -> None:
    model = read(tmp_path, yard(Yard(sleeve=BROKEN["no depth"])))
    assert model.columns == ()
    assert "8 IfcDiscreteAccessory" in model.hint
    assert "called a sleeve" in model.hint
    assert "no depth" in model.hint


def test_columns_drawn_on_their_head_are_said_to_be(tmp_path: Path) -> None:
    model = read(tmp_path, yard(Yard(head_down=True)))
    assert model.columns == ()
    assert "on its head: 8 sleeves open in its upper face" in model.hint
    with pytest.raises(Exception, match="on its head"):
        model.column("C-1")


def test_the_kernel_comes_back_after_a_crash(author: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """A crash of the kernel costs one solid: the next is drawn by a new process."""
    model: Author = author()
    blocks = [model.new("IfcBlock", model.axes(), 10.0 * (k + 1), 20.0, 30.0) for k in range(3)]
    kernel, crash = Kernel(), ifc_kernel._facets

    def facets(item: Any) -> Any:
        if item.XLength == 20.0:
            import os

            os.abort()
        return crash(item)

    monkeypatch.setattr(ifc_kernel, "_facets", facets)
    try:
        spans = []
        for block in blocks:
            try:
                spans.append(float(np.ptp(kernel.facets(block)[0][:, 0])))
            except UnreadableGeometryError:
                spans.append(0.0)
    finally:
        kernel.close()
    assert spans == pytest.approx([10.0, 0.0, 30.0])


def test_every_element_of_a_model_may_be_broken_at_once(author: Callable[..., Any]) -> None:
    model: Author = author()
    for ifc_class in ("IfcColumn", "IfcDiscreteAccessory", "IfcReinforcingBar", "IfcWall", "IfcOpeningElement"):
        model.element(ifc_class, [model.tube(36.0, 48.0, 0.0)], model.placement(), Name="灌浆套筒")
    found = read_ifc(model.write())
    assert found.columns == ()
    assert {left.what for left in found.not_taken} == {"column", "sleeve", "rebar"}
