"""What a site does to feet and bars, by name: each changes a foot or the bars of a pair as built."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from aadm_workbench.errors import AadmError
from aadm_workbench.model import Array
from aadm_workbench.twin.parts import BarAsBuilt, BarGroup, Break, Cast, Foot, Roughness, SleeveAsBuilt

Change: TypeAlias = Callable[[Foot, BarGroup, np.random.Generator], tuple[Foot, BarGroup]]
"""From a foot, its bars and a generator to both as the site left them."""

_NEXT_SIZES = 1.2  # two sizes up: 20 mm for 24, or what stands for it; or as many down
_SHARE = 0.25  # of the sleeves or bars, where some are spoilt and others are not


def _feet(change: Callable[[Foot, np.random.Generator], Foot]) -> Change:
    return lambda foot, bars, rng: (change(foot, rng), bars)


def _some_sleeves(change: Callable[[SleeveAsBuilt, np.random.Generator], SleeveAsBuilt]) -> Change:
    def of_foot(foot: Foot, bars: BarGroup, rng: np.random.Generator) -> tuple[Foot, BarGroup]:
        chosen = _some(len(foot.sleeves), rng)
        sleeves = [change(s, rng) if k in chosen else s for k, s in enumerate(foot.sleeves)]
        return replace(foot, sleeves=tuple(sleeves)), bars

    return of_foot


def _some_bars(change: Callable[[BarAsBuilt, np.random.Generator], BarAsBuilt], share: float = _SHARE) -> Change:
    def of_bars(foot: Foot, bars: BarGroup, rng: np.random.Generator) -> tuple[Foot, BarGroup]:
        chosen = _some(len(bars.bars), rng, share)
        changed = [change(b, rng) if k in chosen else b for k, b in enumerate(bars.bars)]
        return foot, replace(bars, bars=tuple(changed))

    return of_bars


def _some(count: int, rng: np.random.Generator, share: float = _SHARE) -> set[int]:
    """At least one of so many."""
    return set(rng.permutation(count)[: max(1, round(share * count))].tolist())


def _washed(foot: Foot, rng: np.random.Generator) -> Foot:
    grain = float(rng.uniform(7.0, 16.0))
    return replace(foot, roughness=Roughness(float(rng.uniform(6.0, 8.0)), grain, "washed", int(rng.integers(2**31))))


def _keyed(foot: Foot, rng: np.random.Generator) -> Foot:
    return replace(foot, roughness=Roughness(float(rng.uniform(6.0, 10.0)), float(rng.uniform(24.0, 45.0)), "keyed"))


def _spalled(sleeve: SleeveAsBuilt, rng: np.random.Generator) -> SleeveAsBuilt:
    """A piece of the face is broken out at the rim."""
    return replace(sleeve, chip=float(rng.uniform(8.0, 14.0)), chip_direction=_turn(rng))


def _taped(sleeve: SleeveAsBuilt, rng: np.random.Generator) -> SleeveAsBuilt:
    return replace(sleeve, taped=float(rng.uniform(0.3, 0.5)), chip_direction=_turn(rng))


def _taped_and_spalled(foot: Foot, bars: BarGroup, rng: np.random.Generator) -> tuple[Foot, BarGroup]:
    """A mouth wholly under tape with a spall beside it, which is as round and as wide as a mouth."""
    sleeves = list(foot.sleeves)
    for k in _some(len(sleeves), rng):
        sleeve = sleeves[k]
        sleeves[k] = replace(
            sleeve, taped=1.0, chip=float(rng.uniform(0.7, 1.1)) * sleeve.diameter, chip_direction=_turn(rng)
        )
    return replace(foot, sleeves=tuple(sleeves)), bars


def _turn(rng: np.random.Generator) -> float:
    return float(rng.uniform(0.0, 2.0 * np.pi))


def _off(length_mm: float, rng: np.random.Generator) -> Array:
    turn = _turn(rng)
    return length_mm * np.array([np.cos(turn), np.sin(turn)])


def _leaning(bar: BarAsBuilt, rng: np.random.Generator) -> BarAsBuilt:
    """It stands where it should and leans by three degrees."""
    x, y = _off(float(np.tan(np.radians(3.0))), rng).tolist()
    return replace(bar, lean=(x, y))


def _kinked(bar: BarAsBuilt, rng: np.random.Generator) -> BarAsBuilt:
    """A kink under the length that a camera sees well: the top is 4 to 8 mm off the line of the rest."""
    x, y = _off(float(rng.uniform(4.0, 8.0)), rng).tolist()
    return replace(bar, bend=(x, y), kinked_at=float(rng.uniform(50.0, 90.0)))


def _two_heights(foot: Foot, bars: BarGroup, rng: np.random.Generator) -> tuple[Foot, BarGroup]:
    """Every other bar is longer by half of a lap, as bars are staggered."""
    longer = float(rng.uniform(30.0, 80.0))
    return foot, replace(bars, bars=tuple(replace(b, top=b.top + longer * (k % 2)) for k, b in enumerate(bars.bars)))


def _cut_off(bar: BarAsBuilt, rng: np.random.Generator) -> BarAsBuilt:
    return replace(bar, top=bar.top - float(rng.uniform(35.0, 80.0)))


def _other_bars(bars: BarGroup, rng: np.random.Generator) -> BarGroup:
    times = _other_size(rng)
    return replace(bars, bars=tuple(replace(b, core_diameter=b.core_diameter * times) for b in bars.bars))


def _other_sleeves(foot: Foot, rng: np.random.Generator) -> Foot:
    times = _other_size(rng)
    return replace(foot, sleeves=tuple(replace(s, diameter=s.diameter * times) for s in foot.sleeves))


def _other_size(rng: np.random.Generator) -> float:
    return float(rng.choice([_NEXT_SIZES, 1.0 / _NEXT_SIZES]))


def _burred(bar: BarAsBuilt, rng: np.random.Generator) -> BarAsBuilt:
    return replace(bar, burr=float(rng.uniform(0.6, 1.4)), burr_direction=_turn(rng))


def _off_size(foot: Foot, rng: np.random.Generator) -> Foot:
    """Sides within 6 mm of the formwork's: a little more than a mould is allowed to open, or to close."""
    x, y = (np.array(foot.size) + rng.choice([-1.0, 1.0], 2) * rng.uniform(1.5, 6.0, 2)).tolist()
    return replace(foot, size=(x, y))


