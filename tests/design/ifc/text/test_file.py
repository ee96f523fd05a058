"""Files that are no complete IFC model are refused with the place and the reason."""

import os
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.design.ifc.text.file import open_ifc
from aadm_workbench.design.read import read_model
from aadm_workbench.errors import DesignError


@pytest.fixture
def model(author: Callable[..., Any]) -> Path:
    started = author()
    started.column(started.placement(), Name="C-1")
    path: Path = started.write()
    return path


def refused(path: Path, content: bytes | None, capfd: pytest.CaptureFixture[str]) -> str:
    """What the error says; nothing may leak to the terminal."""
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(DesignError) as caught:
        open_ifc(path)
    assert capfd.readouterr() == ("", "")
    assert str(path) in str(caught.value)
    return str(caught.value)


def test_units(author: Callable[..., Any]) -> None:
    for unit, mm in {"mm": 1.0, "m": 1000.0, "foot": 304.8}.items():
        assert open_ifc(author(unit=unit).write()).mm == pytest.approx(mm, rel=1e-15)


def test_doubled_header(model: Path, capfd: pytest.CaptureFixture[str]) -> None:
    said = refused(model, b"ISO-10303-21;\n" + model.read_bytes(), capfd)
    assert "line 2" in said
    assert "'ISO-10303-21;'" in said
    assert "'HEADER;'" in said


def test_missing(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert "does not exist" in refused(tmp_path / "none.ifc", None, capfd)


def test_folder(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert "is a folder" in refused(tmp_path, None, capfd)


@pytest.mark.parametrize("content", [b"", b"\n \n"])
def test_empty(tmp_path: Path, content: bytes, capfd: pytest.CaptureFixture[str]) -> None:
    assert "is empty" in refused(tmp_path / "empty.ifc", content, capfd)


def test_zip(tmp_path: Path, model: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "packed.ifc"
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(model, "model.ifc")
    assert "zip" in refused(path, None, capfd)


def test_xml(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert "XML" in refused(tmp_path / "x.ifc", b'<?xml version="1.0"?><ifc/>', capfd)


def test_something_else(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert "line 3" in refused(tmp_path / "x.ifc", b"/* first\n second */\nsolid column\nfacet", capfd)


def test_nothing_behind_the_first_line(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert "line 3 reads ''" in refused(tmp_path / "x.ifc", b"ISO-10303-21;\n\n", capfd)


@pytest.mark.parametrize("name", ["a.ifc", "a.FCStd", "a.step", "a.stl"])
def test_what_is_no_file_is_not_waited_for(tmp_path: Path, name: str) -> None:
    """A pipe that nobody writes into, a device without an end, a file of more bytes than models have."""
    path = tmp_path / name
    os.mkfifo(path)
    with pytest.raises(DesignError, match="is a device or a pipe: name the model's file"):
        read_model(path)
    path.unlink()
    path.symlink_to("/dev/zero")
    with pytest.raises(DesignError, match="is a device or a pipe"):
        read_model(path)
    path.unlink()
    path.touch()
    os.truncate(path, 2**31 + 1)
    with pytest.raises(DesignError, match="has 2147483649 bytes, more than 2147483648"):
        read_model(path)


def test_binary(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert "line 1" in refused(tmp_path / "x.ifc", bytes(range(128, 256)) * 9, capfd)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.9, 0.99])
def test_cut_short(model: Path, share: float, capfd: pytest.CaptureFixture[str]) -> None:
    """A copy that broke off is no smaller model."""
    content = model.read_bytes()
    said = refused(model, content[: int(share * len(content))], capfd)
    assert "cut short" in said
    assert "line" in said


def test_unknown_schema(model: Path, capfd: pytest.CaptureFixture[str]) -> None:
    said = refused(model, model.read_bytes().replace(b"('IFC4')", b"('IFC9')"), capfd)
    assert "IFC9" in said


def test_no_units(model: Path, capfd: pytest.CaptureFixture[str]) -> None:
    lines = [line for line in model.read_text().splitlines() if ".LENGTHUNIT." not in line]
    assert "no unit of length" in refused(model, "\n".join(lines).encode(), capfd)


def test_a_line_that_is_no_entity_is_named(model: Path) -> None:
    """The rest is read; the warning names the line."""
    lines = model.read_text().splitlines()
    lines.insert(len(lines) - 2, "#9999=IFCNOSUCHTHING('x');")
    model.write_text("\n".join(lines))
    (warning,) = open_ifc(model).warnings
    assert f"line {len(lines) - 2}:" in warning
    assert "IFCNOSUCHTHING" in warning


@pytest.mark.parametrize("encoding", ["utf-8", "gb18030"])
def test_names_in_raw_bytes(model: Path, encoding: str) -> None:
    """Some programs write Chinese names without STEP's escapes."""
    model.write_bytes(model.read_bytes().replace(b"'C-1'", "'预制柱 C-1'".encode(encoding)))
    opened = open_ifc(model)
    assert opened.file.by_type("IfcColumn")[0].Name == "预制柱 C-1"
    assert encoding in opened.warnings[0]


@pytest.mark.parametrize("name", ["model.dwg", "model.rvt", "column.3dm", "model"])
def test_other_formats_are_not_supported(tmp_path: Path, name: str) -> None:
    with pytest.raises(DesignError, match=r"not supported.*\.ifc"):
        read_model(tmp_path / name)
