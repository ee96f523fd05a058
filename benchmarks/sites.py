"""Sites and settings as they are: how often each kind of trouble is noticed and named, and what it does to verdicts.

    python -m benchmarks.sites [--kinds NAME ...] [--cases 20] [--sound 200] [--first 0] [--why] [--rows FILE]

Random columns with known truth are checked in one process. A verdict is false with certainty where it passes what
fails, or fails what passes, by more than 0.15 mm; a 95 % region should hold 95 % of the true centres.

With ``--rows`` each column is a line of a file as soon as it is checked, a few of each kind at a time, and those that
stand in it are not made again: a run that was ended goes on, and its table can be read meanwhile.
"""

from __future__ import annotations

import argparse
import json
import platform
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.errors import ScanError
from aadm_workbench.inspection.check import check_column
from aadm_workbench.inspection.measure import CheckSettings, ColumnScans
from aadm_workbench.model import ColumnReport, Kind, Scan
from aadm_workbench.scan.plausible import check_plausible
from aadm_workbench.twin.filters import Filters
from aadm_workbench.twin.slips import SLIPS, Slip
from benchmarks.site_scenes import Column, Scenario, built_column
from benchmarks.site_truth import Errors, errors_of, false_verdicts

SETTINGS = CheckSettings(load_profile("cn"))
_ROUNDS = 4  # after the first one a table of all kinds can be read
_SAID = 8  # sentences of a column that a row keeps


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


def _turned(length: float, rng: np.random.Generator) -> tuple[float, float]:
    turn = float(rng.uniform(0.0, 2.0 * np.pi))
    return length * float(np.cos(turn)), length * float(np.sin(turn))


def _site(name: str, codes: Sequence[str] = (), words: Sequence[str] = ()) -> Trouble:
    return Trouble(Scenario(site=(name,)), tuple(codes), tuple(words))


_SCALE, _DIAMETER = ("scale_differs",), ("diameter_differs",)
TROUBLES: dict[str, Trouble] = {
    "gaps": Trouble(
        Scenario(filters=lambda rng: Filters(gaps=int(rng.integers(6, 25)))), ("gaps_filled",), ("hole filling",)
    ),
    "smoothing": _filter(("smoothed",), ("smoothing",), gaussian=3.0),
    "median": Trouble(
        Scenario(filters=lambda rng: Filters(median=int(rng.choice([3, 5, 7])))), ("smoothed",), ("median",)
    ),
    "fattened": _filter(("edges_fattened",), ("dilation",), fatten=3),
    "rings": _filter((), (), rings=2),
    "focal-2-percent": Trouble(
        Scenario(slip=lambda rng: Slip(focal=float(rng.choice([1.02, 0.98])))), _SCALE, ("focal length",), void=True
    ),
    "focal-half": _slip("focal-half", _SCALE, ("focal length",), void=True),
    "focal-double": _slip("focal-double", _SCALE, ("focal length",), void=True),
    "principal-point": Trouble(
        Scenario(slip=lambda rng: Slip(principal_px=_turned(80.0, rng))), ("common_lean",), ("principal point",)
    ),
    "depth-x10": _slip("depth-x10", _SCALE, ("depth scale",), void=True),
    "depth-by-10": _slip("depth-by-10", _SCALE, ("depth scale",), void=True),
    "unit": _slip("unit", ("error",), ("unit",), void=True),
    "up": _slip("up", ("turn_contradicted",), ("up",), keyed=True, void=True),
    "swapped": _slip("swapped", ("swapped",), ("swapped",), void=True),
    "other-column": Trouble(Scenario(other=True), ("other_column",), ("C-2",)),
    "twice": _slip("twice", ("swapped",), ("shows the rebars",)),
    # a ring that lacks a corner, or the middle of a side, is in a mirror what it is turned
    "mirrored": _slip("mirrored", ("mirrored", "turn_contradicted"), ("mirror",), keyed=True, void=True),
    "other-bars": _site("other-bars", _DIAMETER, ("sizes that would fit",)),
    "other-sleeves": _site("other-sleeves", _DIAMETER, ("measure",)),
    "cut-off": _site("cut-off", ("exposed_length_differs",), ("cut off",)),
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
    "bowed": _site("bowed"),
    "warped": _site("warped"),
    "swapped-gaps": Trouble(
        Scenario(slip=lambda rng: SLIPS["swapped"], filters=lambda rng: Filters(gaps=int(rng.integers(6, 25)))),
        ("gaps_filled", "swapped"),
        void=True,
    ),
    "tapes-spalls": Trouble(Scenario(site=("tapes", "spalls"))),
    "rough-smoothing": Trouble(
        Scenario(site=("rough",), filters=lambda rng: Filters(gaussian=float(rng.uniform(1.0, 3.0)))), ("smoothed",)
    ),
    "rare": Trouble(Scenario(rare=True)),
    "rare-tapes": Trouble(Scenario(site=("tapes",), rare=True)),
    "sound": Trouble(Scenario()),
}


@dataclass(frozen=True)
class Row:
    """What came of one column: as a line of a file, too.

    ``groups``: of sleeves and bars, in this order, how many there are to measure, how many were, how many of these are
    ghosts, the distances of the others from the truth, mm, and whether that is in the stated region.
    """

    kind: str
    number: int
    noticed: bool
    named: bool
    codes: list[str]
    false: list[str]
    verdict: str
    groups: list[tuple[int, int, int, list[float], list[bool]]]
    seconds: float
    said: list[str]

    @property
    def expected(self) -> bool:
        """Whether it was noticed where there was something to notice, and not where there was nothing."""
        return self.noticed == bool(TROUBLES[self.kind].codes)


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


