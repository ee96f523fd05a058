"""Sites and settings as they are: how often each kind of trouble is noticed and named, and what it does to verdicts.

    python -m benchmarks.sites [--kinds NAME ...] [--cases 20] [--sound 200] [--first 0] [--why]

Random columns with known truth are checked in one process. A verdict is false with certainty where it passes what
fails, or fails what passes, by more than 0.15 mm; a 95 % region should hold 95 % of the true centres.
"""

from __future__ import annotations

import argparse
import platform
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.errors import ScanError
from aadm_workbench.inspection.check import check_column
from aadm_workbench.inspection.measure import CheckSettings, ColumnScans
from aadm_workbench.model import ColumnReport, Kind, Scan
from aadm_workbench.scan.plausible import check_plausible
from aadm_workbench.twin.filters import Filters
from aadm_workbench.twin.slips import SLIPS
from benchmarks.site_scenes import Column, Scenario, built_column
from benchmarks.site_truth import Errors, errors_of, false_verdicts

SETTINGS = CheckSettings(load_profile("cn"))


@dataclass(frozen=True)
class Trouble:
    """A kind of trouble: its scenario, the findings that notice it, and the words, one of each, that name it.

    With no ``codes`` there is nothing to notice: all is to be measured, or to be left out, as it is. ``void``: the
    scans are not of this column, so that no verdict at all may be passed.
    """

    scenario: Scenario
    codes: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    void: bool = False


def _slip(name: str, codes: Sequence[str], words: Sequence[str], **more: bool) -> Trouble:
    scenario = Scenario(slip=lambda rng: SLIPS[name], keyed=more.pop("keyed", False))
    return Trouble(scenario, tuple(codes), tuple(words), **more)


def _filter(codes: Sequence[str], words: Sequence[str], **most: float) -> Trouble:
    def drawn(rng: np.random.Generator) -> Filters:
        return Filters(**{name: _amount(rng, amount) for name, amount in most.items()})

    return Trouble(Scenario(filters=drawn), tuple(codes), tuple(words))


def _amount(rng: np.random.Generator, most: float) -> float:
    return int(rng.integers(1, most + 1)) if isinstance(most, int) else float(rng.uniform(0.5 * most, most))


def _site(name: str, codes: Sequence[str] = (), words: Sequence[str] = ()) -> Trouble:
    return Trouble(Scenario(site=(name,)), tuple(codes), tuple(words))


_SCALE, _DIAMETER = ("scale_differs",), ("diameter_differs",)
TROUBLES: dict[str, Trouble] = {
    "sound": Trouble(Scenario()),
    "gaps": Trouble(
        Scenario(filters=lambda rng: Filters(gaps=int(rng.integers(6, 25)))), ("gaps_filled",), ("hole filling",)
    ),
    "smoothing": _filter(("smoothed",), ("smoothing",), gaussian=3.0),
    "median": Trouble(
        Scenario(filters=lambda rng: Filters(median=int(rng.choice([3, 5, 7])))), ("smoothed",), ("median",)
    ),
    "fattened": _filter(("edges_fattened",), ("dilation",), fatten=3),
    "rings": _filter((), (), rings=2),
    "focal-2-percent": _slip("focal-2-percent", _SCALE, ("focal length",), void=True),
    "focal-half": _slip("focal-half", _SCALE, ("focal length",), void=True),
    "focal-double": _slip("focal-double", _SCALE, ("focal length",), void=True),
    "principal-point": _slip("principal-point", ("common_lean",), ("principal point",)),
    "depth-x10": _slip("depth-x10", _SCALE, ("depth scale",), void=True),
    "depth-by-10": _slip("depth-by-10", _SCALE, ("depth scale",), void=True),
    "unit": _slip("unit", ("error",), ("unit",), void=True),
    "up": _slip("up", ("turn_contradicted",), ("up",), keyed=True, void=True),
    "swapped": _slip("swapped", ("swapped",), ("swapped",), void=True),
    "other-column": Trouble(Scenario(other=True), ("other_column",), ("C-2",)),
    "other-bars": Trouble(Scenario(bars_of=True), _DIAMETER, ("sizes that would fit",)),
    "outliers": _slip("outliers", (), ()),
    "no-floor": _slip("no-floor", (), ()),
    "rough": _site("rough"),
    "keyed": _site("keyed"),
    "spalls": _site("spalls"),
    "tapes": _site("tapes"),
    "taped-spalls": _site("taped-spalls"),
    "proud-rings": _site("proud-rings"),
    "plugs": _site("plugs"),
    "burrs": _site("burrs"),
    "caps": _site("caps", _DIAMETER, ("cap",)),
    "kinks": _site("kinks"),
    "leans": _site("leans"),
    "two-heights": _site("two-heights"),
}


@dataclass
class Tally:
    """What came of the columns of one kind."""

    cases: int = 0
    noticed: int = 0
    named: int = 0
    held: int = 0
    false: list[str] = field(default_factory=list)
    errors: list[Errors] = field(default_factory=list)
    verdicts: Counter[str] = field(default_factory=Counter)
    codes: Counter[str] = field(default_factory=Counter)
    missed: list[int] = field(default_factory=list)
    seconds: float = 0.0


