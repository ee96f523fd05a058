"""FreeCAD documents from outside FreeCAD: read by a FreeCAD that is started for it, or refused with the reason."""

import hashlib
import io
import os
import stat
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.design import freecad_program
from aadm_workbench.design.fcstd import check_archive
from aadm_workbench.design.read import read_model
from aadm_workbench.errors import DesignError, MissingDependencyError
from batch.main import main
from tests.conftest import FreeCADRunner, find_freecad

AUTHOR = Path(__file__).parents[1] / "document"
EXACT_MM = 0.001


@pytest.fixture(scope="module")
def document(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A document of a Part column and its bars, as FreeCAD saved it."""
    folder = tmp_path_factory.mktemp("documents")
    runner = FreeCADRunner(find_freecad("freecadcmd", "FreeCADCmd"), folder)
    body = f"import sys\nsys.path.insert(0, {str(AUTHOR)!r})\nimport freecad_author\n"
    runner.run(body + "result['path'], _ = freecad_author.write('part', folder)\n")
    return folder / "part.FCStd"


@pytest.mark.freecad
def test_a_document_is_read_and_left_as_it_was(document: Path) -> None:
    before, names = document.read_bytes(), sorted(path.name for path in document.parent.iterdir())
    model = read_model(document)
    (column,) = model.columns
    assert len(column.sleeves) == len(column.rebars) == 12
    ring = {(round(point.centre[0]), round(point.centre[1])) for point in column.sleeves}
    assert len(ring) == 12
    assert column.sleeves[0].centre == pytest.approx([-240.0, -240.0, 0.0], abs=EXACT_MM)
    assert column.rebars[0].centre == pytest.approx([-240.0, -240.0, 160.0], abs=EXACT_MM)
    assert {round(point.diameter_mm, 3) for point in column.sleeves} == {36.0}, "behind the chamfer of 3 mm"
    assert {round(point.diameter_mm, 3) for point in column.rebars} == {20.0}
    assert model.sha256 == hashlib.sha256(before).hexdigest()
    assert document.read_bytes() == before
    assert sorted(path.name for path in document.parent.iterdir()) == names


@pytest.mark.freecad
def test_holes_of_a_document_by_someone_else(capsys: pytest.CaptureFixture[str]) -> None:
    path = Path(__file__).parents[3] / "shared" / "data" / "fcstd" / "FreeCAD_test_holes00.FCStd"
    if not path.is_file():
        pytest.skip("the models of other people's programs are not beside this repository")
    model = read_model(path)
    assert not model.columns
    assert [round(point.diameter_mm, 6) for point in model.loose_sleeves] == [float(k) for k in range(1, 10)]
    centres = np.array([point.centre for point in model.loose_sleeves])
    assert centres == pytest.approx(np.array([[10.0 * k, 0.0, -10.0] for k in range(1, 10)]), abs=EXACT_MM)
    assert main(["design", str(path), "--quiet"]) == 11
    assert "no column with grouting sleeves" in capsys.readouterr().err


_ADDED = """
import Arch, FreeCAD, Part
document = FreeCAD.newDocument()
column = Arch.makeStructure(length=600, width=600, height=2800)
column.IfcType = "Column"
added = []
for x in (-200.0, 0.0, 200.0):
    for y in (-200.0, 200.0):
        foot = FreeCAD.Vector(x, y, 0.0)
        sleeve = document.addObject("Part::Feature", "Sleeve")
        sleeve.Shape = Part.makeCylinder(24.0, 310.0, foot).cut(Part.makeCylinder(18.0, 310.0, foot))
        sleeve.Label = "灌浆套筒"
        added.append(sleeve)
document.recompute()
Arch.addComponents(added, column)
document.recompute()
document.saveAs(str(folder / "added.FCStd"))
result["holes"] = sum(face.Surface.TypeId == "Part::GeomCylinder" for face in column.Shape.Faces)
"""


@pytest.mark.freecad
def test_sleeves_that_were_added_to_a_structure(tmp_path: Path) -> None:
    """Arch melts additions into the concrete, so that the column's own shape has no hole left."""
    runner = FreeCADRunner(find_freecad("freecadcmd", "FreeCADCmd"), tmp_path)
    assert runner.run(_ADDED)["holes"] == 0
    (column,) = read_model(tmp_path / "added.FCStd").columns
    assert [round(point.diameter_mm, 3) for point in column.sleeves] == [36.0] * 6
    assert column.sleeves[0].centre == pytest.approx([-200.0, -200.0, 0.0], abs=EXACT_MM)


def archive(path: Path, **parts: bytes) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as opened:
        for name, content in parts.items():
            opened.writestr(name.replace("__", "/"), content)
    return path


DOCUMENT = b"<?xml version='1.0' encoding='utf-8'?>\n<Document/>"


def test_an_archive_of_parts_passes(tmp_path: Path) -> None:
    check_archive(archive(tmp_path / "a.FCStd", **{"Document.xml": DOCUMENT, "Shape.brp": b"x" * 1000}))


def test_what_is_no_archive_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.FCStd"
    path.write_bytes(b"ISO-10303-21;\nHEADER;\n")
    with pytest.raises(DesignError, match=r"a\.FCStd is no FreeCAD document"):
        read_model(path)


@pytest.mark.parametrize("kept", [0.3, 0.9, 0.999])
def test_a_truncated_document_is_refused(tmp_path: Path, kept: float) -> None:
    whole = archive(tmp_path / "a.FCStd", **{"Document.xml": DOCUMENT, "Shape.brp": os.urandom(5000)}).read_bytes()
    (tmp_path / "b.FCStd").write_bytes(whole[: int(kept * len(whole))])
    with pytest.raises(DesignError, match=r"b\.FCStd is no FreeCAD document, or is cut short or damaged"):
        read_model(tmp_path / "b.FCStd")


def test_a_damaged_part_is_refused(tmp_path: Path) -> None:
    path = archive(tmp_path / "a.FCStd", **{"Document.xml": DOCUMENT, "Shape.brp": os.urandom(5000)})
    content = bytearray(path.read_bytes())
    content[3000] ^= 0xFF
    path.write_bytes(content)
    with pytest.raises(DesignError, match=r"a\.FCStd (is no FreeCAD document|cannot be unpacked)"):
        check_archive(path)


def test_an_archive_that_would_burst_is_refused(tmp_path: Path) -> None:
    path = archive(tmp_path / "a.FCStd", **{"Document.xml": DOCUMENT, "Shape.brp": bytes(80 * 2**20)})
    with pytest.raises(DesignError, match=r"would unpack to 8\d{7}"):
        check_archive(path)


@pytest.mark.parametrize("name", ["../evil.brp", "/etc/evil.brp", "..\\evil.brp", "C:\\evil.brp", "a/../../evil"])
def test_parts_that_lead_out_are_refused(tmp_path: Path, name: str) -> None:
    path = archive(tmp_path / "a.FCStd", **{"Document.xml": DOCUMENT, name: b"x"})
    with pytest.raises(DesignError, match="leads out of it"):
        check_archive(path)


def test_other_archives_are_refused(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r"without Document\.xml"):
        check_archive(archive(tmp_path / "a.FCStd", **{"word__document.xml": b"x"}))


def test_entities_are_refused(tmp_path: Path) -> None:
    bomb = b"<!DOCTYPE x [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;'>]><Document>&b;</Document>"
    with pytest.raises(DesignError, match="defines entities"):
        check_archive(archive(tmp_path / "a.FCStd", **{"Document.xml": bomb}))


@pytest.mark.parametrize("name", ["a.FCStd", "a.step", "a.brep", "a.stl"])
def test_what_is_not_there_is_said(tmp_path: Path, name: str) -> None:
    with pytest.raises(DesignError, match=r"a\.\w+ does not exist"):
        read_model(tmp_path / name)
    (tmp_path / name).write_bytes(b"")
    with pytest.raises(DesignError, match=r"a\.\w+ is empty"):
        read_model(tmp_path / name)


# FreeCAD itself, played by a script: what happens where it is missing, slow, silent or too old.


@pytest.fixture
def readable(tmp_path: Path) -> Path:
    return archive(tmp_path / "a.FCStd", **{"Document.xml": DOCUMENT})


def program(folder: Path, text: str) -> str:
    path = folder / "freecadcmd"
    # A Python behind the words of a shell: a path with spaces cannot stand in a first line.
    first = f"#!/bin/sh\n'''exec' \"{sys.executable}\" \"$0\" \"$@\"\n' '''\n"
    path.write_text(f"{first}import pathlib, sys, time\n{text}\n", encoding="utf-8")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return str(path)


def test_without_freecad_it_says_what_to_install(readable: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("AADM_FREECADCMD", raising=False)
    monkeypatch.setattr(freecad_program, "_candidates", lambda: iter(()))
    monkeypatch.setattr(freecad_program.shutil, "which", lambda name: None)
    with pytest.raises(MissingDependencyError, match=r"apt-get install freecad.*AADM_FREECADCMD"):
        read_model(readable)


def test_a_wrong_program_is_said(readable: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AADM_FREECADCMD", "/no/such/freecadcmd")
    with pytest.raises(DesignError, match="AADM_FREECADCMD is '/no/such/freecadcmd', which is no program"):
        read_model(readable)


def test_freecad_that_hangs_is_ended(readable: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AADM_FREECADCMD", program(tmp_path, "time.sleep(60)"))
    monkeypatch.setenv("AADM_FREECAD_SECONDS", "0.5")
    with pytest.raises(DesignError, match=r"a\.FCStd: FreeCAD did not finish reading it in 0\.5 seconds"):
        read_model(readable)


def test_freecad_that_crashes_is_said(readable: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AADM_FREECADCMD", program(tmp_path, "print('Segmentation fault'); sys.exit(1)"))
    with pytest.raises(DesignError, match=r"FreeCAD ended without reading it.*Segmentation fault"):
        read_model(readable)


def test_what_freecad_answers_is_checked(readable: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    nonsense = "p = pathlib.Path(sys.argv[1]).parent / 'answer.json'\np.write_text('{\"result\": {\"elements\": 1}}')"
    monkeypatch.setenv("AADM_FREECADCMD", program(tmp_path, nonsense))
    with pytest.raises(DesignError, match="makes no sense"):
        read_model(readable)


def test_freecad_gets_no_python_of_others(readable: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    said = tmp_path / "said"
    monkeypatch.setenv("PYTHONPATH", "/of/others")
    text = f"import os\npathlib.Path({str(said)!r}).write_text(os.environ.get('PYTHONPATH', 'none'))"
    monkeypatch.setenv("AADM_FREECADCMD", program(tmp_path, text))
    with pytest.raises(DesignError):
        read_model(readable)
    assert said.read_text() == "none"


@pytest.mark.parametrize("written", ["soon", "0", "-3", "nan"])
def test_a_limit_that_is_none_is_said(readable: Path, monkeypatch: pytest.MonkeyPatch, written: str) -> None:
    monkeypatch.setenv("AADM_FREECAD_SECONDS", written)
    monkeypatch.setenv("AADM_FREECADCMD", sys.executable)
    with pytest.raises(DesignError, match="must be a number of seconds"):
        read_model(readable)


def test_freecad_is_found_where_installers_put_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    home = tmp_path / "home"
    (home / "Applications").mkdir(parents=True)
    image = home / "Applications" / "FreeCAD_1.0.2-conda-Linux-x86_64-py311.AppImage"
    image.write_bytes(b"")
    image.chmod(0o755)
    monkeypatch.delenv("AADM_FREECADCMD", raising=False)
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(freecad_program, "_FOLDERS", ())
    monkeypatch.setattr(freecad_program, "_PATTERNS", ())
    found = freecad_program.find_freecad()
    assert found.command == (str(image), "freecadcmd")


def test_formats_that_are_not_read_are_named(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r"format \.dwg are not supported\. Supported: \.ifc, \.FCStd, \.step"):
        read_model(tmp_path / "a.dwg")


def test_parts_longer_than_they_say_are_refused(tmp_path: Path) -> None:
    path = archive(tmp_path / "a.FCStd", **{"Document.xml": DOCUMENT + b" " * 5000})
    content = path.read_bytes()
    told = (len(DOCUMENT) + 5000).to_bytes(4, "little")
    assert told in content
    path.write_bytes(content.replace(told, (100).to_bytes(4, "little")))
    assert zipfile.is_zipfile(io.BytesIO(path.read_bytes()))
    with pytest.raises(DesignError, match=r"a\.FCStd"):
        check_archive(path)
