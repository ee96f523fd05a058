"""The search for the sleeves in a column's foot: by selector, class and name, else by geometry."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from aadm_workbench.design.ifc.bars import BarEnd, FoundBars
from aadm_workbench.design.ifc.columns import ColumnBody, Foot, head_of
from aadm_workbench.design.ifc.crowd import Crowd
from aadm_workbench.design.ifc.geometry.shapes import Shapes
from aadm_workbench.design.ifc.sleeves import (
    BESIDE_MM,
    FEWEST_UNNAMED,
    OPENING_CLASSES,
    SAME_MOUTH_MM,
    Candidate,
    Evidence,
    Mouth,
    alike,
    mouths_on,
    own_candidates,
    unnamed_candidates,
)
from aadm_workbench.design.ifc.text.file import OpenedIfc
from aadm_workbench.design.ifc.under import bars_below
from aadm_workbench.model import Reason

_BEHIND_MM = 5.0  # beyond this it is said: chamfers and rounding are less


@dataclass(frozen=True, eq=False)
class FoundFoot:
    """A column's foot face with the sleeves that open in it, in no order."""

    foot: Foot
    mouths: tuple[Mouth, ...]
    refused: tuple[tuple[Candidate, str], ...]
    warnings: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Nearby:
    """Candidates by place: a floor has thousands, a column a dozen."""

    candidates: Sequence[Candidate]

    @cached_property
    def _middles(self) -> Crowd:
        return Crowd.of([(c.tube.start + c.tube.end) / 2.0 for c in self.candidates])

    def to(self, foot: Foot, without: Any = None) -> list[Candidate]:
        """Candidates over whose middle a column stands, those of one element left out."""
        around = self._middles.about(
            foot.T_model_foot[:3, 3], foot.T_model_foot[:3, 2], foot.reach_mm + BESIDE_MM * math.sqrt(2.0)
        )
        across_mm = np.abs(foot.local(self._middles.points[around])[:, :2])
        near = around[np.all(across_mm <= foot.half_size_mm + BESIDE_MM, axis=1)].tolist()
        return [self.candidates[k] for k in near if without is None or self.candidates[k].element is not without]


@dataclass(frozen=True, eq=False)
class SleeveSearch:
    """Looks for sleeves column by column; ``selected`` where a selector named them, which is then the last word."""

    opened: OpenedIfc
    shapes: Shapes
    named: Nearby
    selected: bool
    bodies: Sequence[ColumnBody]
    bars: FoundBars

    @cached_property
    def unnamed(self) -> Nearby:
        """Round bodies and openings of the whole model; evaluated only where a column needs them."""
        return Nearby(unnamed_candidates(self.opened, self.shapes, self._all_feet))

    @cached_property
    def openings(self) -> Nearby:
        """Round openings of the whole model: some programs relate only a part of them to the column."""
        return Nearby(unnamed_candidates(self.opened, self.shapes, self._all_feet, OPENING_CLASSES))

    @property
    def _all_feet(self) -> list[Foot]:
        return [foot for body in self.bodies for foot in body.feet]

    def on(self, body: ColumnBody) -> FoundFoot:
        """The foot face of a column with its sleeves: of a lying column's two ends, the one with more."""
        return max((self._on_foot(body, foot) for foot in body.feet), key=lambda found: len(found.mouths))

    def on_its_head(self, body: ColumnBody) -> int:
        """How many sleeves open in the upper face of a standing column instead of in its foot."""
        shapes = [shape for part in body.drawn for shape in self.shapes.of_product(part)]
        head = head_of(self.shapes.placements.of_product(body.element), shapes)
        if head is None:
            return 0
        own = () if self.selected else own_candidates(self.opened, body, self.shapes)
        return len(sleeves_in(head, self.named.to(head), own).mouths)

    def _on_foot(self, body: ColumnBody, foot: Foot) -> FoundFoot:
        named = self.named.to(foot)
        if self.selected:
            return sleeves_in(foot, named)
        return sleeves_in(
            foot,
            named,
            own_candidates(self.opened, body, self.shapes),
            lambda: self.openings.to(foot),
            lambda: self.unnamed.to(foot),
            lambda: bars_below(body, foot, self.bars),
        )

    def refused_in(self, body: ColumnBody, foot: Foot) -> list[tuple[Candidate, str]]:
        """Round things without a name that lie in a foot face and are no sleeves, with the reason."""
        own = own_candidates(self.opened, body, self.shapes)
        mouths, refused = mouths_on(foot, [*own, *self.unnamed.to(foot)])
        few = Reason("ifc.fewer_alike", fewest=FEWEST_UNNAMED)
        return [*refused, *((mouth.candidate, few) for mouth in mouths)]


