"""The tower of a check: what ``aadm stack`` tells, and what the reports of a job with [stack] show of it."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from aadm_workbench.errors import AadmError

if TYPE_CHECKING:
    from aadm_workbench.design.floor import Floor
    from aadm_workbench.model import JobReport, Profile, StackSettings
    from aadm_workbench.report.ifc.addition import Property
    from aadm_workbench.report.tower import TowerShown
    from aadm_workbench.stack.result import StackPlan

PROFILE = "cn-gbt51231-2016"
"""The profile with limits of erected members; the usual one of a check has none of them."""


def planned(reports: Sequence[JobReport], settings: StackSettings, profile: Profile, model: Path | None) -> StackPlan:
    """The plan of a tower from reports, and from the beams of a model where one is named.

    Raises
    ------
    DesignError
        Where the model cannot be read.
    """
    from aadm_workbench.stack.measured import measured_floor
    from aadm_workbench.stack.plan import plan_stack

    floors = [measured_floor(report) for report in reports]
    return plan_stack(floors, settings, profile, None if model is None else _floor_of(model, _state_of(model)))


@lru_cache(maxsize=1)
def _floor_of(model: Path, state: tuple[int, ...]) -> Floor:
    """The floor of a model, read once as long as the file is the same: table, pages and model tell of one tower."""
    from aadm_workbench.design.ifc.floor import read_floor
    from aadm_workbench.inspection.as_designed import unforeseen_in

    with unforeseen_in(str(model)):
        return read_floor(model)


def _state_of(model: Path) -> tuple[int, ...]:
    """What changes with a file; empty where there is none, which whoever opens it says better."""
    with suppress(OSError):
        status = model.stat()
        return status.st_ino, status.st_size, status.st_mtime_ns
    return ()


@dataclass(eq=False)
class Tower:
    """The tower of a check, for everything that tells of it: planned once, when somebody asks first.

    A model that is no IFC file, or cannot be read, costs beams and heights alone, and that is said. What asks for the
    plan raises JobError where somebody has changed the report's [stack] to what is none.
    """

    report: JobReport
    model: Path | None

    @cached_property
    def plan(self) -> StackPlan | None:
        """The plan; None where the job has no [stack]."""
        from .job.stack import carried_settings

        settings = carried_settings(self.report.job)
        if settings is None:
            return None
        from aadm_workbench.assembly.tolerances import load_profile
        from aadm_workbench.report.words.reasons import in_both_languages
        from aadm_workbench.stack.result import NotFound

        profile = load_profile(PROFILE)
        named = self.model if self.model is not None and self.model.suffix.lower() == ".ifc" else None
        try:
            return planned([self.report], settings, profile, named)
        except AadmError as error:
            unread = NotFound(str(named), in_both_languages(error.reason))
            return replace(planned([self.report], settings, profile, None), not_found=(unread,))

    def shown(self) -> TowerShown | None:
        """What the reports show of it."""
        if self.plan is None:
            return None
        from aadm_workbench.stack.shown import tower_shown  # as below: most jobs have no tower to load it for

        return tower_shown(self.plan)

    def properties(self) -> dict[str, list[Property]]:
        """What the model is told of it."""
        if self.plan is None:
            return {}
        from aadm_workbench.stack.setting import setting_properties

        return setting_properties(self.plan)

    def in_report(self) -> JobReport:
        """The report with the setting of each column."""
        if self.plan is None:
            return self.report
        from aadm_workbench.model.made import changed
        from aadm_workbench.stack.setting import setting_report

        found = {one.measured.id: setting_report(one) for one in self.plan.columns}
        columns = changed(self.report.columns, lambda _, one: replace(one, setting=found[one.id]))
        return replace(self.report, columns=columns)
