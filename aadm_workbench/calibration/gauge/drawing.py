"""The plots of a gauge study: variances by what they come from, and each capture beside what was stated.

Labels are those of AIAG's manual, the same in both languages: EV repeatability, AV reproducibility, GRR both, PV parts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from aadm_workbench.calibration.gauge.anova import Estimate
from aadm_workbench.calibration.gauge.study import QuantityStudy
from aadm_workbench.report.drawing.sketch import Circle, Label, Polyline, Shape, Sketch, rectangle

_WIDTH, _LEFT = 700.0, 52.0  # of a drawing in its own units, and of the scale at its left
_HEIGHT, _FOOT, _TOP = 240.0, 34.0, 10.0  # of the same: names stand in the foot
_STYLES = ("pass", "inconclusive", "fail", "not_measured", "error")
"""A style for each operator; a sixth begins again."""
_STEPS = (1.0, 2.0, 5.0, 10.0)  # of a scale: what people read off at a glance
_TICKS = 4  # of a scale, about
_DOT = 2.6  # radius of a capture: seen, and a hundred of them apart
_NAMES_MOST = 40  # names under the plot, which do not cover each other
_TWO_SIGMA = 2.0  # 95 % of what is normal lies within


def components_sketch(found: QuantityStudy) -> Sketch:
    """Standard deviations as bars, mm, with their 95 % intervals."""
    variances = found.variances
    bars: list[tuple[str, Estimate]] = [("EV", variances.repeatability)]
    if variances.reproducibility is not None:
        bars.append(("AV", variances.reproducibility))
    bars += [("GRR", variances.gauge), ("PV", variances.parts)]
    most = max(math.sqrt(estimate.high) for _, estimate in bars)
    scale = (_HEIGHT - _FOOT - _TOP) / (most or 1.0)
    shapes: list[Shape] = [*_scale(0.0, most, scale)]
    wide = (_WIDTH - _LEFT) / len(bars)
    for place, (name, estimate) in enumerate(bars):
        middle = _LEFT + (place + 0.5) * wide
        low, value, high = (_FOOT + math.sqrt(x) * scale for x in (estimate.low, estimate.value, estimate.high))
        shapes.append(rectangle((middle - 0.25 * wide, _FOOT), (middle + 0.25 * wide, value), "bar"))
        shapes.append(Polyline(((middle, low), (middle, high)), "ink"))
        shapes += [Polyline(((middle - 6.0, y), (middle + 6.0, y)), "ink") for y in (low, high)]
        shapes.append(Label((middle, 0.5 * _FOOT), f"{name} {math.sqrt(estimate.value):.3f} mm", 11.0))
    return Sketch(_WIDTH, _HEIGHT, tuple(shapes))


def captures_sketch(found: QuantityStudy) -> Sketch:
    """Each capture of each part, from the part's own mean, in mm; the bars are two stated u up and down."""
    study = found.study
    off = study.values - study.values.mean(axis=(2, 3), keepdims=True)
    stated = _TWO_SIGMA * np.sqrt(np.mean(study.u_mm**2, axis=(1, 2)))
    known = stated[np.isfinite(stated)]
    most = max(float(np.abs(off).max()), float(known.max(initial=0.0)), 1e-6)
    scale = (_HEIGHT - _FOOT - _TOP) / (2.0 * most)
    level = _FOOT + most * scale
    shapes: list[Shape] = [*_scale(-most, most, scale)]
    wide = (_WIDTH - _LEFT) / len(study.parts)
    for place, (_, label) in enumerate(study.parts):
        middle = _LEFT + (place + 0.5) * wide
        if np.isfinite(stated[place]):
            reach = float(stated[place]) * scale
            shapes.append(rectangle((middle - 0.4 * wide, level - reach), (middle + 0.4 * wide, level + reach), "bar"))
        if len(study.parts) <= _NAMES_MOST:
            shapes.append(Label((middle, 0.5 * _FOOT), label, min(10.0, 0.35 * wide)))
    shapes += list(_dots(found, off, level, scale, wide))
    return Sketch(_WIDTH, _HEIGHT, tuple(shapes))


def _dots(found: QuantityStudy, off: np.ndarray, level: float, scale: float, wide: float) -> Iterator[Shape]:
    """A dot for each axis of each capture: operators side by side, each in its own style."""
    axes, parts, operators, repeats = off.shape
    slots = axes * operators * repeats
    for part in range(parts):
        for slot in range(slots):
            operator, rest = divmod(slot, axes * repeats)
            axis, repeat = divmod(rest, repeats)
            x = _LEFT + (part + 0.1 + 0.8 * (slot + 0.5) / slots) * wide
            y = level + float(off[axis, part, operator, repeat]) * scale
            yield Circle((x, y), _DOT, style_of(operator))


def style_of(operator: int) -> str:
    """The style of the dots of an operator, by the order of names."""
    return _STYLES[operator % len(_STYLES)]


def _scale(low: float, high: float, scale: float) -> Iterator[Shape]:
    rough = (high - low) / _TICKS or 1.0
    decade = 10.0 ** math.floor(math.log10(rough))
    step = next(decade * one for one in _STEPS if decade * one >= rough)
    for number in range(math.ceil(low / step), math.floor(high / step) + 1):
        y = _FOOT + (number * step - low) * scale
        yield Polyline(((_LEFT, y), (_WIDTH, y)), "axis" if number else "guide")
        yield Label((_LEFT - 6.0, y), f"{number * step:g}", 9.0, "text-faint", "end")
