"""Columns of a model that are asked for by name, and what of the model they need: eight of 2,000 take their part."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from aadm_workbench.design.ifc import names as ifc_names
from aadm_workbench.design.ifc.columns import ColumnBody, Foot, names
from aadm_workbench.design.ifc.sleeves import BESIDE_MM
from aadm_workbench.model import Array

_LEAST_GAIN = 2
"""Where more than one column in two is asked for, looking for what the others need costs more than it spares."""

_LEANING_MM = 1000.0
"""By how much the mouths of one opening in the feet of two columns can be apart across them: 5 degrees over 6 m, and
the half width of a foot."""


@dataclass(frozen=True, eq=False)
class Chosen:
    """The columns that are asked for, and ``bodies``: these and all that may claim one of their sleeves."""

    wanted: frozenset[int]
    bodies: tuple[ColumnBody, ...]

    def __contains__(self, body: ColumnBody) -> bool:
        return body.element.id() in self.wanted

    @cached_property
    def _lines(self) -> tuple[Array, Array, Array]:
        feet = [foot for body in self.bodies for foot in body.feet]
        T = np.array([foot.T_model_foot for foot in feet])
        return T[:, :3, 3], T[:, :3, 2], np.array([foot.reach_mm for foot in feet]) + BESIDE_MM * math.sqrt(2.0)

    def near(self, point: Array) -> bool:
        """Whether a point (3,) mm of the model lies over, under or in the foot of one of them, at any height."""
        origins, axes, reach_mm = self._lines
        apart = point - origins
        along_mm = np.einsum("ij,ij->i", apart, axes)
        across_mm2 = np.einsum("ij,ij->i", apart, apart) - along_mm**2
        return bool((across_mm2 <= reach_mm**2).any())


def chosen_of(bodies: Sequence[ColumnBody], keys: Collection[str] | None) -> Chosen | None:
    """The columns that ``keys`` name; None where all are wanted, or where only a look at all tells which is meant."""
    if keys is None or _LEAST_GAIN * len(keys) > len(bodies):
        return None
    named = [(body, names(body.element)) for body in bodies]
    owners = Counter(name for _, called in named for name in set(called))
    by_name = {name: body for body, called in named for name in called}
    stripped = {key.strip() for key in keys}
    if any(owners[key] != 1 for key in stripped):
        return None
    wanted = {id(by_name[key]) for key in stripped}
    if not all(_keeps_its_id(body, called, owners) for body, called in named if id(body) in wanted):
        return None
    kept = _with_neighbours(bodies, wanted)
    return Chosen(frozenset(body.element.id() for body in bodies if id(body) in wanted), kept)


def _keeps_its_id(body: ColumnBody, called: Sequence[str], owners: Counter[str]) -> bool:
    """Whether the name that a column gets among all is its own even among those that turn out to be none."""
    own = [name for name in called if name != body.element.GlobalId]
    spoken = [name for name in own if not ifc_names.is_machine_made(name)]
    return owners[next(iter([*spoken, *own]), body.element.GlobalId)] == 1


def _with_neighbours(bodies: Sequence[ColumnBody], wanted: set[int]) -> tuple[ColumnBody, ...]:
    """Some bodies, those that stand where they stand, and so on: a column may be drawn twice."""
    origins = [[foot.T_model_foot[:3, 3] for foot in body.feet] for body in bodies]
    kept = [id(body) in wanted for body in bodies]
    left = [place for place, is_kept in enumerate(kept) if is_kept]
    owner = np.repeat(np.arange(len(bodies)), list(map(len, origins)))
    points = np.array([point for some in origins for point in some])
    reach_mm = np.array([foot.reach_mm for body in bodies for foot in body.feet])
    while left:
        for foot in bodies[left.pop()].feet:
            for place in owner[_across_mm(foot, points) <= reach_mm + foot.reach_mm + _LEANING_MM].tolist():
                if not kept[place]:
                    kept[place] = True
                    left.append(place)
    return tuple(body for body, is_kept in zip(bodies, kept, strict=True) if is_kept)


def _across_mm(foot: Foot, points: Array) -> Array:
    """How far points (n, 3) of the model are from the axis of a foot, mm."""
    return np.asarray(np.linalg.norm(foot.local(points)[:, :2], axis=1))
