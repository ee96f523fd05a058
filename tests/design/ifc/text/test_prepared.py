"""Headers, encodings and archives as real exporters write them."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.design.ifc.text.encoding import weigh
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.read import read_model
from aadm_workbench.errors import DesignError
from tests.design.step_yard import RING, Yard, yard


def read(folder: Path, content: str | bytes, name: str = "model.ifc") -> ModelDesign:
    path = folder / name
    path.write_bytes(content.encode("ascii") if isinstance(content, str) else content)
    return read_model(path)


def check_whole(model: ModelDesign, x: float = 0.0, y: float = 0.0) -> None:
    """One column, its eight sleeves and bars where they were drawn."""
    (column,) = model.columns
    T = column.T_model_column
    assert T is not None
    for points, z in ((column.sleeves, 0.0), (column.rebars, 150.0)):
        found = sorted(np.round(T[:3, :3] @ point.centre + T[:3, 3], 3).tolist() for point in points)
        assert found == sorted([x + dx, y + dy, z] for dx, dy in RING)
    assert {point.diameter_mm for point in column.rebars} == {20.0}


@pytest.mark.parametrize(
    ("named", "taken"),
    [
        ("IFC4X3", "IFC4X3_ADD2"),
        ("IFC4X3_ADD1", "IFC4X3_ADD2"),
        ("IFC4X3_RC4", "IFC4X3_ADD2"),
        ("IFC4X3_TC1", "IFC4X3_ADD2"),
        ("IFC4_ADD1", "IFC4"),
        ("IFC4_ADD2", "IFC4"),
        ("IFC4_ADD2_TC1", "IFC4"),
        ("IFC4X2", "IFC4"),
        ("ifc4", "IFC4"),
    ],
)
def test_versions_of_a_schema_are_read_as_one_that_is_known(named: str, taken: str, tmp_path: Path) -> None:
    model = read(tmp_path, yard(Yard(schema=named)))
    check_whole(model)
    assert model.schema == taken
    assert any(f"was read as {taken}" in warning for warning in model.warnings) == (named.upper() != taken)


def test_of_several_schemas_the_one_that_is_known_counts(tmp_path: Path) -> None:
    check_whole(read(tmp_path, yard(Yard(schema="CHECKED','IFC4"))))


def test_the_known_schemas_are_read_without_a_word(tmp_path: Path) -> None:
    for schema in ("IFC4", "IFC4X3_ADD2"):
        model = read(tmp_path, yard(Yard(schema=schema)))
        check_whole(model)
        assert model.warnings == ()


@pytest.mark.parametrize("named", ["IFC5", "IFC2X2_FINAL", "IFC9", "AUTOMOTIVE_DESIGN"])
def test_other_schemas_are_refused_by_name(named: str, tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=rf"{named}.*IFC2X3, IFC4 or IFC4X3"):
        read(tmp_path, yard(Yard(schema=named)))


@pytest.mark.parametrize("schema", [".T.", "$", "()", "IFC4", "''"])
def test_a_header_that_says_no_schema_is_refused(schema: str, tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r"names no schema|names the schema"):
        read(tmp_path, yard().replace("'IFC4'", schema))


@pytest.mark.parametrize(
    "path",
    [
        r"C:\Users\li\three.ifc",
        r"D:\2026\Xref\ramp.ifc",
        "\\\\server\\share\\x.ifc",
        r"C:\项目\柱.ifc",
        "C:\\Projekte\\",
        r"C:\b\n\f\r\t",
    ],
)
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_paths_of_windows_in_the_header(path: str, mark: str, tmp_path: Path) -> None:
    model = read(tmp_path, (mark + yard(Yard(file_name=path))).encode("utf-8"))
    check_whole(model)


def test_headers_with_comments_and_line_breaks_are_read(tmp_path: Path) -> None:
    text = (
        yard()
        .replace("FILE_SCHEMA(('IFC4'));", "/* it's\n new; */ FILE_SCHEMA (\n( 'IFC4X3' ) ) ;")
        .replace("\n", "\r\n")
    )
    check_whole(read(tmp_path, text))


def test_a_backslash_in_a_name_is_a_backslash_and_its_line_is_named(tmp_path: Path) -> None:
    text = yard(Yard(column_tag=r"KZ\A-1"))
    model = read(tmp_path, text)
    check_whole(model)
    assert model.columns[0].id == r"KZ\A-1"
    line = next(k for k, held in enumerate(text.splitlines(), start=1) if "KZ" in held)
    assert any(f"line {line}" in warning and "doubled" in warning for warning in model.warnings)


NAMES = {
    "gb18030": ("预制柱", "斜撑套筒", "灌浆套筒", "插筋"),
    "big5": ("預製柱", "斜撐套筒", "灌漿套筒", "預留鋼筋"),
    "shift_jis": ("プレキャスト柱", "吊りスリーブ", "機械式スリーブ", "差し筋"),
    "utf-8": ("预制柱", "斜撑套筒", "灌浆套筒", "插筋"),
    "cp1252": ("Fertigteilstütze", "Hüllrohr Durchführung", "Hüllrohr für Größe 20", "Anschlussbewehrung für Stütze"),
}
"""A column, a socket that is no grouting sleeve, a sleeve, a bar; the socket's name alone tells it from a sleeve."""


