"""Whom to ask about a scan or a job that was opened: a window puts its panels here when FreeCAD starts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

JOB_PANELS: list[Callable[[Any, Path], None]] = []
"""At most one: it opens for a document and a job file."""

SCAN_PANELS: list[Callable[[Any, list[Path]], None]] = []
"""At most one: it opens for a document and files. A person can say there what a file does not: unit, camera, up."""
