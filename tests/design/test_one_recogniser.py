"""One yard as an IFC file and as elements of another program: what is a column, a sleeve or a bar is decided alike."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.design.elements import Element, Solid
from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.recognise.columns import Origin, recognise
from aadm_workbench.design.recognise.tubes import Tube
from tests.design.test_elements import RING, box


@dataclass(frozen=True)
class Called:
    """Class, names and PredefinedType of things of one kind."""

    ifc_class: str
    name: str = ""
    description: str = ""
    predefined_type: str = ""

    def attributes(self) -> dict[str, str]:
        said = {"Name": self.name, "Description": self.description, "PredefinedType": self.predefined_type}
        return {key: value for key, value in said.items() if value}


@dataclass(frozen=True)
class Yard:
    """A column, a sleeve and a bar at each corner; what each is called, and how thick the bars are drawn, mm."""

    column: Called = Called("IfcColumn", "C-1")
    sleeve: Called = Called("IfcDiscreteAccessory", "灌浆套筒")
    bar: Called = Called("IfcReinforcingBar", "插筋")
    bar_mm: float = 20.0

    def as_ifc(self, author: Callable[..., Any]) -> ModelDesign:
        model = author(schema="IFC4X3")
        profile = model.profile("IfcRectangleProfileDef", XDim=600.0, YDim=600.0)
        block = model.extrusion(profile, 3000.0)
        model.element(self.column.ifc_class, [block], model.placement(), **self.column.attributes())
        for x, y in RING:
            at = model.placement(None, (x, y, 0.0))
            model.element(self.sleeve.ifc_class, [model.tube()], at, **self.sleeve.attributes())
            rod = model.cylinder(self.bar_mm / 2.0, 560.0, model.axes((x, y, -400.0)))
            model.element(self.bar.ifc_class, [rod], model.placement(), **self.bar.attributes())
        return read_ifc(model.write())

    def as_elements(self) -> ModelDesign:
        drawn = [_element("block", self.column, [], box())]
        for k, (x, y) in enumerate(RING):
            tube = Tube(np.array([x, y, 0.0]), np.array([x, y, 310.0]), 48.0, (36.0, 36.0))
            rod = Tube(np.array([x, y, -400.0]), np.array([x, y, 160.0]), self.bar_mm, (None, None))
            drawn += [_element(f"tube {k}", self.sleeve, [tube]), _element(f"rod {k}", self.bar, [rod])]
        return recognise(drawn, Origin("yard", "", ""))


def _element(number: str, called: Called, tubes: list[Tube], edges: tuple[Any, ...] = ()) -> Element:
    lines = edges or tuple(np.array([tube.start, tube.end]) for tube in tubes)
    said = " | ".join(text for text in (called.name, called.description) if text)
    return Element(
        number,
        called.name,
        said,
        (Solid(tuple(tubes), (), lines),),
        np.eye(4),
        ifc_class=called.ifc_class,
        predefined_type=called.predefined_type,
    )


def found(model: ModelDesign) -> tuple[int, int, int]:
    """How many columns there are, and how many sleeves and bars the first has."""
    if not model.columns:
        return 0, 0, 0
    return len(model.columns), len(model.columns[0].sleeves), len(model.columns[0].rebars)


USUAL = Yard()
PROXY = "IfcBuildingElementProxy"
YARDS = {
    "as they should be called": (USUAL, (1, 4, 4)),
    "a column that is described with its sleeves": (
        replace(USUAL, column=Called(PROXY, "PC column C-1", "with grouting sleeves and dowels")),
        (1, 4, 4),
    ),
    "a column exported as a beam": (replace(USUAL, column=Called("IfcBeam", "框架柱 C-1")), (1, 4, 4)),
    "a stirrup cage of a column": (replace(USUAL, column=Called(PROXY, "柱箍筋")), (0, 0, 0)),
    "dowels of a column": (replace(USUAL, column=Called(PROXY, "柱插筋")), (0, 0, 0)),
    "the base of a column": (replace(USUAL, column=Called(PROXY, "柱脚")), (0, 0, 0)),
    "ducts by their type": (
        replace(USUAL, sleeve=Called("IfcTendonConduit", predefined_type="GROUTING_DUCT")),
        (1, 4, 4),
    ),
    "sleeves exported as bars": (replace(USUAL, sleeve=Called("IfcReinforcingBar", "半灌浆套筒")), (1, 4, 4)),
    "sleeves exported as columns": (replace(USUAL, sleeve=Called("IfcColumn", "Grouting sleeve")), (1, 4, 4)),
    "bars exported as beams": (replace(USUAL, bar=Called("IfcBeam", "连接钢筋")), (1, 4, 4)),
    "bars exported as columns": (replace(USUAL, bar=Called("IfcColumn", "连接钢筋")), (1, 4, 4)),
    "bars exported as bolts": (replace(USUAL, bar=Called("IfcMechanicalFastener", "dowel bar")), (1, 4, 4)),
    "ties": (replace(USUAL, bar=Called("IfcReinforcingBar", "箍筋")), (1, 4, 0)),
    "ties by their type": (replace(USUAL, bar=Called("IfcReinforcingBar", predefined_type="LIGATURE")), (1, 4, 0)),
    "posts that are called bars": (replace(USUAL, bar_mm=90.0), (1, 4, 0)),
}


@pytest.mark.parametrize(("yard", "expected"), YARDS.values(), ids=list(YARDS))
def test_both_kinds_of_model_are_recognised_alike(
    author: Callable[..., Any], yard: Yard, expected: tuple[int, int, int]
) -> None:
    assert (found(yard.as_ifc(author)), found(yard.as_elements())) == (expected, expected)
