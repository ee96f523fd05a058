"""Whom to ask about what was opened, and in which language to say what is wrong: a window puts it here at its start."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

JOB_PANELS: list[Callable[[Any, Path], None]] = []
"""At most one: it opens for a document and a job file."""

LANGUAGES: list[Callable[[str], str]] = []
"""At most one: it puts a sentence into the language of the window."""

SCAN_PANELS: list[Callable[[Any, list[Path]], None]] = []
"""At most one: it opens for a document and files. A person can say there what a file does not: unit, camera, up."""
