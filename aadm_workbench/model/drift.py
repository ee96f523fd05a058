"""What a batch of columns says about the mould that they come from."""

from __future__ import annotations

from dataclasses import dataclass

from aadm_workbench.model.measured import Vector2


@dataclass(frozen=True, slots=True)
class Capability:
    """Process capability along one axis, with 95 % intervals; None where the scatter is zero."""

    axis: str
    cp: float | None
    cp_interval: Vector2 | None
    cpk: float | None
    cpk_interval: Vector2 | None


@dataclass(frozen=True, slots=True)
class SleeveDrift:
    """One sleeve over all columns of a mould, mm, column frame, measured minus design.

    Parameters
    ----------
    columns
        In how many columns it was measured.
    mean_mm, interval_mm
        Mean displacement (dx, dy) against the sleeves that do not drift, and half the width of its 95 % confidence
        interval.
    scatter_mm
        Standard deviation (dx, dy) over the columns, after each column's own fit.
    p_value
        Of the F test of a mean displacement of zero, after Holm's correction for the number of sleeves.
    drifts
        Whether the displacement is significant at 5 % over all sleeves, and beyond what the scans may share.
    scatters_more
        Whether its scatter is significantly larger than that of the other sleeves; then it is judged by its own.
    capability
        Along x and y, of the position after each column's own fit.
    """

    label: str
    columns: int
    mean_mm: Vector2
    interval_mm: Vector2
    scatter_mm: Vector2
    p_value: float | None
    drifts: bool
    scatters_more: bool
    capability: tuple[Capability, ...] = ()


@dataclass(frozen=True, slots=True)
class MouldDrift:
    """The sleeves of all columns of one piece mark.

    Parameters
    ----------
    piece_mark
        None for columns that share an inline design without one.
    columns
        Ids of the columns that were used.
    p_value
        Of the F test that no sleeve is displaced at all, against the scatter of the columns.
    scatter_mm
        Pooled standard deviation per axis about the means.
    limit_mm, axis_limit_mm, axis_limit_from
        Limit of position; what capability is taken against on each axis, and how it follows from that limit.
    """

    piece_mark: str | None
    columns: tuple[str, ...]
    p_value: float | None
    scatter_mm: float
    limit_mm: float | None
    axis_limit_mm: float | None
    axis_limit_from: str
    sleeves: tuple[SleeveDrift, ...] = ()
    conclusion: str = ""

    @property
    def name(self) -> str:
        """The piece mark, or the first column."""
        return self.piece_mark or next(iter(self.columns), "")

    @property
    def drifting(self) -> tuple[SleeveDrift, ...]:
        """The sleeves that the mould holds in a wrong place."""
        return tuple(sleeve for sleeve in self.sleeves if sleeve.drifts)
