"""What a plan tells a crew, in both languages."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from aadm_workbench.model import Verdict
from aadm_workbench.report.words.labels import Phrase, phrase
from aadm_workbench.stack.result import StackedColumn, StackPlan, Top

_LEAST_TURN_DEG = 0.005  # prints as 0.01; on a lever of 300 mm it is 0.03 mm


def advice_phrase(column: StackedColumn) -> Phrase:
    """``1.2 mm towards grid 4 from where the trial has it; its top comes to 0.8 mm instead of 2.0 mm``."""
    assert column.advice is not None
    dx, dy, yaw_deg = column.advice.from_trial
    turn = phrase("stack.advice_turn", turn=f"{yaw_deg:+.2f}") if abs(yaw_deg) >= _LEAST_TURN_DEG else Phrase("", "")
    # It goes on its bars, but something else forbids hoisting: whoever reads this line alone must not lift it.
    first = Phrase("", "") if column.measured.verdict is Verdict.PASS else phrase("stack.once_released")
    return Phrase(
        *(
            lead + sentence.format(way=way, turn=text, before=_length(column.top), after=_length(column.advice.top))
            for lead, sentence, way, text in zip(
                first, phrase("stack.advice_line"), _way(column, dx, dy), turn, strict=True
            )
        )
    )


def _way(column: StackedColumn, dx: float, dy: float) -> Phrase:
    """In the words of the crew: towards grid 4."""
    said = column.measured.compass.in_words((dx, dy))
    return said if said.en else phrase("stack.in_place")


def _length(top: Top | None) -> str:
    return "?" if top is None or top.judged.value is None else f"{top.judged.value:.1f}"


def against(column: StackedColumn) -> Phrase:
    """What the numbers of a column are told against; a dash where there are none."""
    if column.placed is None:
        return Phrase("–", "–")
    if column.basis == "storey_below":
        return phrase("stack.storey_below", below=column.below)
    return phrase(f"stack.{column.basis}")


def headline(plan: StackPlan) -> tuple[Phrase, str]:
    """What comes of it in one line, and whether that is ``good``, ``bad`` or neither."""
    counted = [verdict for verdict in plan.verdicts if verdict is not Verdict.NOT_ASSESSED]
    bad = counted.count(Verdict.FAIL)
    left = len(counted) - bad - counted.count(Verdict.PASS)
    if bad:
        return phrase("stack.headline_beyond", bad=bad, total=len(counted)), "bad"
    if not counted or all(column.placed is None for column in plan.columns):
        return phrase("stack.headline_none"), ""
    if left == len(counted):
        return phrase("stack.headline_unjudged", total=len(counted)), ""
    if left:
        return phrase("stack.headline_open", open=left, total=len(counted)), ""
    return phrase("stack.headline_good", total=len(counted)), "good"


def by_reason(plan: StackPlan) -> list[tuple[Phrase, str]]:
    """What is said of columns themselves, each reason once, with the columns that it holds for."""
    return _grouped((column.measured.id, column.reasons) for column in plan.columns)


def member_reasons(plan: StackPlan) -> list[tuple[Phrase, str]]:
    """Why beams are no pass, each reason once, with the beams that it holds for."""
    return _grouped((member.id, member.reasons) for member in plan.members)


def _grouped(said: Iterable[tuple[str, Sequence[Phrase]]]) -> list[tuple[Phrase, str]]:
    found: dict[Phrase, list[str]] = {}
    for name, reasons in said:
        for reason in reasons:
            found.setdefault(reason, []).append(name)
    return [(reason, ", ".join(names)) for reason, names in found.items()]


def limit_reasons(plan: StackPlan) -> list[tuple[str, Phrase]]:
    """Of columns whose top does not keep its limit for certain: why."""
    judged = [(column.measured.id, column.top.judged) for column in plan.columns if column.top is not None]
    return [(name, one.reason) for name, one in judged if one.reason is not None and one.limit is not None]
