"""report.pdf: the same words and numbers as HTML, its font embedded, Chinese everywhere, quick for a floor."""

import re
from pathlib import Path
from typing import Any

import pypdf
import pytest

from aadm_workbench.report.pages.html import html_text
from aadm_workbench.report.pages.pdf import write_pdf
from aadm_workbench.report.pages.pdf_text import lines_of, printable, width_of
from tests.report.checked_floor import HOSTILE
from tests.report.typed import typed


def text_of(path: Path) -> str:
    """All text of a PDF, white space closed up."""
    return re.sub(r"\s+", "", "".join(page.extract_text() for page in pypdf.PdfReader(path).pages))


def fonts_of(path: Path) -> dict[str, bool]:
    """Whether each font that some page uses is embedded."""
    found: dict[str, bool] = {}
    for page in pypdf.PdfReader(path).pages:
        content = page.get_contents()
        used = set(re.findall(rb"/(\S+) [\d.]+ Tf", content.get_data() if content is not None else b""))
        for name, font in page["/Resources"]["/Font"].items():
            font = font.get_object()
            if name[1:].encode() in used and "Helvetica" not in str(font["/BaseFont"]):
                found[str(font["/BaseFont"])] = "/FontFile2" in font["/FontDescriptor"].get_object()
    return found


@pytest.mark.parametrize("language", ["en", "zh"])
def test_words_and_numbers(floor: dict[str, Any], tmp_path: Path, language: str) -> None:
    write_pdf(typed(floor), tmp_path / "report.pdf", language)
    text = text_of(tmp_path / "report.pdf")
    headline = "5 of 8 columns must not be hoisted" if language == "en" else "8根柱中有5根不得吊装"
    assert re.sub(r"\s", "", headline) in text
    for column in floor["columns"]:
        for kind in ("sleeves", "rebars"):
            for point in (column[kind] or {}).get("points", ()):
                if point["deviation_mm"]:
                    assert f"{point['deviation_mm']:.2f}" in text
    if language == "en":
        for column in floor["columns"]:
            assert all(re.sub(r"\s", "", reason) in text for reason in column["reasons"])
    assert re.sub(r"\s", "", HOSTILE) in text
    assert floor["model"]["sha256"] in text
    assert ("unverified" if language == "en" else "未核对") in text


def test_font_is_embedded(floor: dict[str, Any], tmp_path: Path) -> None:
    write_pdf(typed(floor), tmp_path / "report.pdf", "zh")
    fonts = fonts_of(tmp_path / "report.pdf")
    assert fonts
    assert all(fonts.values())
    assert all("WenQuanYi" in name for name in fonts)


def test_same_bytes_a4_and_outline(floor: dict[str, Any], tmp_path: Path) -> None:
    for name in ("a.pdf", "b.pdf"):
        write_pdf(typed(floor), tmp_path / name)
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()
    reader = pypdf.PdfReader(tmp_path / "a.pdf")
    assert {(round(page.mediabox.width), round(page.mediabox.height)) for page in reader.pages} == {(595, 842)}
    titles = [entry.title for entry in reader.outline if not isinstance(entry, list)]
    assert [title for title in titles if title.startswith("C-")] == ["C-5", "C-3", "C-2", "C-4", "C-7", "C-1", "C-6"]


def test_long_names_and_unknown_signs(floor: dict[str, Any], tmp_path: Path) -> None:
    floor["columns"][0]["id"] = "C-" + "9" * 300
    floor["columns"][1]["id"] = "🏗 𠮷 \x07"
    floor["columns"][2]["reasons"] = ["很长的原因" * 400]
    write_pdf(typed(floor), tmp_path / "report.pdf")
    assert "很长的原因" * 20 in text_of(tmp_path / "report.pdf")


def test_lines_break_between_words_and_chinese_characters() -> None:
    text = "GB/T 51231-2016 装配式混凝土建筑技术标准 supercalifragilisticexpialidocious 套筒。"
    lines = lines_of(text, 10.0, 90.0)
    assert len(lines) > 4
    assert all(width_of(line, 10.0) <= 91.0 for line in lines)
    assert "".join(lines).replace(" ", "") == text.replace(" ", "")
    assert not any(line.startswith(("。", ",")) for line in lines)
    assert printable("✗ 柱 🏗") == "× 柱 □"


