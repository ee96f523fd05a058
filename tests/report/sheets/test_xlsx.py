"""report.xlsx, read back with another library: typed, frozen, filtered, coloured, and without formulas."""

from pathlib import Path
from typing import Any

import openpyxl
import pytest

from aadm_workbench.report.sheets.xlsx import write_xlsx
from tests.report.checked_floor import HOSTILE
from tests.report.typed import typed


@pytest.fixture
def book(floor: dict[str, Any], tmp_path: Path) -> Any:
    floor["columns"][0]["id"] = "=1+1"
    write_xlsx(typed(floor), tmp_path / "report.xlsx")
    return openpyxl.load_workbook(tmp_path / "report.xlsx")


def column_of(sheet: Any, title: str) -> list[Any]:
    titles = [cell.value for cell in sheet[1]]
    return [row[titles.index(title)] for row in sheet.iter_rows(min_row=2, values_only=True)]


def test_a_sheet_per_question(book: Any) -> None:
    assert book.sheetnames[:4] == ["Columns", "Points", "Spacing of neighbours", "Trial assembly"]
    assert {"Rules", "Repair advice", "Inputs", "Mould and batch", "Tolerance profile", "Job"} <= set(book.sheetnames)
    assert book["Points"].max_row == 1 + 6 * 24 + 12
    assert column_of(book["Columns"], "Column")[:3] == ["C-5", "C-3", "C-2"]


def test_typed_numbers_with_units(book: Any, floor: dict[str, Any]) -> None:
    sheet = book["Points"]
    values = [value for value in column_of(sheet, "Deviation, mm") if value is not None]
    assert values
    assert all(isinstance(value, float | int) for value in values)
    names = list(
        zip(column_of(sheet, "Column"), column_of(sheet, "Point"), column_of(sheet, "Deviation, mm"), strict=True)
    )
    for point in floor["columns"][2]["rebars"]["points"]:
        assert ("C-3", point["label"], point["deviation_mm"]) in names
    assert ("C-4", "S8", None) in names
    assert sheet["F2"].number_format == "+0.00;-0.00;0.00"
    share = column_of(book["Columns"], "probability that it goes on")
    assert max(value for value in share if value is not None) <= 1.0


def test_headers_stay_and_filter(book: Any) -> None:
    for name in book.sheetnames[:-1]:
        sheet = book[name]
        assert sheet.freeze_panes == "B2"
        assert sheet.auto_filter.ref is not None
        assert sheet.auto_filter.ref.startswith("A1:")


def test_verdicts_are_coloured_by_what_they_say(book: Any) -> None:
    rules = [rule for ranges in book["Points"].conditional_formatting for rule in ranges.rules]
    assert {rule.formula[0] for rule in rules} >= {'"✓ pass"', '"✗ fail"', '"– not measured"'}
    assert set(column_of(book["Points"], "Verdict")) <= {"✓ pass", "✗ fail", "– not measured", "? inconclusive"}


def test_no_formula_anywhere(book: Any) -> None:
    cells = [cell for sheet in book for row in sheet.iter_rows() for cell in row if cell.value is not None]
    assert len(cells) > 1000
    assert not [cell for cell in cells if cell.data_type == "f"]
    texts = {cell.value for cell in cells if isinstance(cell.value, str)}
    assert {"=1+1", HOSTILE, "=2+5"} <= texts


def test_chinese_and_the_same_bytes(floor: dict[str, Any], tmp_path: Path) -> None:
    for name in ("a.xlsx", "b.xlsx"):
        write_xlsx(typed(floor), tmp_path / name, "zh")
    assert (tmp_path / "a.xlsx").read_bytes() == (tmp_path / "b.xlsx").read_bytes()
    book = openpyxl.load_workbook(tmp_path / "a.xlsx")
    assert book.sheetnames[:2] == ["柱列表", "测点"]
    assert "✗ 不合格" in column_of(book["测点"], "结论")