def sleeves_in(
    foot: Foot,
    named: Sequence[Candidate],
    own: Sequence[Candidate] = (),
    openings: Callable[[], Sequence[Candidate]] = tuple,
    unnamed: Callable[[], Sequence[Candidate]] = tuple,
    below: Callable[[], Sequence[BarEnd]] = tuple,
) -> FoundFoot:
    """The sleeves in a foot face: those with a name, else like holes; and what else a bar of the model goes into.

    ``own`` are the column's own holes, ``openings`` those that nothing relates to it, ``unnamed`` all round bodies and
    openings of the model, ``below`` the bars under the column; what takes long is looked at only where it is needed.
    """
    mouths, refused = mouths_on(foot, named)
    holes = mouths_on(foot, own if mouths else [*own, *openings()])[0]
    mouths = mouths or alike(holes)
    if not mouths:
        holes = mouths_on(foot, [*own, *unnamed()])[0]
        mouths = alike(holes)
    extra = [mouth for mouth in holes if _apart(mouth, mouths)]
    entered = _entered(foot, extra, below()) if extra else []
    if len(mouths) + len(entered) >= FEWEST_UNNAMED:
        mouths = [*mouths, *entered]
        extra = [mouth for mouth in extra if mouth not in entered]
    return FoundFoot(foot, tuple(mouths), tuple(refused), (*_warnings(mouths), *_extra(extra if mouths else [])))


def _entered(foot: Foot, mouths: Sequence[Mouth], below: Sequence[BarEnd]) -> list[Mouth]:
    """Mouths that a bar stands under: the sleeves of the few bars of another size."""
    tops = foot.local(np.array([end.top for end in below]).reshape(-1, 3))[:, :2]
    diameters_mm = np.array([end.diameter_mm for end in below])
    return [
        mouth
        for mouth in mouths
        if (np.linalg.norm(tops - mouth.centre, axis=1) + diameters_mm / 2.0 <= mouth.bore_mm / 2.0).any()
    ]


def _apart(mouth: Mouth, others: Sequence[Mouth]) -> bool:
    return all(math.dist(mouth.centre, other.centre) >= SAME_MOUTH_MM for other in others)


def _extra(mouths: Sequence[Mouth]) -> list[str]:
    if not mouths:
        return []
    bores = ", ".join(f"{bore:g}" for bore in sorted({round(mouth.bore_mm, 1) for mouth in mouths}))
    return [Reason("ifc.more_holes", count=len(mouths), bores=bores)]


def _warnings(mouths: Sequence[Mouth]) -> list[str]:
    found: list[str] = []
    solid = sum(mouth.solid for mouth in mouths)
    if solid:
        found.append(Reason("ifc.solid", count=solid))
    behind_mm = max((mouth.behind_mm for mouth in mouths if not mouth.candidate.is_opening), default=0.0)
    if behind_mm > _BEHIND_MM:
        found.append(Reason("ifc.behind", behind_mm=behind_mm))
    if any(mouth.candidate.evidence is Evidence.GEOMETRY for mouth in mouths):
        found.append(Reason("ifc.by_shape"))
    return found