def escaped_bytes(text: str, encoding: str) -> str:
    r"""Every byte of a code page beyond ASCII as ``\X\hh``, second bytes in ASCII as they are, a backslash doubled."""
    content = text.encode(encoding)
    return "".join(f"\\X\\{byte:02X}" if byte > 0x7E else "\\\\" if byte == 0x5C else chr(byte) for byte in content)


@pytest.mark.parametrize("encoding", NAMES)
@pytest.mark.parametrize("how", ["raw", "escaped"])
def test_names_in_the_code_page_of_a_country(encoding: str, how: str, tmp_path: Path) -> None:
    """Bracing sockets of the class of couplers are told from sleeves by their names, whatever these are written in."""
    column, socket, sleeve, bar = NAMES[encoding]
    if how == "escaped":
        column, socket, sleeve, bar = (escaped_bytes(name, encoding) for name in NAMES[encoding])
    for name, is_sleeve in ((sleeve, True), (socket, False)):
        how_drawn = Yard(column_name=column, sleeve_name=name, bar_name=bar, sleeve_class="IFCMECHANICALFASTENER")
        model = read(tmp_path, yard(how_drawn).encode(encoding if how == "raw" else "ascii"))
        assert len(model.columns) == is_sleeve
        if is_sleeve:
            check_whole(model)
            assert NAMES[encoding][0] in model.columns[0].names
        else:
            assert any("no grouting sleeve" in left.reason for left in model.not_taken)
        if (how, encoding) != ("escaped", "cp1252"):  # those bytes are what STEP means by them
            assert any(encoding in warning for warning in model.warnings)


def test_escaped_latin_letters_stay_what_step_says(tmp_path: Path) -> None:
    model = read(tmp_path, yard(Yard(column_name=r"Fertigteilst\X\FCtze \S\V", bar_name=r"F\X\FC\X\DFe")))
    assert "Fertigteilstütze Ö" in model.columns[0].names
    assert model.warnings == ()


def test_step_escapes_of_all_kinds(tmp_path: Path) -> None:
    model = read(tmp_path, yard(Yard(column_name=r"\X2\9884523667F1\X0\ \X4\00009884\X0\\X\E4")))
    assert "预制柱 预ä" in model.columns[0].names
    assert model.warnings == ()


def test_signs_beyond_the_basic_plane_in_raw_names(tmp_path: Path) -> None:
    model = read(tmp_path, yard(Yard(column_name="𠮷柱 Ｃ")).encode("utf-8"))
    assert "𠮷柱 Ｃ" in model.columns[0].names


def test_a_name_cut_in_the_middle_of_a_sign_costs_nothing_else(tmp_path: Path) -> None:
    """Programs that cut names at so many bytes leave half a sign."""
    content = yard(Yard(column_name="预制柱", sleeve_name="斜撑套筒")).encode("gb18030")
    content = content.replace(b"Starter bar", "插筋".encode("gb18030")[:-1])
    model = read(tmp_path, content)
    assert any("gb18030" in warning for warning in model.warnings)
    assert any("斜撑" in left.reason for left in model.not_taken)


