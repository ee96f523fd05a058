"""Variances of a crossed gauge study: analysis of variance with random parts and random operators.

The model and its estimates are those of AIAG, *Measurement Systems Analysis*, 4th edition, chapter III, ANOVA method:
value = mean + part + operator + part x operator + repeat. Intervals are generalised ones (Burdick, Borror and
Montgomery, *Design and Analysis of Gauge R&R Studies*, 2005, chapter 2): each mean square is replaced by what it may be
by its own chi-squared law, and the variances are computed again.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy import stats

from aadm_workbench.model import Array

POOL_FROM_P = 0.25
"""An interaction less significant than this is pooled with the repeats: a high level, as the manual advises, so that
one which is there is seldom taken for none."""

_DRAWS = 5_000  # the quantile of 2.5 % is then one between 2.1 and 2.9 %
_LEVEL = 0.95  # of intervals: the usual one


@dataclass(frozen=True, slots=True)
class SumOfSquares:
    """One line of the table: the sum of squares and its degrees of freedom."""

    squares: float
    freedom: int

    @property
    def mean(self) -> float:
        """The mean square."""
        return self.squares / self.freedom


@dataclass(frozen=True, slots=True)
class Anova:
    """The table of a study of ``count`` (parts, operators, repeats); values along several axes are taken together.

    ``operators`` and ``interaction`` are None with one operator. ``pooled``: the interaction was taken for repeats.
    """

    count: tuple[int, int, int]
    parts: SumOfSquares
    repeats: SumOfSquares
    operators: SumOfSquares | None = None
    interaction: SumOfSquares | None = None
    pooled: bool = False

    @property
    def p_interaction(self) -> float | None:
        """How probable an interaction as large is by chance; None with one operator."""
        if self.interaction is None:
            return None
        ratio = self.interaction.mean / self.repeats.mean
        return float(stats.f.sf(ratio, self.interaction.freedom, self.repeats.freedom))


@dataclass(frozen=True, slots=True)
class Estimate:
    """A number with its 95 % interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Variances:
    """Variances by what they come from, in the square of the values' unit, each with its 95 % interval.

    ``reproducibility`` is that of operators and of their interaction with parts; None with one operator. ``gauge`` is
    repeatability and reproducibility together.
    """

    repeatability: Estimate
    reproducibility: Estimate | None
    gauge: Estimate
    parts: Estimate


def analysed(values: Array) -> Anova:
    """The table of a balanced study.

    Parameters
    ----------
    values
        (axes, parts, operators, repeats): what was measured. Axes have variances in common and means of their own.

    Raises
    ------
    ValueError
        For fewer than two parts or two repeats.
    """
    axes, parts, operators, repeats = values.shape
    if parts < 2 or repeats < 2:
        raise ValueError("a gauge study takes two parts and two repeats, or more")
    mean = values.mean(axis=(1, 2, 3), keepdims=True)
    of_part, of_operator = values.mean(axis=(2, 3), keepdims=True), values.mean(axis=(1, 3), keepdims=True)
    cell = values.mean(axis=3, keepdims=True)
    of_parts = _squares(of_part - mean, operators * repeats, axes * (parts - 1))
    of_repeats = _squares(values - cell, 1, axes * parts * operators * (repeats - 1))
    count = (parts, operators, repeats)
    if operators == 1:
        return Anova(count, of_parts, of_repeats)
    of_operators = _squares(of_operator - mean, parts * repeats, axes * (operators - 1))
    crossed = _squares(cell - of_part - of_operator + mean, repeats, axes * (parts - 1) * (operators - 1))
    table = Anova(count, of_parts, of_repeats, of_operators, crossed)
    chance = table.p_interaction
    pooled = chance is None or not np.isfinite(chance) or chance > POOL_FROM_P
    return Anova(count, of_parts, of_repeats, of_operators, crossed, pooled)


def _squares(effects: Array, each: int, freedom: int) -> SumOfSquares:
    return SumOfSquares(float(each * (effects**2).sum()), freedom)


def variances_of(table: Anova, rng: np.random.Generator) -> Variances:
    """The variances, and what they may be: ``rng`` draws the mean squares of the intervals.

    An interaction that was taken for repeats may be there all the same: what is not repeats leaves it open.
    """
    whole = {"parts": table.parts, "repeats": table.repeats}
    if table.operators is not None and table.interaction is not None:
        whole |= {"operators": table.operators, "interaction": table.interaction}
    lines = _pooled(whole) if table.pooled else whole
    values = _components(table.count, {name: np.array([line.mean]) for name, line in lines.items()})
    may_be, pooled = (_components(table.count, _drawn(each, rng)) for each in (whole, lines))
    may_be |= {name: pooled[name] for name in ("repeatability", "parts")}
    found = {name: _estimate(values[name], may_be[name]) for name in values}
    return Variances(found["repeatability"], found.get("reproducibility"), found["gauge"], found["parts"])


def _pooled(lines: Mapping[str, SumOfSquares]) -> dict[str, SumOfSquares]:
    """The lines of a table whose interaction is taken for repeats."""
    both = lines["repeats"], lines["interaction"]
    repeats = SumOfSquares(sum(one.squares for one in both), sum(one.freedom for one in both))
    return {"parts": lines["parts"], "repeats": repeats, "operators": lines["operators"]}


def _drawn(lines: Mapping[str, SumOfSquares], rng: np.random.Generator) -> dict[str, Array]:
    """Mean squares (n,) as they may be, each by its own chi-squared law."""
    return {name: line.squares / rng.chisquare(line.freedom, _DRAWS) for name, line in lines.items()}


def _components(count: tuple[int, int, int], mean: Mapping[str, Array]) -> dict[str, Array]:
    """Variances from mean squares, each (n,): a negative one is none, as the manual has it."""
    parts, operators, repeats = count
    within = mean["repeats"]
    crossed = mean.get("interaction", within)
    found = {"repeatability": within, "parts": np.maximum(0.0, (mean["parts"] - crossed) / (operators * repeats))}
    if "operators" in mean:
        of_operators = np.maximum(0.0, (mean["operators"] - crossed) / (parts * repeats))
        found["reproducibility"] = of_operators + np.maximum(0.0, (crossed - within) / repeats)
    found["gauge"] = within + found.get("reproducibility", np.zeros(1))
    return found


def _estimate(value: Array, may_be: Array) -> Estimate:
    low, high = np.quantile(may_be, [(1.0 - _LEVEL) / 2.0, (1.0 + _LEVEL) / 2.0])
    one = float(value[0])
    return Estimate(one, min(float(low), one), max(float(high), one))
