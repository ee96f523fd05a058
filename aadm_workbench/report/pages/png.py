"""A page as a picture, for viewers that show no PDF: drawn as PDF, with its font and its sketches, then made pixels."""

from __future__ import annotations

import io
from collections.abc import Callable
from importlib import import_module
from typing import Any

import cv2

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.report.pages.pdf_canvas import reportlab


def png_of(draw: Callable[[Any], None], width: int, height: int, needed_for: str) -> bytes:
    """What is drawn on a canvas of so many points as PNG, a pixel each; the same drawing gives the same bytes.

    Raises
    ------
    MissingDependencyError
        Without the packages reportlab and pypdfium2.
    """
    try:
        pdfium: Any = import_module("pypdfium2")
    except ImportError as error:
        raise MissingDependencyError("pypdfium2", needed_for) from error
    content = io.BytesIO()
    canvas = reportlab("pdfgen.canvas", needed_for).Canvas(content, pagesize=(width, height), invariant=1)
    draw(canvas)
    canvas.save()
    with pdfium.PdfDocument(content.getvalue()) as document:
        pixels = document[0].render(scale=1).to_numpy()
    written, picture = cv2.imencode(".png", pixels, [cv2.IMWRITE_PNG_COMPRESSION, 6])
    assert written, "OpenCV always writes an 8-bit image as PNG"
    return bytes(picture)
