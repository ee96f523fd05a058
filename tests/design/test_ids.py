"""The information delivery specification: fulfilled by the sample model, not by models that lack things."""

from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import ifcopenshell
import pytest

from aadm_workbench.design.ifc.words import NOT_SLEEVE, REBAR, SLEEVE

ids = pytest.importorskip("ifctester.ids", reason="ifctester is not installed: pip install ifctester")


@pytest.fixture(scope="module")
def specification(repository: Path) -> Path:
    return repository / "samples" / "aadm.ids"


@pytest.fixture
def sample(repository: Path) -> Any:
    return ifcopenshell.open(str(repository / "samples" / "floor" / "floor3.ifc"))


def unfulfilled(specification: Path, model: Any) -> set[str]:
    """Identifiers of what a model does not fulfil; the specification itself is checked against its schema."""
    checked = ids.open(str(specification), validate=True)
    checked.validate(model)
    written = ElementTree.parse(specification).iter("{http://standards.buildingsmart.org/IDS}specification")
    identifiers = {each.get("name"): str(each.get("identifier")) for each in written}
    return {identifiers[each.name] for each in checked.specifications if not each.status}


def test_the_sample_fulfils_it(specification: Path, sample: Any) -> None:
    assert unfulfilled(specification, sample) == set()


def remove(ifc_class: str) -> Callable[[Any], None]:
    def change(model: Any) -> None:
        for element in model.by_type(ifc_class):
            model.remove(element)

    return change


def rename(ifc_class: str, name: str | None) -> Callable[[Any], None]:
    def change(model: Any) -> None:
        for element in model.by_type(ifc_class):
            element.Name = name

    return change


def untag(model: Any) -> None:
    model.by_type("IfcColumn")[3].Tag = None


def blank(model: Any) -> None:
    model.by_type("IfcColumn")[3].Name = " "


def blank_mark(model: Any) -> None:
    for single in model.by_type("IfcPropertySingleValue"):
        if single.Name == "PieceMark":
            single.NominalValue = model.create_entity("IfcLabel", " ")


def socket(model: Any) -> None:
    next(e for e in model.by_type("IfcDiscreteAccessory") if "吊装" not in e.Name).Name = "灌浆套筒 Lifting"


@pytest.mark.parametrize(
    ("change", "missing"),
    [
        (remove("IfcColumn"), {"columns"}),
        (untag, {"columns"}),
        (blank, {"columns"}),
        (rename("IfcDiscreteAccessory", "part"), {"sleeves"}),
        (remove("IfcDiscreteAccessory"), {"sleeves"}),
        (socket, {"sleeves"}),
        (rename("IfcReinforcingBar", " "), {"rebars"}),
        (remove("IfcReinforcingBar"), {"rebars"}),
        (remove("IfcRelContainedInSpatialStructure"), {"storeys", "rebars"}),
        (blank_mark, {"piece-marks"}),
    ],
    ids=[
        *("no columns", "no tag", "blank name", "nameless sleeves", "no sleeves", "a socket called sleeve"),
        *("nameless bars", "no bars", "no storeys", "blank piece mark"),
    ],
)
def test_what_a_model_lacks_is_named(
    specification: Path, sample: Any, change: Callable[[Any], None], missing: set[str]
) -> None:
    change(sample)
    assert unfulfilled(specification, sample) == missing


@pytest.mark.parametrize(
    "name",
    [
        "灌浆套筒",
        "Grouting sleeve 20",
        "GROUT_SLEEVE",
        "GTQ4Z-20",
        "Splice Sleeve",
        "スリーブ",
        "モルタル充填式継手",
        "波纹管 40",
    ],
)
def test_names_that_it_asks_for_are_recognised(specification: Path, sample: Any, name: str) -> None:
    rename("IfcDiscreteAccessory", name)(sample)
    assert unfulfilled(specification, sample) == set()
    assert SLEEVE.search(name)
    assert not NOT_SLEEVE.search(name)


@pytest.mark.parametrize(
    "name", ["连接钢筋 20", "插筋", "差し筋 D25", "差筋", "Starter bar", "DOWEL", "Connecting rebar"]
)
def test_names_of_bars_that_it_asks_for_are_recognised(specification: Path, sample: Any, name: str) -> None:
    rename("IfcReinforcingBar", name)(sample)
    # The column's own bars are parts of its cast unit, which stands in a storey.
    assert unfulfilled(specification, sample) == set()
    assert REBAR.search(name)
