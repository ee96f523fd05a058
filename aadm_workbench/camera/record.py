"""``capture.json`` read again: when, by which camera and with which settings a capture folder was taken."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from aadm_workbench.camera.frame import RECORD_NAME, Setting

_LARGEST_BYTES = 2**20  # hundreds of settings take some ten thousand


@dataclass(frozen=True)
class Record:
    """What stands in ``capture.json``; ``captured_s`` in seconds since 1970, None where it is no time."""

    captured_s: float | None = None
    vendor: str = ""
    model: str = ""
    serial: str = ""
    settings: Mapping[str, Setting] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def record_of(folder: Path) -> Record | None:
    """Return the record of a capture folder; None where there is none that can be read: it is never needed."""
    path = folder / RECORD_NAME
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            return None
        document = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return None
    return _record(document) if isinstance(document, Mapping) else None


def _record(document: Mapping[str, Any]) -> Record:
    settings, notes = document.get("settings"), document.get("notes")
    vendor, model, serial = (str(document.get(key) or "") for key in ("vendor", "model", "serial"))
    return Record(
        _seconds(document.get("captured")),
        vendor,
        model,
        serial,
        {str(key): value for key, value in settings.items() if isinstance(value, str | int | float)}
        if isinstance(settings, Mapping)
        else {},
        tuple(str(note) for note in notes) if isinstance(notes, list) else (),
    )


def _seconds(stamp: Any) -> float | None:
    try:
        when = datetime.fromisoformat(str(stamp))
    except ValueError:
        return None
    return (when if when.tzinfo else when.replace(tzinfo=UTC)).timestamp()
