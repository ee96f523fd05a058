"""A plate: its places, its file, the table that replaces them, and its drawings."""

import re
from collections import Counter
from itertools import pairwise
from math import pi
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.calibration.plate.dxf import plate_dxf
from aadm_workbench.calibration.plate.file import read_plate, write_plate
from aadm_workbench.calibration.plate.pdf import write_plate_pdf
from aadm_workbench.calibration.plate.plate import Plate, drawn_plate
from aadm_workbench.calibration.plate.step import plate_step, write_plate_step
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Kind
from batch.main import main
from tests.conftest import FreeCADRunner

HEAD = "label,x_mm,y_mm,z_mm,diameter_mm,u_mm\n"


@pytest.fixture(scope="module")
def plate() -> Plate:
    return drawn_plate(12, 36.0, 160.0, 20.0)


def test_a_plate_has_its_holes_in_a_ring_and_a_corner_without_a_pin(plate: Plate) -> None:
    holes, pins = plate.centres(Kind.SLEEVE), plate.centres(Kind.REBAR)
    assert len(holes) == 12
    assert np.abs(holes[:, :2]).max(axis=1) == pytest.approx(240.0)
    assert holes[:, :2].mean(axis=0) == pytest.approx([0.0, 0.0])
    assert len(pins) == 7
    turned = {tuple(np.round([-y, x], 6) + 0.0) for x, y, _ in pins}
    assert turned != {tuple(np.round([x, y], 6) + 0.0) for x, y, _ in pins}
    assert np.linalg.norm(holes[:, None, :2] - pins[None, :, :2], axis=2).min() == pytest.approx(80.0 * 2**0.5)


@pytest.mark.parametrize(("holes", "pitch"), [(10, 160.0), (8, 160.0), (12, 60.0)])
def test_what_cannot_be_made_is_refused(holes: int, pitch: float) -> None:
    with pytest.raises(DesignError):
        drawn_plate(holes, 36.0, pitch, 20.0)


def test_a_plate_grows_with_heat_as_aluminium_does(plate: Plate) -> None:
    warm = plate.at(30.0)
    spans = [np.ptp(one.centres(Kind.SLEEVE)[:, 0]) for one in (plate, warm)]
    assert spans[1] - spans[0] == pytest.approx(480.0 * 23.8e-6 * 10.0)


def test_its_file_says_the_same(plate: Plate, tmp_path: Path) -> None:
    write_plate(plate, tmp_path / "plate.toml")
    read = read_plate(tmp_path / "plate.toml")
    assert read.places == plate.places
    assert not read.calibrated


def test_a_table_replaces_the_places(plate: Plate, tmp_path: Path) -> None:
    write_plate(plate, tmp_path / "plate.toml")
    text = (tmp_path / "plate.toml").read_text()
    (tmp_path / "plate.toml").write_text('table = "t.csv"\n' + text)
    rows = [f"{one.label},{one.x_mm + 0.1},{one.y_mm},{one.z_mm},{one.diameter_mm},0.004" for one in plate.places]
    (tmp_path / "t.csv").write_text(HEAD + "\n".join(rows[1:]) + "\n")
    read = read_plate(tmp_path / "plate.toml")
    assert read.calibrated
    assert [one.label for one in read.places] == [one.label for one in plate.places[1:]]
    assert read.places[0].x_mm == pytest.approx(plate.places[1].x_mm + 0.1)
    assert {one.u_mm for one in read.places} == {0.004}
    swapped = [f"{one.label},{one.y_mm},{one.x_mm},{one.z_mm},{one.diameter_mm},0.004" for one in plate.places]
    (tmp_path / "t.csv").write_text(HEAD + "\n".join(swapped) + "\n")
    with pytest.raises(DesignError, match="check rows, axes and unit"):
        read_plate(tmp_path / "plate.toml")
    (tmp_path / "t.csv").write_text(HEAD + "H1,a,0,0,36,0.004\n")
    with pytest.raises(DesignError, match="line 2"):
        read_plate(tmp_path / "plate.toml")


def test_what_is_no_plate_is_refused(tmp_path: Path) -> None:
    (tmp_path / "no.toml").write_text("schema = 1\n")
    with pytest.raises(DesignError, match=r"no\.toml.*aadm camera plate"):
        read_plate(tmp_path / "no.toml")


