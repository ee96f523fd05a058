"""Whom to ask about a scan that was opened: where there is a window, it puts its panel here when FreeCAD starts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

SCAN_PANELS: list[Callable[[Any, list[Path]], None]] = []
"""At most one: it opens for a document and files. A person can say there what a file does not: unit, camera, up."""
