"""The pose of a trial that people are shown: the one that the verdict stands on."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def shown_pose(trial: Mapping[str, Any] | None) -> Any:
    """The best pose of a trial as report.json holds it; minimax in older reports, None without any."""
    known = trial or {}
    return known.get("best") or known.get("minimax")