@pytest.mark.parametrize("width", range(40, 300, 7))
def test_what_takes_a_sign_along_to_the_next_line_is_a_word(width: int) -> None:
    text = "S6–S7 间距与设计相差 -2.02 mm，限值 ±2 mm（T/CCES 30-2022，4.3.3）：不确定度 0.07 mm，过于接近限值"
    lines = lines_of(text, 12.0, float(width))
    assert "".join(lines).replace(" ", "") == text.replace(" ", "")
    assert not any(line.startswith(("，", "）", "：")) for line in lines)
    if width > 60:  # T/CCES is wider than less
        assert sum(line.count("mm") for line in lines) == 3


def page_texts(path: Path) -> list[str]:
    return [re.sub(r"\s+", "", page.extract_text()) for page in pypdf.PdfReader(path).pages]


def test_the_first_page_says_what_to_do_and_can_be_signed(floor: dict[str, Any], tmp_path: Path) -> None:
    write_pdf(typed(floor), tmp_path / "report.pdf")
    first = page_texts(tmp_path / "report.pdf")[0]
    for said in (
        "2026-11-20",
        "Checkedby(name)",
        "Signature",
        "Whattodo:",
        "BendbarR",
        "onlyaftertheengineer'srelease",
    ):
        assert said in first
    assert first.index("mustnotbehoisted") < first.index("Signature") < first.index("Whattodo:")


def test_no_last_page_holds_two_lines(floor: dict[str, Any], tmp_path: Path) -> None:
    """Whatever the number of notes, a column's last page is no remnant; the last page of all is none either."""
    column = floor["columns"][1]
    for notes in range(0, 24, 4):
        column["notes"] = [f"note {number}" for number in range(notes)]
        write_pdf(typed(floor | {"columns": [column]}), tmp_path / "report.pdf")
        assert all(len(text) > 250 for text in page_texts(tmp_path / "report.pdf"))


@pytest.mark.parametrize("language", ["en", "zh"])
def test_many_columns_without_a_place(floor: dict[str, Any], tmp_path: Path, language: Any) -> None:
    """More tiles than fit on a page, and texts that fill several: every column has its page all the same."""
    bare = {"sleeves": None, "rebars": None, "trial_assembly": None, "T_model_column": None, "repair": None}
    columns = [floor["columns"][4] | bare | {"id": f"K-{number:03d}"} for number in range(330)]
    columns[0]["reasons"] = ["很长的原因，" * 900, *(f"reason {number}" for number in range(200))]
    write_pdf(typed(floor | {"columns": columns}), tmp_path / "report.pdf", language)
    titles = [entry.title for entry in pypdf.PdfReader(tmp_path / "report.pdf").outline if not isinstance(entry, list)]
    assert sum(title.startswith("K-") for title in titles) == 330


def test_columns_without_measurements_share_pages(floor: dict[str, Any], tmp_path: Path) -> None:
    """Two lines are no page; whatever was measured begins on a page of its own."""
    error = floor["columns"][4]
    many = [error | {"id": f"E-{number}"} for number in range(8)]
    write_pdf(typed(floor | {"columns": [*floor["columns"][:2], *many]}), tmp_path / "report.pdf")
    reader = pypdf.PdfReader(tmp_path / "report.pdf")
    entries = [entry for entry in reader.outline if not isinstance(entry, list)]
    begins = {entry.title: reader.get_destination_page_number(entry) for entry in entries}
    assert len({begins[f"E-{number}"] for number in range(8)}) == 1
    assert begins["E-0"] < begins["C-2"] < begins["C-1"]


def test_chinese_pages_have_chinese_colons(floor: dict[str, Any], tmp_path: Path) -> None:
    """No half-width colon behind a Chinese word, in what this product says itself; names of people stay."""
    floor["job"]["name"] = floor["capture"]["operator"] = "N"
    write_pdf(typed(floor), tmp_path / "report.pdf", "zh")
    shown = {"report.pdf": text_of(tmp_path / "report.pdf")}
    shown["report.html"] = re.sub(
        r"<(script|style).*?</\1>|<[^>]*>", "", html_text(typed(floor), "zh"), flags=re.DOTALL
    )
    for name, text in shown.items():
        assert re.findall(r"[\u4e00-\u9fff]:.{0,9}", text) == [], name