def row_of(name: str, number: int, camera: str = "ray") -> Row:
    """Make and check the column of a kind and a number."""
    trouble = TROUBLES[name]
    column = built_column(trouble.scenario, number, camera)
    began = time.perf_counter()
    report = checked(column)
    seconds = round(time.perf_counter() - began, 3)
    if isinstance(report, str):
        codes, false, verdict, groups, said = {"error"}, [], "error", [], [report]
        texts = said
    else:
        codes = {finding.code for finding in report.findings}
        texts = [str(finding.text) for finding in report.findings]
        false = false_verdicts(column, report, void=trouble.void)
        groups = [_numbers(errors_of(column, report, kind)) for kind in Kind]
        verdict, said = report.verdict.value, [*texts, *(str(reason) for reason in report.reasons)][:_SAID]
    noticed = bool(codes & set(trouble.codes)) if trouble.codes else bool(codes)
    named = noticed and all(any(word in text for text in texts) for word in trouble.words)
    return Row(name, number, noticed, named, sorted(codes), false, verdict, groups, seconds, said)


def _numbers(errors: Errors) -> tuple[int, int, int, list[float], list[bool]]:
    distances = [round(float(distance), 4) for distance in errors.distance_mm]
    return errors.measurable, errors.found, errors.ghosts, distances, [bool(one) for one in errors.inside]


def rounds(kinds: Sequence[str], cases: int, sound: int, first: int) -> Iterator[tuple[str, int]]:
    """Kind and number of each column: a share of each kind's before the next share of any."""
    for part in range(_ROUNDS):
        for name in kinds:
            count = sound if name == "sound" else cases
            yield from (
                (name, number) for number in range(first, first + count) if (number - first) * _ROUNDS // count == part
            )


def kept_rows(path: Path | None) -> dict[tuple[str, int], Row]:
    """The rows of a file, by kind and number; none of one that is not there."""
    if path is None or not path.exists():
        return {}
    rows = [Row(**json.loads(line)) for line in path.read_text(encoding="utf-8").splitlines()]
    return {(row.kind, row.number): row for row in rows}


def _explain(row: Row) -> None:
    print(f"  {row.kind} #{row.number} noticed={row.noticed} {row.verdict} {row.codes}")
    for text in row.said:
        print(f"     {text[:300]}")


def _line(name: str, rows: Sequence[Row]) -> str:
    parts = [_measures([row.groups[k] for row in rows if row.groups]) for k in range(len(Kind))]
    codes = ", ".join(f"{code} {n}" for code, n in Counter(code for row in rows for code in row.codes).most_common(4))
    count, false = len(rows), sum(len(row.false) for row in rows)
    return (
        f"{name:16} {count:4d} {sum(row.noticed for row in rows) / count:7.0%}"
        f" {sum(row.named for row in rows) / count:6.0%} {false:6d}  {parts[0]}  {parts[1]}"
        f"  {sum(row.seconds for row in rows) / count:5.2f}  {codes}"
    )


def _measures(groups: Sequence[tuple[int, int, int, list[float], list[bool]]]) -> str:
    measurable, found, ghosts = (sum(int(one[k]) for one in groups) for k in range(3))  # type: ignore[call-overload]
    distance = np.array([distance for one in groups for distance in one[3]])
    if not len(distance):
        return f"{found / max(measurable, 1):5.0%} {ghosts:3d}    -     -     -"
    inside = np.mean([one for group in groups for one in group[4]])
    return (
        f"{found / max(measurable, 1):5.0%} {ghosts:3d} {np.median(distance):5.3f} {distance.max():5.2f} {inside:5.0%}"
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
    parser.add_argument(
        "--camera", choices=["ray", "fringe"], default="ray", help="fringe is path-traced: a minute each"
    )
    parser.add_argument("--why", action="store_true", help="print what was said of each column")
    parser.add_argument("--rows", type=Path, metavar="FILE", help="go on with what stands in this file")
    options = parser.parse_args()
    rows = kept_rows(options.rows)
    wanted = list(rounds(options.kinds, options.cases, options.sound, options.first))
    for name, number in wanted:
        if (name, number) in rows:
            continue
        rows[name, number] = row = row_of(name, number, options.camera)
        if options.rows:
            with options.rows.open("a", encoding="utf-8") as file:
                file.write(json.dumps(asdict(row)) + "\n")
        if options.why:
            _explain(row)
    show([rows[one] for one in wanted])


def show(rows: Sequence[Row]) -> None:
    """Print a line for each kind, with what was false and the numbers of columns unlike what was expected."""
    print(f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}")
    print(HEADER)
    for name in dict.fromkeys(row.kind for row in rows):
        of_kind = [row for row in rows if row.kind == name]
        print(_line(name, of_kind))
        for row in of_kind:
            for text in row.false:
                print(f"      false: {row.number}: {text}")
        unlike = [row.number for row in of_kind if not row.expected]
        if unlike:
            print(f"      unlike what was expected: {unlike}")


if __name__ == "__main__":
    main()
