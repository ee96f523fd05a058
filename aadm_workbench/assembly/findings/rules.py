"""All rules that look at one column by itself.

Bars that stick out of the floor too little or too much to be what the sleeves need. Where the design says how far they
stick out, that is what they are held against; elsewhere the other bars are, whose tops may differ by centimetres by
right: then only what lies far outside of their own spread is told.

A lean that all sleeves, or all bars, share: theirs, or that of a principal point that is not the camera's. A principal
point that is off by p pixels shears all that is measured: whatever is farther away moves sideways by p/f of its depth.
Sleeves and bars then lean by that angle, towards the same side of the image, and places within a plane across the view
stay as they are.

A pattern that is larger or smaller as a whole than designed: a wrong camera, a wrong unit or a wrong template. Single
sleeves stand off their places at random; that also changes the scale of a fit, by their scatter over the root of the
sum of their squared distances from the middle. What is beyond that and a play of concrete and templates is no chance.
The scale is a diagnostic and never applied.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.findings.diameters import diameter_findings
from aadm_workbench.assembly.findings.finding import SeenGroup, make_finding
from aadm_workbench.assembly.findings.views import bend_findings, profile_findings
from aadm_workbench.assembly.matching.match import FAR_FROM_DECLARED
from aadm_workbench.assembly.matching.pattern_search import USUAL_SCATTER_MM
from aadm_workbench.assembly.pose.eopa import wrap
from aadm_workbench.extract.copied_pixels import COPIED
from aadm_workbench.extract.filter_signs import GAPS_FILLED, SMOOTHED
from aadm_workbench.model import Array, ColumnDesign, Finding, Kind, codes_of
from aadm_workbench.model.scatter import OF_MEDIAN, TO_SIGMA

_FILTERS = {SMOOTHED.code: "smoothed", GAPS_FILLED.code: "gaps_filled", COPIED.code: "edges_fattened"}

PLAY_MM = 20.0
"""What a sleeve gives at the end that is assembled on site, beyond the embedded length: JG/T 398-2019 (recalled)."""

U_MM = 1.0
"""Standard uncertainty of an exposed length: the floor about a bar is no plane."""

_LENGTH_SIGMAS = 3.0  # of sound bars one in 370 is farther off, before the play
_FEWEST_KNOWN = 4  # of fewer bars no median tells what is usual, or what all share

LEAST_DEG = 0.8
"""Floors, and feet, are square to their columns to half of that; a single bar or sleeve leans by 0.3° by right."""

_FEWEST_OF_BOTH = 3  # where sleeves and bars say the same, three of each are one of six
_LEAN_SIGMAS = 6.0  # beyond what noise, tried twelve times, ever does
# two scans that err alike by chance are rarer than one that errs
_LEAN_SIGMAS_OF_BOTH, _LEAN_SIGMAS_OF_EACH, _LEAN_SIGMAS_APART = 5.0, 1.5, 3.0
_SHARED_DEG = {Kind.SLEEVE: 0.15, Kind.REBAR: 0.3}  # what all leans of one scan may be off together
_ALIKE = 0.35  # of the larger: so much two scans of one camera may differ in

PLAY = 5e-4
"""Relative: shrinkage of concrete, 0.3 mm/m, and 20 K of temperature at 10⁻⁵ a kelvin (EN 1992-1-1, 3.1)."""

NORMAL_QUANTILE = 3.89
"""Two-sided 0.01 %: of sound scans not one in ten thousand is beyond it, play aside."""

_PRIOR_WEIGHT = 4.0  # the usual scatter counts as so many coordinates do
_FEWEST_PAIRS = 3  # two points have one distance, and nothing to hold it against


def findings_of(design: ColumnDesign, groups: Sequence[SeenGroup]) -> tuple[Finding, ...]:
    """What contradicts the design, the declaration or the camera, of the groups of a column that were scanned."""
    found: list[Finding] = [finding for group in groups for finding in turn_findings(group)]
    found += scale_findings(groups)
    found += lean_findings(groups)
    found += filter_findings(groups)
    found += bend_findings(groups)
    found += profile_findings(groups)
    for group in groups:
        found += diameter_findings(group)
        found += exposed_length_findings(group, design.exposed_length_mm)
    return tuple(found)


def filter_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """A finding where a group was not measured because a filter spoilt its scan.

    Where holes were filled in one scan of a column, another one in which no pixel is lost was filled, too.
    """
    filled = any(GAPS_FILLED.code in codes_of(group.extraction.reason) for group in groups)
    for group in groups:
        told = codes_of(group.extraction.reason)
        for filtered, code in _FILTERS.items():
            also = filtered == GAPS_FILLED.code and filled and group.extraction.complete
            if filtered in told or also:
                yield make_finding(code, [group.kind.plural], group=group.kind.plural)


def turn_findings(group: SeenGroup) -> Iterator[Finding]:
    """A contradicted ``up``, a mirrored scan, an ``up`` that lies nearly half-way between two turns."""
    match, name = group.match, group.kind.plural
    if match.contradiction == "mirrored":
        yield make_finding("mirrored", [name], group=name)
    elif match.contradiction == "turn_contradicted":
        yield _contradicted(group)
    elif match.open_turn is not None and match.open_turn > FAR_FROM_DECLARED and match.declared is not None:
        off = abs(wrap((match.placements[0].up or 0.0) - match.declared))
        yield make_finding("turn_doubtful", [name], group=name, off_deg=math.degrees(off))


def _contradicted(group: SeenGroup) -> Finding:
    match, name = group.match, group.kind.plural
    fitting, *as_declared = match.contradicting
    values = {
        "group": name,
        "declared_deg": _direction_deg(match.declared),
        "fitting_deg": _direction_deg(fitting.up),
        "fitting_mm": fitting.rms_mm,
    }
    if as_declared:
        return make_finding("turn_contradicted.worse", [name], **values, declared_mm=as_declared[0].rms_mm)
    return make_finding("turn_contradicted", [name], **values)


def _direction_deg(angle: float | None) -> float:
    """Degrees from +x, from 0 up, whole."""
    return float(round(math.degrees(angle or 0.0)) % 360)


def exposed_length_findings(group: SeenGroup, design_exposed_mm: float | None) -> Iterator[Finding]:
    """One finding for each bar that is too short, or too long."""
    if group.kind is not Kind.REBAR:
        return
    seen = [
        (target, float(point.exposed_length_mm))
        for target, point in group.placed()
        if point.exposed_length_mm is not None
    ]
    if not seen or (design_exposed_mm is None and len(seen) < _FEWEST_KNOWN):
        return
    # A bar that is designed to end higher sticks out further.
    heights = np.array([float(target.centre[2]) for target, _ in seen])
    over = np.array([length for _, length in seen]) - (heights - np.median(heights))
    usual_mm = float(np.median(over)) if design_exposed_mm is None else design_exposed_mm
    spread_mm = TO_SIGMA * float(np.median(np.abs(over - usual_mm))) if design_exposed_mm is None else 0.0
    threshold_mm = PLAY_MM + _LENGTH_SIGMAS * float(np.hypot(U_MM, spread_mm))
    of = "as the others do" if design_exposed_mm is None else "by design"
    for (target, length), deviation in zip(seen, over - usual_mm, strict=True):
        if abs(deviation) > threshold_mm:
            name = "short" if deviation < 0.0 else "long"
            yield make_finding(
                f"exposed_length_differs.{name}",
                [target.label],
                measured_mm=length,
                expected_mm=length - float(deviation),
                of=of,
            )


@dataclass(frozen=True, eq=False)
class _Shear:
    """How far everything moves sideways per depth, (2,) in the axes of the image, and its standard uncertainty."""

    value: Array
    u: float
    points: int

    @property
    def length(self) -> float:
        """Radians, for small ones."""
        return float(np.hypot(*self.value))

    @property
    def degrees(self) -> float:
        return math.degrees(math.atan(self.length))

    @property
    def counts(self) -> bool:
        return self.points >= _FEWEST_KNOWN and self.degrees > LEAST_DEG and self.length > _LEAN_SIGMAS * self.u


def lean_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """One finding for a lean that both groups share, towards one side of the image; else one for each that leans."""
    found = {group.kind: (group, shear) for group in groups if (shear := _shear(group)) is not None}
    if len(found) == 2:
        sleeves, bars = (found[kind][1] for kind in Kind)
        if _are_one(sleeves, bars):
            values = {"sleeves_deg": sleeves.degrees, "rebars_deg": bars.degrees}
            yield make_finding("common_lean.camera", ["sleeves", "rebars"], **values)
            return
    for group, shear in (one for one in found.values() if one[1].counts):
        name = group.kind.plural
        yield make_finding(f"common_lean.{group.kind.value}", [name], lean_deg=shear.degrees)


def _are_one(one: _Shear, other: _Shear) -> bool:
    """Whether two scans are sheared alike, and by more than chance: few points of each tell it together."""
    apart, u_apart = float(np.hypot(*(one.value - other.value))), math.hypot(one.u, other.u)
    if apart > max(_ALIKE * max(one.length, other.length), _LEAN_SIGMAS_APART * u_apart):
        return False
    if one.counts and other.counts:
        return True
    weight = np.array([one.u, other.u]) ** -2
    both = _Shear(weight @ [one.value, other.value] / weight.sum(), float(weight.sum() ** -0.5), 0)
    each = min(one.length / one.u, other.length / other.u)
    return both.degrees > LEAST_DEG and both.length > _LEAN_SIGMAS_OF_BOTH * both.u and each > _LEAN_SIGMAS_OF_EACH


def _shear(group: SeenGroup) -> _Shear | None:
    """The median lean of a group against the vertical of its scan; None where that comes from the leans themselves."""
    extraction = group.extraction
    vertical = extraction.vertical
    known = [point for point in extraction.points if point.axis_covariance is not None and point.seen_length_mm]
    if (
        len(known) < _FEWEST_OF_BOTH
        or vertical is None
        or extraction.vertical_from == "bar axes"
        or abs(vertical[2]) < 0.5
    ):
        return None
    axes = np.array([point.axis * np.sign(point.axis @ vertical) for point in known])
    leans = (axes / (axes @ vertical)[:, None] - vertical)[:, :2]
    own = np.array([np.trace(point.axis_covariance) / 2.0 for point in known])  # type: ignore[arg-type]
    middle = np.median(leans, axis=0)
    scatter = TO_SIGMA * float(np.median(np.abs(leans - middle)))
    u = OF_MEDIAN * math.hypot(scatter, math.sqrt(float(np.median(own)))) / math.sqrt(len(known))
    return _Shear(middle / vertical[2], math.hypot(u, math.radians(_SHARED_DEG[group.kind]) / 2.0), len(known))


@dataclass(frozen=True)
class Scale:
    """Measured over designed size of a pattern, its standard uncertainty, and the degrees of freedom of that."""

    value: float
    u: float
    freedom: float

    @property
    def expanded(self) -> float:
        """Half-width of the range that holds the true scale in all but one of ten thousand cases."""
        return student_quantile(self.freedom) * self.u

    @property
    def differs(self) -> bool:
        """Whether it is another than designed, beyond chance and play."""
        return abs(self.value - 1.0) > PLAY + self.expanded


def scale_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """Findings on the scale of each group by itself, and of the two against each other."""
    scales = [(group, found) for group in groups if (found := pattern_scale(group)) is not None]
    differing = [(group, scale) for group, scale in scales if scale.differs]
    for group, scale in differing:
        name = group.kind.plural
        yield make_finding("scale_differs.group", [name], group=name, scale=scale.value, U=scale.expanded)
    if len(scales) == 2:
        both = _pooled([scale for _, scale in scales])
        if not differing and both.differs:
            yield make_finding("scale_differs.camera", ["sleeves", "rebars"], scale=both.value, U=both.expanded)
        (_, first), (_, second) = scales
        u = math.hypot(first.u, second.u)
        expanded = student_quantile(first.freedom + second.freedom) * u
        difference = abs(first.value - second.value)
        if difference > PLAY + expanded:
            yield make_finding("scale_differs.column", ["sleeves", "rebars"], difference=difference, U=expanded)


def _pooled(scales: Sequence[Scale]) -> Scale:
    """The scale of one camera, that all of the patterns were scanned with: small ones tell it together."""
    weight = np.array([scale.u**-2 for scale in scales])
    value = float(weight @ [scale.value for scale in scales] / weight.sum())
    return Scale(value, float(weight.sum() ** -0.5), sum(scale.freedom for scale in scales))


def pattern_scale(group: SeenGroup) -> Scale | None:
    """Scale of the measured pattern against the design, by least squares; None for too few points.

    Its uncertainty holds the scatter of the points about the scaled pattern, pooled with the usual one, their own
    uncertainties, and that of the camera's lengths.
    """
    if group.match and group.match.orientation == "ambiguous":
        return None
    pairs = group.placed()
    if len(pairs) < _FEWEST_PAIRS:
        return None
    design = np.array([target.centre[:2] for target, _ in pairs])
    measured = np.array([point.point.centre[:2] for _, point in pairs])
    about, seen = design - design.mean(axis=0), measured - measured.mean(axis=0)
    spread = float((about**2).sum())
    # A similarity as a complex factor: measured = factor · design.
    factor = complex(float((seen * about).sum()), float((_cross(about, seen)).sum())) / spread
    left = seen - np.column_stack(
        [factor.real * about[:, 0] - factor.imag * about[:, 1], factor.imag * about[:, 0] + factor.real * about[:, 1]]
    )
    freedom = 2 * len(pairs) - 4 + _PRIOR_WEIGHT
    variance = (float((left**2).sum()) + _PRIOR_WEIGHT * USUAL_SCATTER_MM**2) / freedom
    return Scale(abs(factor), math.hypot(math.sqrt(variance / spread), group.scale_error), freedom)


def student_quantile(freedom: float) -> float:
    """Two-sided 0.01 % of Student's law: within 4 % from eight degrees on.

    The expansion of Cornish and Fisher, its first three terms as Abramowitz and Stegun give them (26.7.5).
    """
    z = NORMAL_QUANTILE
    first = (z**3 + z) / 4.0
    second = (5.0 * z**5 + 16.0 * z**3 + 3.0 * z) / 96.0  # (26.7.5)
    third = (3.0 * z**7 + 19.0 * z**5 + 17.0 * z**3 - 15.0 * z) / 384.0  # (26.7.5)
    return z + first / freedom + second / freedom**2 + third / freedom**3


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
