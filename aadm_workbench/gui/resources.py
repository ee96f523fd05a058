"""Where icons, forms and translations lie."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCADGui

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
ICONS = RESOURCES / "icons"
TRANSLATIONS = RESOURCES / "translations"
FORMS = RESOURCES / "ui"


def icon_path(name: str) -> str:
    """Path of an icon by its name."""
    return str(ICONS / f"{name}.svg")


def icon(name: str) -> Any:
    """An icon for a widget, drawn by FreeCAD itself: Qt alone draws no SVG where its plugin is not installed."""
    return FreeCADGui.getIcon(icon_path(name))