def checked(column: Column) -> ColumnReport | str:
    """The report on a column, or what the reader refuses it with."""
    extent_mm = 2.0 * column.setting.half_width
    try:
        scans = [check_plausible(_told(one.scan(name), column), extent_mm) for one, name in _named(column)]
    except ScanError as error:
        return str(error)
    up_deg = (90.0 + column.slip.up_deg) % 360.0
    told = ColumnScans((scans[0],), (scans[1],), up_deg, up_deg, others=column.others)
    return check_column(column.design, told, SETTINGS)


def _named(column: Column) -> list[tuple[object, str]]:
    return [(column.sleeves, "foot.tiff"), (column.rebars, "bars.tiff")]


def _told(scan: Scan, column: Column) -> Scan:
    factor = {"mm": 1.0, "m": 1000.0}[column.slip.unit]
    return replace(scan, points=scan.points * scan.points.dtype.type(factor)) if factor != 1.0 else scan


def tally(name: str, numbers: Sequence[int], *, why: bool = False) -> Tally:
    """Make and check the columns of a kind."""
    trouble, result = TROUBLES[name], Tally()
    for number in numbers:
        column = built_column(trouble.scenario, number)
        began = time.perf_counter()
        report = checked(column)
        result.seconds += time.perf_counter() - began
        result.cases += 1
        _count(result, trouble, column, report, number, why=why)
    return result


def _count(
    result: Tally, trouble: Trouble, column: Column, report: ColumnReport | str, number: int, *, why: bool
) -> None:
    if isinstance(report, str):
        texts, codes = [report], {"error"}
    else:
        texts, codes = [finding.text for finding in report.findings], {one.code for one in report.findings}
        false = false_verdicts(column, report, void=trouble.void)
        result.false += [f"{number}: {text}" for text in false]
        result.errors += [errors_of(column, report, kind) for kind in Kind]
        result.verdicts[report.verdict.value] += 1
    result.codes.update(codes)
    noticed = bool(codes & set(trouble.codes)) if trouble.codes else bool(codes)
    result.noticed += noticed
    result.named += noticed and all(any(word in text for text in texts) for word in trouble.words)
    if noticed != bool(trouble.codes):
        result.missed.append(number)
    if why:
        _explain(number, report, noticed=noticed)


def _explain(number: int, report: ColumnReport | str, *, noticed: bool) -> None:
    print(f"  #{number} noticed={noticed}")
    if isinstance(report, str):
        print(f"     {report}")
        return
    print(f"     {report.verdict} " + " | ".join(report.reasons[:4])[:600])
    for finding in report.findings:
        print(f"     [{finding.code}] {finding.text[:220]}")


def _row(name: str, result: Tally) -> str:
    parts = [_measures([one for one in result.errors if one.kind is kind]) for kind in Kind]
    codes = ", ".join(f"{code} {count}" for code, count in result.codes.most_common(4))
    return (
        f"{name:16} {result.cases:4d} {result.noticed / result.cases:7.0%} {result.named / result.cases:6.0%}"
        f" {len(result.false):6d}  {parts[0]}  {parts[1]}  {result.seconds / result.cases:5.2f}  {codes}"
    )


def _measures(errors: Sequence[Errors]) -> str:
    measurable, found = sum(one.measurable for one in errors), sum(one.found for one in errors)
    distance = np.concatenate([one.distance_mm for one in errors]) if errors else np.zeros(0)
    inside = np.concatenate([one.inside for one in errors]) if errors else np.zeros(0)
    false = sum(one.ghosts for one in errors)
    if not len(distance):
        return f"{found / max(measurable, 1):5.0%} {false:3d}    -     -     -"
    return (
        f"{found / max(measurable, 1):5.0%} {false:3d} {np.median(distance):5.3f} {distance.max():5.2f} "
        f"{inside.mean():5.0%}"
    )


HEADER = (
    f"{'kind':16} {'n':>4} {'noticed':>7} {'named':>6} {'false':>6}  "
    "sleeves: found ghosts median max in-region  bars: the same   s    findings"
)


def main() -> None:
    """Run the kinds that the command line names, all without any, and print a line for each."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kinds", nargs="+", default=list(TROUBLES), choices=list(TROUBLES), metavar="NAME")
    parser.add_argument("--cases", type=int, default=20)
    parser.add_argument("--sound", type=int, default=200)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--why", action="store_true", help="print what was said of each column")
    options = parser.parse_args()
    print(f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}")
    print(HEADER)
    for name in options.kinds:
        count = options.sound if name == "sound" else options.cases
        result = tally(name, range(options.first, options.first + count), why=options.why)
        print(_row(name, result), flush=True)
        for text in result.false[:12]:
            print(f"      false: {text}")
        if result.missed:
            print(f"      unlike what was expected: {result.missed}", flush=True)


if __name__ == "__main__":
    main()
