"""The Chinese font that ships with the reports, so that they read the same on machines that have none."""

from __future__ import annotations

import base64
import io
from importlib import import_module
from pathlib import Path
from typing import Any

from aadm_workbench.errors import MissingDependencyError

FONT_FILE = Path(__file__).resolve().parents[2] / "resources" / "fonts" / "wqy-microhei-subset.ttf"

_FIRST_FOREIGN = 0x2E80
"""From the radicals on: what Western fonts lack."""


def embedded_font_css(text: str) -> str:
    """A ``@font-face`` that holds the Chinese characters of a text alone; the reader's own fonts come before it.

    Raises
    ------
    MissingDependencyError
        Without the package fonttools.
    """
    characters = sorted({ord(sign) for sign in text if ord(sign) >= _FIRST_FOREIGN})
    if not characters:
        return ""
    packed = base64.b64encode(_subset(characters)).decode()
    return f'@font-face{{font-family:AADM;src:url(data:font/woff;base64,{packed}) format("woff")}}\n'


def _subset(characters: list[int]) -> bytes:
    try:
        ttlib: Any = import_module("fontTools.ttLib")
        subset: Any = import_module("fontTools.subset")
    except ImportError as error:
        raise MissingDependencyError("fonttools", "report.html") from error
    options = subset.Options(hinting=False, glyph_names=False, recalc_timestamp=False)
    options.flavor = "woff"
    font = ttlib.TTFont(FONT_FILE, recalcTimestamp=False)
    cutter = subset.Subsetter(options)
    cutter.populate(unicodes=characters)
    cutter.subset(font)
    font.flavor = "woff"
    content = io.BytesIO()
    font.save(content, reorderTables=False)
    return content.getvalue()
