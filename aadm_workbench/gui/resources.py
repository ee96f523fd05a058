"""Where icons, forms and translations lie."""

from __future__ import annotations

from pathlib import Path

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
ICONS = RESOURCES / "icons"
TRANSLATIONS = RESOURCES / "translations"
FORMS = RESOURCES / "ui"


def icon_path(name: str) -> str:
    """Path of an icon by its name."""
    return str(ICONS / f"{name}.svg")