def test_the_drawing_for_the_machine_has_every_circle(plate: Plate) -> None:
    """Read by pairs of lines, as the format's reference has it."""
    lines = plate_dxf(plate).splitlines()
    pairs = [(int(code), value) for code, value in zip(lines[::2], lines[1::2], strict=True)]
    starts = [k for k, (code, _) in enumerate(pairs) if code == 0] + [len(pairs)]
    shapes = [(pairs[a][1], dict(pairs[a + 1 : b])) for a, b in pairwise(starts)]
    circles = [(one[8], float(one[10]), float(one[20]), 2 * float(one[40])) for name, one in shapes if name == "CIRCLE"]
    layers = {Kind.SLEEVE: "HOLES", Kind.REBAR: "PINS"}
    assert circles == [(layers[one.kind], one.x_mm, one.y_mm, one.diameter_mm) for one in plate.places]
    assert sum(name == "LINE" for name, _ in shapes) == 4
    assert pairs[-1] == (0, "EOF")


def test_the_solids_for_the_machine_are_closed(plate: Plate) -> None:
    """In a closed shell every edge is walked once each way, and every entity that is named is there once."""
    text = plate_step(plate)
    named = re.findall(r"^#(\d+)=", text, re.MULTILINE)
    assert named == [str(number) for number in range(1, len(named) + 1)]
    assert all(int(number) <= len(named) for number in re.findall(r"#(\d+)", text))
    walked = Counter(re.findall(r"ORIENTED_EDGE\('',\*,\*,(#\d+),\.(.)\.\)", text))
    edges = re.findall(r"^(#\d+)=EDGE_CURVE", text, re.MULTILINE)
    assert walked == Counter({(edge, way): 1 for edge in edges for way in "TF"})
    assert text.count("MANIFOLD_SOLID_BREP") == 1 + len(plate.of(Kind.REBAR))


@pytest.mark.freecad
def test_another_kernel_finds_the_plate_in_its_step_file(plate: Plate, freecad: FreeCADRunner, tmp_path: Path) -> None:
    write_plate_step(plate, tmp_path / "plate.step")
    found = freecad.run(
        f"import Part\nshape = Part.read({str(tmp_path / 'plate.step')!r})\n"
        "result['valid'] = shape.isValid()\n"
        "result['volumes'] = [solid.Volume for solid in shape.Solids]\n"
        "sides = [one for one in shape.Solids[0].Faces if 'Cylinder' in one.Surface.TypeId]\n"
        "result['holes'] = [[*one.Surface.Center[:2], 2 * one.Surface.Radius] for one in sides]\n"
    )
    through = sum(pi / 4.0 * one.diameter_mm**2 for one in plate.places) * plate.thickness_mm
    pin = pi / 4.0 * 20.0**2 * (plate.pin_height_mm + plate.thickness_mm)
    assert found["valid"]
    assert found["volumes"] == pytest.approx([600.0**2 * 20.0 - through] + 7 * [pin])
    drawn = [[one.x_mm, one.y_mm, one.diameter_mm] for one in plate.places]
    assert np.array(sorted(found["holes"])) == pytest.approx(np.array(sorted(drawn)))


def test_the_drawing_for_the_workshop_holds_every_place(plate: Plate, tmp_path: Path) -> None:
    pdfium = pytest.importorskip("pypdfium2")
    write_plate_pdf(plate, tmp_path / "plate.pdf", "zh")
    document = pdfium.PdfDocument(tmp_path / "plate.pdf")
    text = "".join(page.get_textpage().get_text_bounded() for page in document)
    assert len(document) == 2
    assert all(f"{one.x_mm:.3f}" in text and one.label in text for one in plate.places)
    assert "相机标定板" in text


def test_the_command_draws_it(tmp_path: Path) -> None:
    assert main(["camera", "plate", "--holes", "16", "--out", str(tmp_path / "p"), "--quiet"]) == 0
    assert {path.name for path in (tmp_path / "p").iterdir()} == {
        "plate.toml",
        "plate.dxf",
        "plate.step",
        "plate.pdf",
    }
