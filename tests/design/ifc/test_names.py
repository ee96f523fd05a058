"""What columns are called in models of different programs, and elements whose GlobalIds are not theirs alone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.design.ifc.names import is_machine_made
from tests.design.authoring import RING, Author


def with_properties(author: Author, element: Any, name: str, **values: Any) -> None:
    singles = [
        author.new("IfcPropertySingleValue", key, None, author.file.create_entity("IfcLabel", value), None)
        for key, value in values.items()
    ]
    held = author.rooted("IfcPropertySet", Name=name, HasProperties=singles)
    author.rooted("IfcRelDefinesByProperties", RelatedObjects=[element], RelatingPropertyDefinition=held)


def whole_column(author: Author, x: float = 0.0, **attributes: Any) -> Any:
    at = author.placement(None, (x, 0.0, 0.0))
    column = author.column(at, **attributes)
    author.sleeves(at)
    author.rebars(at)
    return column


@pytest.mark.parametrize("schema", ["IFC2X3", "IFC4", "IFC4X3"])
@pytest.mark.parametrize("key", ["Mark", "标记", "マーク", "mark"])
def test_the_mark_of_revit_is_the_name_of_a_column(author: Callable[..., Any], schema: str, key: str) -> None:
    model: Author = author(schema=schema)
    for k in range(2):
        name = f"M_Concrete-Rectangular-Column:600 x 600mm:34651{k}"
        column = whole_column(model, 3000.0 * k, Name=name, Tag=f"34651{k}")
        with_properties(model, column, "Identity Data", **{key: f"C-30{k}"})
    read = read_ifc(model.write())
    assert [column.id for column in read.columns] == ["C-300", "C-301"]
    for key_of_one in ("C-301", "346511", "M_Concrete-Rectangular-Column:600 x 600mm:346511"):
        assert read.column(key_of_one) is read.columns[1]


def test_a_mark_of_the_type_is_no_name_of_one_column(author: Callable[..., Any]) -> None:
    model: Author = author()
    columns = [whole_column(model, 3000.0 * k, Name=f"K-{k}", Tag=f"90{k}") for k in range(2)]
    of_type = model.rooted("IfcColumnType", Name="600 x 600", PredefinedType="COLUMN")
    single = model.new("IfcPropertySingleValue", "Mark", None, model.file.create_entity("IfcLabel", "T-1"), None)
    of_type.HasPropertySets = [model.rooted("IfcPropertySet", Name="Identity Data", HasProperties=[single])]
    model.typed(columns, of_type)
    assert [column.id for column in read_ifc(model.write()).columns] == ["K-0", "K-1"]


@pytest.mark.parametrize(
    "tag",
    [
        "7E0C6A65-2F54-4B1C-9C5B-2D1A3E4F5A6B",
        "{7e0c6a65-2f54-4b1c-9c5b-2d1a3e4f5a6b}",
        "7E0C6A652F544B1C9C5B2D1A3E4F5A6B",
        "ID50d0a3c4-0000-0016-3136-333330343133",
        "346512",
        "0lY6P5Ur90TAQnnnI6wtnb",
        "ID0lY6P5Ur90TAQnnnI6wtnb",
    ],
)
def test_tags_that_programs_make_up_do_not_beat_names(author: Callable[..., Any], tag: str) -> None:
    model: Author = author()
    whole_column(model, Name="CRE - 001", Tag=tag)
    (column,) = read_ifc(model.write()).columns
    assert column.id == "CRE - 001"
    assert read_ifc(model.write()).column(tag).id == "CRE - 001"


@pytest.mark.parametrize("tag", ["C-301", "PC/3", "Z1-KZ-03", "A12", "ID-7", "柱-1"])
def test_tags_that_people_give_do(author: Callable[..., Any], tag: str) -> None:
    model: Author = author()
    whole_column(model, Name="COLUMN", Tag=tag)
    assert read_ifc(model.write()).columns[0].id == tag
    assert not is_machine_made(tag)


def test_elements_of_one_global_id_are_told_apart(author: Callable[..., Any]) -> None:
    """Two columns, a copy each of the other: sleeves, bars and columns share GlobalIds, and none takes the other's."""
    model: Author = author()
    made = [whole_column(model, 3000.0 * k, Name=f"K-{k}", Tag=f"K-{k}") for k in range(2)]
    for ifc_class in ("IfcColumn", "IfcDiscreteAccessory", "IfcReinforcingBar"):
        elements = model.file.by_type(ifc_class)
        half = len(elements) // 2
        for first, second in zip(elements[:half], elements[half:], strict=True):
            second.GlobalId = first.GlobalId
    read = read_ifc(model.write())
    assert [column.id for column in read.columns] == ["K-0", "K-1"]
    assert all(len(column.sleeves) == len(column.rebars) == len(RING) for column in read.columns)
    assert (read.loose_sleeves, read.loose_rebars) == ((), ())
    (warning,) = [w for w in read.warnings if "GlobalId" in w]
    assert warning.startswith("25 GlobalIds are given to several elements")
    assert made[0].GlobalId in warning
    for column in read.columns:
        assert set(column.shared_ids) == {"column", *(p.label for p in (*column.sleeves, *column.rebars))}


def test_one_global_id_for_all_sleeves_of_a_column(author: Callable[..., Any]) -> None:
    model: Author = author()
    whole_column(model, Name="K-1", Tag="K-1")
    sleeves = model.file.by_type("IfcDiscreteAccessory")
    for sleeve in sleeves:
        sleeve.GlobalId = sleeves[0].GlobalId
    (column,) = read_ifc(model.write()).columns
    assert len(column.sleeves) == len(RING)
    assert set(column.shared_ids) == {sleeve.label for sleeve in column.sleeves}


def test_a_model_whose_ids_are_its_own_says_nothing(author: Callable[..., Any]) -> None:
    model: Author = author()
    whole_column(model, Name="K-1", Tag="K-1")
    read = read_ifc(model.write())
    assert read.warnings == ()
    assert read.columns[0].shared_ids == ()
