"""What one column is checked from: everything that any process needs for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from aadm_workbench.check import CheckSettings
from aadm_workbench.model import Camera, ColumnDesign

from ..job.model import JobColumn


@dataclass(frozen=True, eq=False)
class ColumnTask:
    """All that is needed to check one column.

    ``folder`` is where relative paths start; ``places`` says where files lie that are not found from there;
    ``design`` None means that the job's model gives none, for the reason ``no_design``. ``others`` are the designs of
    the job that are unlike this one.
    """

    column: JobColumn
    folder: Path
    design: ColumnDesign | None
    settings: CheckSettings
    units: str = "mm"
    camera: Camera | None = None
    depth_scale_mm: float | None = None
    no_design: str = ""
    places: Mapping[str, Path] = field(default_factory=dict)
    others: tuple[ColumnDesign, ...] = ()

    def path_of(self, name: str) -> Path:
        """Where a file lies that the job names."""
        return self.places.get(name, self.folder / name)

    def at(self, places: Mapping[str, Path]) -> ColumnTask:
        """The same task where its files lie elsewhere."""
        return replace(self, places=places)
