"""What no scan of bars and sleeves tells of a column that is set: how plumb, how level, how near to its aim."""

from __future__ import annotations

from dataclasses import dataclass, fields


@dataclass(frozen=True)
class StackSettings:
    """``[stack]`` of a job: standard uncertainties, mm, k = 1, of what a trial does not give.

    Parameters
    ----------
    plumb_u_mm
        Of the top against the foot, per axis, once the column is plumbed: half of the 5 mm of GB/T 51231-2016, table
        10.4.12 (unverified), a limit taken as k = 2.
    fit_u_mm
        Of where the column comes to stand in its play against where it was guided to, per axis; also of its concrete
        against its sleeves. A choice: a third of the 3 mm between bar and sleeve.
    bars_u_mm
        Of the bars in the head of a column, as a group, against its foot, per axis: half of the 2 mm of GB/T
        51231-2016, table 9.7.4-3 (unverified), a limit taken as k = 2.
    level_u_mm
        Of the height of the foot. A choice: shims are levelled to 2 mm, k = 2, before the column comes; the 5 mm of
        GB/T 51231-2016, table 10.4.12 (unverified), are for the finished member.
    braced
        Whether braces plumb each column anew; else it leans as the one below it leans, and its own lean is added.
    height_mm
        Of columns of which no model says it.
    """

    plumb_u_mm: float = 2.5
    fit_u_mm: float = 1.0
    bars_u_mm: float = 1.0
    level_u_mm: float = 1.0
    braced: bool = True
    height_mm: float | None = None

    @property
    def text(self) -> str:
        """The lines of their table in a job, which report.json carries among what it says of the job."""
        known = {item.name: getattr(self, item.name) for item in fields(self)}
        return "\n".join(f"{key} = {str(value).lower()}" for key, value in known.items() if value is not None)
