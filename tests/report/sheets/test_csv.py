"""report.csv: every value with its limit, readable by Excel, and nothing in it that runs."""

import csv
import io
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.report.sheets.csv import HEADINGS, write_csv
from tests.report.typed import typed

FORMULAS = ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", " =1+1", '=HYPERLINK("http://x")', "\r=1"]


def rows_of(path: Path) -> list[dict[str, str]]:
    content = path.read_bytes()
    assert content.startswith(b"\xef\xbb\xbf"), "Excel takes it for the system's code page"
    return list(csv.DictReader(io.StringIO(content.decode("utf-8-sig"), newline="")))


def test_every_point_spacing_and_pair(floor: dict[str, Any], tmp_path: Path) -> None:
    write_csv(typed(floor), tmp_path / "report.csv")
    rows = rows_of(tmp_path / "report.csv")
    assert tuple(rows[0]) == HEADINGS
    found = {(row["column"], row["question"], row["item"]): row for row in rows}
    assert len(found) == len(rows)
    for column in floor["columns"]:
        for kind in ("sleeves", "rebars"):
            for point in (column[kind] or {}).get("points", ()):
                row = found[column["id"], f"{kind[:-1]}_position", point["label"]]
                assert row["verdict"] == point["verdict"]
                assert row["value_mm"] == ("" if point["deviation_mm"] is None else str(point["deviation_mm"]))
                assert row["clause"] == "T/CCES 30-2022, 4.3.3"
                assert row["clause_source"] == "verified"
    assert float(found["C-3", "trial_minimax", "S1/R1"]["value_mm"]) > 3.0
    assert found["C-3", "trial_least_squares", "S1/R1"]["value_mm"]
    assert found["C-5", "column", ""]["verdict"] == "error"


@pytest.mark.parametrize("name", FORMULAS)
def test_no_formula_from_names(floor: dict[str, Any], tmp_path: Path, name: str) -> None:
    floor["columns"][0]["id"] = name
    floor["columns"][4]["reasons"] = [f"{name}: broken"]
    write_csv(typed(floor), tmp_path / "report.csv")
    rows = rows_of(tmp_path / "report.csv")
    assert any(row["column"] == f"'{name}" for row in rows)
    texts = [row[key] for row in rows for key in ("column", "item", "reason", "clause")]
    assert not [text for text in texts if text.lstrip(" ").startswith(("=", "+", "-", "@", "\t", "\r"))]


def test_numbers_stay_numbers(floor: dict[str, Any], tmp_path: Path) -> None:
    write_csv(typed(floor), tmp_path / "report.csv")
    below_zero = [row["dx_mm"] for row in rows_of(tmp_path / "report.csv") if row["dx_mm"].startswith("-")]
    assert below_zero
    assert all(float(value) < 0.0 for value in below_zero)