def _cast(change: Callable[[Cast, np.random.Generator], Cast]) -> Change:
    return _feet(lambda foot, rng: replace(foot, cast=change(foot.cast, rng)))


def _beside(cast: Cast, rng: np.random.Generator) -> Cast:
    """The template of the sleeves stood beside its place in the mould, and turned."""
    x, y = _off(float(rng.uniform(1.0, 4.0)), rng).tolist()
    return replace(cast, offset=(x, y), turn=float(rng.choice([-1.0, 1.0]) * np.radians(rng.uniform(0.1, 0.4))))


def _askew(cast: Cast, rng: np.random.Generator) -> Cast:
    return replace(cast, shear=float(rng.choice([-1.0, 1.0]) * np.radians(rng.uniform(0.2, 0.6))))


def _broken_corners(cast: Cast, rng: np.random.Generator) -> Cast:
    corners = rng.permutation(["-x-y", "+x-y", "+x+y", "-x+y"])[: int(rng.integers(1, 4))].tolist()
    pieces = [Break(corner, 0.0, 0.0, float(rng.uniform(5.0, 40.0))) for corner in corners]
    return replace(cast, breaks=(*cast.breaks, *pieces))


def _broken_edges(foot: Foot, rng: np.random.Generator) -> Foot:
    """One to four pieces, none nearer to a corner than it is long."""
    pieces = []
    for side in rng.permutation(["-x", "+x", "-y", "+y"])[: int(rng.integers(1, 5))].tolist():
        depth = float(rng.uniform(5.0, 40.0))
        length = depth * float(rng.uniform(1.0, 3.0))
        reach = foot.size["yx".index(side[1])] / 2.0 - 1.5 * length
        pieces.append(Break(side, float(rng.uniform(-1.0, 1.0)) * max(reach, 0.0), length, depth))
    return replace(foot, cast=replace(foot.cast, breaks=(*foot.cast.breaks, *pieces)))


