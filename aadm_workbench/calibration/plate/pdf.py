"""plate.pdf: the drawing of a plate for a workshop, with its table of places and what the workshop must know."""

from __future__ import annotations

from pathlib import Path

from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.model import Kind
from aadm_workbench.report.drawing.sketch import Circle, Label, Polyline, Shape, Sketch, rectangle
from aadm_workbench.report.pages.pdf_canvas import A4, MM, draw_sketch, pages, write, write_lines
from aadm_workbench.report.words.labels import Language, phrase

_LEFT_MM, _TOP_MM = 15.0, 280.0  # margins on A4: printers reach as far
_SIDE_MM, _WIDTH_MM = 130.0, 180.0  # of the drawing, and of text
_NOTES = ("material", "holes", "pins", "places", "finish", "turn", "measure")
_COLUMNS_MM = (0.0, 18.0, 48.0, 78.0, 108.0)  # of the table: label, x, y, z, diameter
_ROW_MM, _SIZE = 5.2, 9.0  # of the table: height of a row, and size of its text in pt


def write_plate_pdf(plate: Plate, path: Path, language: Language = "en") -> None:
    """Write plate.pdf, whole or not at all.

    Raises
    ------
    MissingDependencyError
        Without the package reportlab.
    AadmError
        Where the file cannot be written.
    """
    with pages(path, phrase("plate.title").en, "plate.pdf") as canvas:
        assert A4
        write(canvas, (_LEFT_MM * MM, _TOP_MM * MM), _said("title", language), 16.0, bold=True)
        write(canvas, (_LEFT_MM * MM, (_TOP_MM - 7.0) * MM), plate.name, 10.0)
        at = (_LEFT_MM * MM, (_TOP_MM - 12.0 - _SIDE_MM) * MM)
        draw_sketch(canvas, plate_sketch(plate), at, _SIDE_MM * MM)
        y = at[1] - 8.0 * MM
        for name in _NOTES:
            values = {"size": plate.size_mm, "thickness": plate.thickness_mm, "bore": plate.bore_mm}
            values |= {"height": plate.pin_height_mm, "hole": plate.diameter_mm(Kind.SLEEVE)}
            said = phrase(f"plate.{name}", **values, pin=plate.diameter_mm(Kind.REBAR)).in_language(language)
            y = write_lines(canvas, (_LEFT_MM * MM, y), f"– {said}", 10.0, _WIDTH_MM * MM) - 1.0 * MM
        canvas.showPage()
        _table(canvas, plate, language)
        canvas.showPage()


def _said(name: str, language: Language) -> str:
    return phrase(f"plate.{name}").in_language(language)


def _table(canvas: object, plate: Plate, language: Language) -> None:
    heads = (_said("label", language), "x, mm", "y, mm", "z, mm", "Ø, mm")
    rows = [
        (one.label, f"{one.x_mm:.3f}", f"{one.y_mm:.3f}", f"{one.z_mm:.3f}", f"{one.diameter_mm:.3f}")
        for one in plate.places
    ]
    for number, row in enumerate([heads, *rows]):
        y = (_TOP_MM - number * _ROW_MM) * MM
        for at, text in zip(_COLUMNS_MM, row, strict=True):
            write(canvas, ((_LEFT_MM + at) * MM, y), text, _SIZE, bold=number == 0)


def plate_sketch(plate: Plate) -> Sketch:
    """The plate as the camera sees it, in mm: outline, holes, pins, labels, and the corner that has no pin."""
    half = plate.size_mm / 2.0
    shapes: list[Shape] = [rectangle((0.0, 0.0), (plate.size_mm, plate.size_mm), "outline")]
    for one in plate.places:
        at = (one.x_mm + half, one.y_mm + half)
        shapes.append(Circle(at, one.diameter_mm / 2.0, "design" if one.kind is Kind.SLEEVE else "bar"))
        shapes += [Polyline(((at[0] - 30.0, at[1]), (at[0] + 30.0, at[1])), "axis")]
        shapes += [Polyline(((at[0], at[1] - 30.0), (at[0], at[1] + 30.0)), "axis")]
        shapes.append(Label((at[0] + 24.0, at[1] + 22.0), one.label, 14.0))
    pins = plate.centres(Kind.REBAR)
    corner = (float(pins[:, 0].max()) + half, float(pins[:, 1].max()) + half)
    shapes.append(Circle(corner, plate.diameter_mm(Kind.REBAR), "limit"))
    shapes.append(Label((half, plate.size_mm - 20.0), "TOP 上", 18.0, bold=True))
    return Sketch(plate.size_mm, plate.size_mm, tuple(shapes))
