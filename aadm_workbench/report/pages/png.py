"""A page as a picture, for viewers that show no PDF: drawn as PDF, with its font and its sketches, then made pixels."""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Callable
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.report.pages.pdf_text import reportlab

_KEPT_BITS = 3  # of each channel: what is drawn has a dozen colours, and seven steps from each to white at its edges
_MOST_COLOURS = 256  # of a palette (PNG, 11.2.2)


def png_of(draw: Callable[[Any], None], width: int, height: int, needed_for: str, scale: float = 1.0) -> bytes:
    """What is drawn on a canvas of so many points as PNG, ``scale`` pixels each; the same drawing, the same bytes.

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
        pixels = document[0].render(scale=scale, rev_byteorder=True).to_numpy()
    return paletted_png(pixels)


def paletted_png(pixels: NDArray[np.uint8]) -> bytes:
    """An RGB picture (h, w, 3) as PNG with a palette: a third of the bytes, and of the time, of all its colours."""
    kept = pixels >> (8 - _KEPT_BITS)
    code = (kept[..., 0].astype(np.uint16) << 2 * _KEPT_BITS) | (kept[..., 1] << _KEPT_BITS) | kept[..., 2]
    count = np.bincount(code.ravel(), minlength=1 << 3 * _KEPT_BITS)
    used = np.argsort(-count, kind="stable")[: min(int((count > 0).sum()), _MOST_COLOURS)]
    number = np.zeros(len(count), dtype=np.uint8)
    steps = np.arange(1 << _KEPT_BITS)
    channels = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    rest = np.flatnonzero(count)
    apart = np.abs(channels[rest][:, None, :] - channels[used][None, :, :]).sum(axis=2)
    number[rest] = apart.argmin(axis=1)
    palette = (channels[used] * 255 // steps[-1]).astype(np.uint8)
    # Each row begins with its filter: none, which packs drawings best.
    rows = np.pad(number[code], ((0, 0), (1, 0)))
    high, wide = code.shape
    head = struct.pack(">IIBBBBB", wide, high, 8, 3, 0, 0, 0)
    parts = ((b"IHDR", head), (b"PLTE", palette.tobytes()), (b"IDAT", zlib.compress(rows.tobytes(), 6)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(name, held) for name, held in parts)


def _chunk(name: bytes, held: bytes) -> bytes:
    return struct.pack(">I", len(held)) + name + held + struct.pack(">I", zlib.crc32(name + held))