def _bowed(cast: Cast, rng: np.random.Generator) -> Cast:
    return replace(cast, bow=float(rng.choice([-1.0, 1.0]) * rng.uniform(2.0, 6.0)))


def _warped(cast: Cast, rng: np.random.Generator) -> Cast:
    return replace(cast, warp=float(rng.choice([-1.0, 1.0]) * rng.uniform(2.0, 6.0)))


SITE: Mapping[str, Change] = MappingProxyType(
    {
        "rough": _feet(_washed),
        "keyed": _feet(_keyed),
        "spalls": _some_sleeves(_spalled),
        "tapes": _some_sleeves(_taped),
        "taped-spalls": _taped_and_spalled,
        "proud-rings": _feet(lambda foot, _: replace(foot, sleeves=tuple(replace(s, proud=2.0) for s in foot.sleeves))),
        "plugs": _some_sleeves(lambda sleeve, _: replace(sleeve, plugged_at=10.0)),
        "burrs": _some_bars(_burred, 0.5),
        "caps": _some_bars(lambda bar, rng: replace(bar, cap=float(rng.uniform(1.0, 2.0)))),
        "kinks": _some_bars(_kinked),
        "leans": _some_bars(_leaning),
        "two-heights": _two_heights,
        "cut-off": _some_bars(_cut_off),
        "other-bars": lambda foot, bars, rng: (foot, _other_bars(bars, rng)),
        "other-sleeves": _feet(_other_sleeves),
        "off-size": _feet(_off_size),
        "askew": _cast(_askew),
        "pattern-beside": _cast(_beside),
        "bowed": _cast(_bowed),
        "warped": _cast(_warped),
        "broken-corners": _cast(_broken_corners),
        "broken-edges": _feet(_broken_edges),
    }
)
"""What a site does, by name. Lengths in mm, as the notes on them were seen:

``rough`` feet washed to 6 to 8 mm, ``keyed`` ones with pockets, both up to the mouths; ``spalls`` beside a quarter of
the mouths; ``tapes`` over a third to half of a quarter of them; ``taped-spalls``, where that quarter is wholly under
tape and spalled beside it; ``proud-rings`` 2 mm before the face; ``plugs`` 10 mm inside; ``burrs`` of 0.6 to 1.4 mm on
one side of half of the bars; ``caps`` of plastic on a quarter; ``kinks`` of a quarter; ``leans`` of 3 degrees of a
quarter; ``two-heights``, every other bar 30 to 80 mm longer; ``cut-off``, a quarter 35 to 80 mm shorter.
``other-bars`` and ``other-sleeves`` are a fifth thicker or wider than designed, or as much less.

Of the foot's own section: ``off-size``, sides off by 1.5 to 6 mm; ``askew`` by 0.2 to 0.6 degrees; ``pattern-beside``,
the sleeves 1 to 4 mm beside their place in it and turned by 0.1 to 0.4 degrees; ``bowed`` and ``warped`` faces, by 2 to
6 mm; ``broken-corners`` (one to three) and ``broken-edges`` (one to four), 5 to 40 mm deep.
"""


def known_site(names: Sequence[str]) -> Sequence[str]:
    """The names themselves, each one of :data:`SITE`.

    Raises
    ------
    AadmError
        Where one is not.
    """
    for name in names:
        if name not in SITE:
            raise AadmError.because("command.twin_site", name=name, known=tuple(SITE))
    return names


def left_by_site(names: Sequence[str], foot: Foot, bars: BarGroup, rng: np.random.Generator) -> tuple[Foot, BarGroup]:
    """A foot and its bars after a site did some things to them, in the order of their names.

    Raises
    ------
    AadmError
        Where a name is none of :data:`SITE`.
    """
    for name in known_site(names):
        foot, bars = SITE[name](foot, bars, rng)
    return foot, bars
