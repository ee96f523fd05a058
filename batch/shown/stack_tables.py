"""A stack plan for the terminal, in one language: columns, beams, what to set otherwise, and what was not found."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rich.text import Text

from aadm_workbench.report.sheets.numbers import signed
from aadm_workbench.report.words.labels import Language, Phrase, phrase
from aadm_workbench.stack.told import advice_phrase, against, by_reason, limit_reasons, member_reasons

from .terminal import new_table, verdict_text

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.stack.result import Judged, StackedColumn, StackedMember, StackPlan, Top


def stack_tables(plan: StackPlan, language: Language) -> Iterator[Table | str]:
    """Tables and lines, the most important first."""
    yield from _Shown(plan, language).parts()


@dataclass(frozen=True)
class _Shown:
    plan: StackPlan
    language: Language

    def parts(self) -> Iterator[Table | str]:
        plan = self.plan
        yield self._columns()
        if plan.members:
            yield self._members()
        if plan.neighbours:
            yield self._neighbours()
        for column in plan.columns:
            if column.advice is not None:
                yield self._line(column.measured.id, self._said(advice_phrase(column)))
        yield from (self._line(names, self._said(reason)) for reason, names in by_reason(plan))
        yield from (self._line(name, self._said(reason)) for name, reason in limit_reasons(plan))
        yield from (self._line(names, self._said(reason)) for reason, names in member_reasons(plan))
        yield from (self._line(one.about, self._said(one.reason)) for one in plan.not_found)

    def _word(self, name: str, **values: object) -> str:
        return phrase(f"stack.{name}", **values).in_language(self.language)

    def _said(self, text: Phrase) -> str:
        return text.in_language(self.language)

    def _line(self, about: str, said: str) -> str:
        return f"{about}: {said}" if self.language == "en" else f"{about}：{said}"

    def _table(self, *headings: str, numbers: tuple[str, ...]) -> Table:
        words = {name: self._word(name) for name in headings}
        return new_table(*words.values(), numbers=tuple(words[name] for name in numbers))

    def _columns(self) -> Table:
        numbers = ("foot", "yaw", "top_at", "length", "u")
        table = self._table("column", "against", *numbers, "verdict", numbers=numbers)
        for column in self.plan.columns:
            table.add_row(
                Text(column.measured.id), Text(self._said(against(column))), *_foot(column), *self._top(column.top)
            )
        return table

    def _top(self, top: Top | None) -> tuple[str | Text, ...]:
        if top is None:
            return "–", "–", "", self._word("not_predicted")
        x, y = top.offset_mm
        off = "" if top.judged.value is None else f"{top.judged.value:.2f} mm"
        return (
            f"{signed(x)}, {signed(y)} mm",
            off,
            f"{top.u_mm:.2f} mm",
            verdict_text(top.judged.verdict, self.language),
        )

    def _members(self) -> Table:
        numbers = ("span", "u", "seats", "skew", "level")
        table = self._table("member", "from_to", *numbers, "verdict", numbers=numbers)
        for member in self.plan.members:
            table.add_row(Text(member.id), Text(" – ".join(end or "?" for end in member.ends)), *self._cells(member))
        return table

    def _cells(self, member: StackedMember) -> tuple[str | Text, ...]:
        span = member.span_mm
        return (
            _mm(span),
            "" if span.u is None else f"{span.u:.2f} mm",
            ", ".join(map(_mm, member.seat_mm)),
            "–" if member.skew_deg.value is None else f"{signed(member.skew_deg.value, 3)}°",
            _mm(member.level_mm),
            verdict_text(member.verdict, self.language),
        )

    def _neighbours(self) -> Table:
        table = self._table("column", "members", "flush", "u", "verdict", numbers=("flush", "u"))
        for pair in self.plan.neighbours:
            flush = pair.flush_mm
            u = "" if flush.u is None else f"{flush.u:.2f} mm"
            both = Text(" – ".join(pair.members))
            table.add_row(Text(pair.column), both, _mm(flush), u, verdict_text(flush.verdict, self.language))
        return table


def _foot(column: StackedColumn) -> tuple[str, str]:
    if column.placed is None:
        return "–", "–"
    x, y = column.placed.values[:2]
    return f"{signed(x)}, {signed(y)} mm", f"{signed(math.degrees(column.placed.values[5]), 3)}°"


def _mm(judged: Judged) -> str:
    return "–" if judged.value is None else f"{signed(judged.value)} mm"
