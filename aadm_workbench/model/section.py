"""What was found of a foot's own section: its edges, its size, where the sleeves sit in it, how flat its face is."""

from __future__ import annotations

from dataclasses import dataclass

from aadm_workbench.model.measured import Vector2
from aadm_workbench.model.results import RuleResult
from aadm_workbench.model.verdicts import Verdict


@dataclass(frozen=True)
class EdgeChip:
    """A piece that is missing at an edge: ``at_mm`` of its middle along the edge, its length and its depth."""

    at_mm: float
    length_mm: float
    depth_mm: float


@dataclass(frozen=True)
class SectionEdge:
    """One edge of the foot's face, ``side`` is ``-x``, ``+x``, ``-y`` or ``+y`` of the column frame.

    ``measured_mm`` is its distance from the column's axis as the sleeves give it, outwards, ``design_mm`` that by
    design; ``turn_deg`` how it is turned against the design, counter-clockwise from above. ``seen`` is the share of the
    edge that was seen. What was not measured is None, and ``reason`` says why.
    """

    side: str
    design_mm: float
    measured_mm: float | None = None
    u_mm: float | None = None
    turn_deg: float | None = None
    u_turn_deg: float | None = None
    seen: float | None = None
    chips: tuple[EdgeChip, ...] = ()
    reason: str = ""


@dataclass(frozen=True)
class SectionCorner:
    """Where two edges would meet, column frame as the sleeves give it, mm; ``cov_mm2`` (2, 2) is its covariance."""

    name: str
    design_mm: Vector2
    measured_mm: Vector2
    cov_mm2: tuple[Vector2, Vector2]


@dataclass(frozen=True)
class SectionLength:
    """A length of the section against its design, mm: ``x`` and ``y`` its sides, ``flatness`` the range of the face."""

    name: str
    design_mm: float
    measured_mm: float | None = None
    deviation_mm: float | None = None
    u_mm: float | None = None
    limit_mm: tuple[float | None, float] | None = None
    verdict: Verdict = Verdict.NOT_ASSESSED
    probability: float | None = None
    reason: str = ""


@dataclass(frozen=True)
class PatternPlace:
    """Where the pattern of the sleeves sits in the section against the design: ``offset_mm`` and ``turn_deg`` of it.

    ``u_mm`` is the standard uncertainty of the offset per axis.
    """

    verdict: Verdict
    offset_mm: Vector2 | None = None
    u_mm: Vector2 | None = None
    turn_deg: float | None = None
    u_turn_deg: float | None = None
    limit_mm: float | None = None
    probability: float | None = None
    reason: str = ""


@dataclass(frozen=True)
class FaceMap:
    """Median heights, mm, of the face over its plane in square cells, rows from −y, columns from −x; None: not seen."""

    cell_mm: float
    origin_mm: Vector2
    heights_mm: tuple[tuple[float | None, ...], ...]


@dataclass(frozen=True)
class SectionReport:
    """The section of one foot. ``squareness_deg`` is by how much the angle at its corners differs from a right one."""

    verdict: Verdict
    edges: tuple[SectionEdge, ...]
    corners: tuple[SectionCorner, ...]
    lengths: tuple[SectionLength, ...]
    pattern: PatternPlace
    squareness_deg: float | None = None
    u_squareness_deg: float | None = None
    face: FaceMap | None = None
    rules: tuple[RuleResult, ...] = ()
