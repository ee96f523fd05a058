"""A column that is set: what no scan of bars and sleeves tells of it, and where it comes to stand."""

from __future__ import annotations

from dataclasses import dataclass, fields

from aadm_workbench.model.measured import Vector2, Vector3
from aadm_workbench.model.verdicts import Verdict

_TALL_MM, _PLUMB_MM, _PLUMB_OF_TALL_MM = 6000.0, 5.0, 10.0
"""Verticality of columns and walls up to 6 m and above, GB/T 51231-2016, table 10.4.12 (unverified: recalled)."""


@dataclass(frozen=True)
class StackSettings:
    """``[stack]`` of a job: standard uncertainties, mm, k = 1, of what a trial does not give.

    Parameters
    ----------
    plumb_u_mm
        Of the top against the foot, per axis, once the column is plumbed; None: half of the 5 mm up to 6 m, and of the
        10 mm above, of GB/T 51231-2016, table 10.4.12 (unverified), a limit taken as k = 2.
    fit_u_mm
        Of where the column comes to stand in its play against where it was guided to, per axis; also of its concrete
        against its sleeves. A choice: a third of the 3 mm between bar and sleeve.
    bars_u_mm
        Of the bars in the head of a column, as a group, against its foot, per axis: half of the 2 mm of GB/T
        51231-2016, table 9.7.4-3 (unverified), a limit taken as k = 2.
    level_u_mm
        Of the height at which the column comes to stand, that of its top with it: half of the 5 mm that GB/T
        51231-2016, table 10.4.12 (unverified), gives the top or the bottom of an erected member, k = 2. Better known
        are shims alone; how long the column is, no scan of its foot tells.
    braced
        Whether braces plumb each column anew; else it leans as the one below it leans, and its own lean is added.
    height_mm
        Of columns of which no model says it.
    """

    plumb_u_mm: float | None = None
    fit_u_mm: float = 1.0
    bars_u_mm: float = 1.0
    level_u_mm: float = 2.5
    braced: bool = True
    height_mm: float | None = None

    def plumb_at(self, height_mm: float) -> float:
        """``plumb_u_mm`` of a column of that height, mm."""
        if self.plumb_u_mm is not None:
            return self.plumb_u_mm
        return (_PLUMB_MM if height_mm <= _TALL_MM else _PLUMB_OF_TALL_MM) / 2.0

    @property
    def text(self) -> str:
        """The lines of their table in a job, which report.json carries among what it says of the job."""
        known = {item.name: getattr(self, item.name) for item in fields(self)}
        return "\n".join(f"{key} = {str(value).lower()}" for key, value in known.items() if value is not None)


@dataclass(frozen=True, slots=True)
class SettingReport:
    """Where a set column comes to stand, and its top: mm and degrees, column frame; None where it is not predicted.

    Parameters
    ----------
    against
        What that is told against: ``control_points`` (the grid), ``storey_below`` (the grid, through the column below)
        or ``bars`` (its own bars alone, nothing is said of the grid).
    foot_mm, yaw_deg
        Displacement of the column from its design place, dx and dy, and its turn.
    top_mm, top_u_mm
        Displacement of its top, dx and dy, and the standard uncertainty per axis.
    top_limit_mm, top_verdict
        What the length of ``top_mm`` was held against, never against bars alone, and how that was decided.
    set_pose
        The pose in its play whose top is nearest to the grid, dx, dy mm and yaw degrees, as a job has it; None without.
    set_pose_top_mm
        How far the top is off then.
    """

    against: str
    foot_mm: Vector2 | None = None
    yaw_deg: float | None = None
    top_mm: Vector2 | None = None
    top_u_mm: float | None = None
    top_limit_mm: float | None = None
    top_verdict: Verdict = Verdict.NOT_MEASURED
    set_pose: Vector3 | None = None
    set_pose_top_mm: float | None = None