@pytest.mark.parametrize("encoding", ["gb18030", "cp950", "cp932"])
def test_second_bytes_that_are_backslashes(encoding: str, tmp_path: Path) -> None:
    r"""In GBK, Big5 and Shift-JIS a second byte may be that of a backslash: 功, 表, ソ."""
    text = {"gb18030": "預製柱 誠", "cp950": "預製柱 功許蓋", "cp932": "プレキャスト柱 表ソ能"}[encoding]
    assert b"\\" in text.encode(encoding)
    model = read(
        tmp_path,
        yard(Yard(column_name=text, sleeve_name="灌漿套筒" if encoding != "cp932" else "スリーブ")).encode(encoding),
    )
    assert text in model.columns[0].names


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        ("斜撑套筒", "gb18030"),
        ("张三的项目 三层", "gb18030"),
        ("斜撐套筒", "cp950"),
        ("許功蓋專案 三樓", "cp950"),
        ("ﾌﾟﾚｷｬｽﾄ柱 ｽﾘｰﾌﾞ", "cp932"),
        ("インサート", "cp932"),
        ("Stütze", "cp1252"),
        ("STÜTZE Ø20 cm²", "cp1252"),
        ("poteau préfabriqué béton", "cp1252"),
        ("프리캐스트 기둥 그라우트 슬리브 철근 콘크리트", "cp949"),
        ("Stütze", "utf-8"),
        ("预制柱", "utf-8"),
        ("スリーブ", "utf-8"),
    ],
)
def test_one_name_is_often_enough(text: str, encoding: str) -> None:
    assert weigh([text.encode(encoding)]).best == encoding


def test_full_width_letters_name_sleeves_and_columns(tmp_path: Path) -> None:
    how = Yard(column_tag="Ｃ－３０１", sleeve_name="ＧＴＱ４Ｚ－２０", sleeve_class="IFCDISCRETEACCESSORY")
    model = read(tmp_path, yard(how).encode("utf-8"))
    check_whole(model)
    for key in ("C-301", "c-301", "Ｃ－３０１", "C–301"):
        assert model.column(key) is model.columns[0]


@pytest.mark.parametrize("inside", ["model.ifc", "folder/Modell.IFC"])
def test_an_ifczip_holds_one_model(inside: str, tmp_path: Path) -> None:
    path = tmp_path / "model.IFCZIP"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("readme.txt", "made by hand")
        archive.writestr(inside, yard(Yard(schema="IFC4X3")))
        archive.writestr("__MACOSX/model.ifc", "no model")
    check_whole(read_model(path))


@pytest.mark.parametrize(
    ("files", "said"),
    [({}, "nothing"), ({"a.ifcxml": "<x/>"}, "a.ifcxml"), ({"a.ifc": "x", "b.ifc": "y"}, r"2 models \(a.ifc, b.ifc\)")],
)
def test_archives_of_none_or_several_models_are_refused(files: dict[str, str], said: str, tmp_path: Path) -> None:
    path = tmp_path / "model.ifczip"
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    with pytest.raises(DesignError, match=said):
        read_model(path)


def test_an_archive_that_bursts_is_not_opened(tmp_path: Path) -> None:
    path = tmp_path / "model.ifczip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("model.ifc", b"\n" * (70 * 2**20))
    with pytest.raises(DesignError, match="not opened"):
        read_model(path)


def test_a_missing_or_broken_archive_is_named(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r"none\.ifczip does not exist"):
        read_model(tmp_path / "none.ifczip")
    (tmp_path / "x.ifczip").write_bytes(b"PK\x03\x04 broken")
    with pytest.raises(DesignError, match=r"x\.ifczip is no zip archive"):
        read_model(tmp_path / "x.ifczip")


def test_one_number_for_two_entities(tmp_path: Path) -> None:
    """The first counts, as references mean it; the second is named and left out."""
    text = yard()
    number = next(line.partition("=")[0] for line in text.splitlines() if "IFCCOLUMN" in line)
    double = f"{number}=IFCWALL('1111111111111111111111',$,'second',$,$,$,$,$,$);\nENDSEC;\nEND-ISO"
    model = read(tmp_path, text.replace("ENDSEC;\nEND-ISO", double))
    check_whole(model)
    assert "IfcWall" not in model.holdings
    assert any(f"the number {number} is given to several entities" in warning for warning in model.warnings)
