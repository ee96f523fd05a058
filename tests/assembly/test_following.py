"""One bar off is one error: what follows from it is told as following, and what is wrong by itself is not."""

from dataclasses import replace

import pytest

from aadm_workbench.assembly.following import blame_of, told_once
from aadm_workbench.model import ColumnReport, Verdict
from tests.report.checked_floor import Case, checked, far_apart


@pytest.fixture(scope="module")
def one_bar() -> ColumnReport:
    """The fifth bar of the pattern stands 7.5 mm off; by its label it is another."""
    return checked(Case("C-1", "A/1", off={"R5": (7.5, 0.0)}))


def off_by_itself(column: ColumnReport) -> str:
    """The bar whose offset is unlike that of all others."""
    assert column.rebars is not None
    known = {point.label: point.offset_mm or (0.0, 0.0) for point in column.rebars.points}
    return max(known, key=lambda label: abs(known[label][0]))


def test_twelve_pairs_that_fail_are_one_error(one_bar: ColumnReport) -> None:
    bar = off_by_itself(one_bar)
    assert one_bar.goes_on is Verdict.FAIL
    assert sum(pair.verdict is Verdict.FAIL for pair in one_bar.pairs) == 12
    blame = blame_of(one_bar)
    assert blame.culprits == (bar,)
    assert f"S{bar[1:]}/{bar}" not in blame.follows
    assert sum("/" in name for name in blame.follows) == 11
    assert all(bar in name for name in blame.follows if "–" in name)
    assert one_bar.reasons[0].startswith(f"{bar} is in the way")
    assert sum(reason.startswith("follows from ") for reason in one_bar.reasons) == 1
    assert not any(reason.startswith("R") and not reason.startswith(bar) for reason in one_bar.reasons)


def test_told_twice_is_told_once(one_bar: ColumnReport) -> None:
    assert told_once(one_bar).reasons == one_bar.reasons


def test_a_second_bar_that_would_still_fail_is_no_follower() -> None:
    column = checked(Case("C-3", "A/3", off=far_apart(reach_mm=3.4)))
    assert column.repair is not None
    assert column.repair.still_fails
    blame = blame_of(column)
    assert {*column.repair.still_fails} <= {*blame.culprits}
    assert not {*column.repair.still_fails} & {*blame.follows}
    said = " ".join(column.reasons)
    assert all(f"{label} is " in said for label in column.repair.still_fails)


def test_without_advice_nothing_follows_from_a_pair(one_bar: ColumnReport) -> None:
    assert one_bar.trial_assembly is not None
    unknown = replace(one_bar, trial_assembly=replace(one_bar.trial_assembly, in_the_way=()), repair=None)
    assert not any("/" in name for name in blame_of(unknown).follows)


def test_a_column_that_is_right_blames_nobody() -> None:
    blame = blame_of(checked(Case("C-4", "B/1")))
    assert (blame.culprits, blame.follows) == ((), ())
