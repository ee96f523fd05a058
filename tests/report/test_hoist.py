"""May it be hoisted: only what passed everything and goes on; a foot checked alone is not cleared."""

from typing import Any

import pytest

from aadm_workbench.model import ColumnReport, Verdict
from aadm_workbench.report.findings import findings
from aadm_workbench.report.hoist import headline, hoist_of, in_state
from tests.report.checked_floor import HOSTILE
from tests.report.typed import typed


def test_every_column_has_its_state(floor: dict[str, Any]) -> None:
    states = {column.id: hoist_of(column).state for column in typed(floor).columns}
    assert states == {
        "C-1": "yes",
        "C-2": "no",
        "C-3": "no",
        "C-4": "no",
        "C-5": "no",
        "C-6": "not_yet",
        "C-7": "no",
        HOSTILE: "yes",
    }
    assert headline(typed(floor)).en == "5 of 8 columns must not be hoisted"
    assert headline(typed(floor)).zh == "8 根柱中有 5 根不得吊装"
    assert [column.id for column in in_state(typed(floor), "no")] == ["C-5", "C-3", "C-2", "C-4", "C-7"]


@pytest.mark.parametrize("verdict", ["pass", "fail", "inconclusive", "not_measured", "error"])
@pytest.mark.parametrize("goes_on", ["pass", "fail", "inconclusive", "not_measured", "error", "not_assessed"])
def test_only_two_passes_clear_a_column(verdict: str, goes_on: str) -> None:
    state = hoist_of(ColumnReport("C-1", Verdict(verdict), Verdict(goes_on))).state
    assert (state == "yes") == (verdict == goes_on == "pass")
    assert state != "not_yet" or verdict == "pass"


def test_cause_of_a_failed_trial_comes_first(floor: dict[str, Any]) -> None:
    first = next(finding for finding in findings(typed(floor)) if finding.column.id == "C-3")
    assert first.key_reasons[0].en.startswith("R1 is in the way: it stands ")
    assert first.key_reasons[0].zh.startswith("R1 挡住就位：偏离其余钢筋给出的位置 ")
    assert first.hoist.cause.en == "it does not go on its bars"
    unseen = next(finding for finding in findings(typed(floor)) if finding.column.id == "C-4")
    assert [reason.en for reason in unseen.key_reasons] == ["S8 not measured: not found in the scan"]


@pytest.mark.parametrize(
    ("names", "said", "chinese"),
    [
        (("C-1", "C-6"), "1 of 2 columns not cleared yet", "2 根柱中有 1 根尚未放行"),
        (("C-1", HOSTILE), "All 2 columns may be hoisted", "2 根柱均可吊装"),
        (("C-1", "C-2"), "1 of 2 columns must not be hoisted", "2 根柱中有 1 根不得吊装"),
        (("C-1",), "The column may be hoisted", "该柱可以吊装"),
        (("C-6",), "The column is not cleared yet", "该柱尚未放行"),
        (("C-5",), "The column must not be hoisted", "该柱不得吊装"),
    ],
)
def test_the_headline_never_sounds_like_a_go_where_one_waits(
    floor: dict[str, Any], names: tuple[str, ...], said: str, chinese: str
) -> None:
    report = typed(floor | {"columns": [column for column in floor["columns"] if column["id"] in names]})
    assert headline(report) == (said, chinese)
