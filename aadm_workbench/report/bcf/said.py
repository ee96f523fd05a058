"""The texts of a topic in either language: its title, its comment, its description."""

from __future__ import annotations

from collections.abc import Iterator

from aadm_workbench.model import JobReport, Verdict
from aadm_workbench.report.bcf.findings import Finding
from aadm_workbench.report.column_view import declared_up
from aadm_workbench.report.words.labels import Language, Phrase, phrase, profile_words
from aadm_workbench.report.words.reasons import in_both_languages

_TITLE_LENGTH = 200  # a line in the lists of viewers; the description has all
LANGUAGES: tuple[Language, ...] = ("en", "zh")


def title_of(finding: Finding, language: Language) -> str:
    """One line: what, how it came out, and the first reason."""
    first = in_both_languages(finding.reasons[0]).in_language(language) if finding.reasons else ""
    return _title(finding, finding.verdict, first, language)


def own_titles(finding: Finding, comments: list[str]) -> Iterator[str]:
    """Every title that this program may have given a topic, whose comments of its own say what the reasons were."""
    for first in ("", *(comment.partition("\n")[0] for comment in comments)):
        for verdict in Verdict:
            yield from (_title(finding, verdict, first, language) for language in LANGUAGES)


def _title(finding: Finding, verdict: Verdict, first: str, language: Language) -> str:
    said = phrase(f"bcf.{verdict.value}", name=finding.name)
    if first:
        said = Phrase(f"{said.en}: {first}", f"{said.zh}：{first}")
    shown = said.in_language(language)
    return shown if len(shown) <= _TITLE_LENGTH else f"{shown[: _TITLE_LENGTH - 1]}…"


def comment_of(finding: Finding, language: Language) -> str:
    """Every reason, and the advice where the trial assembly did not pass."""
    said = [in_both_languages(reason) for reason in finding.reasons]
    repair, up = finding.column.repair, declared_up(finding.column)
    if repair:
        said.append(_joined(phrase("bcf.advice"), in_both_languages(repair.advice)))
    if up is not None and said:
        said.append(_joined(phrase("ui.as_declared"), Phrase(up, up)))
    return "\n".join(text.in_language(language) for text in said) or title_of(finding, language)


def closing_of(finding: Finding, report: JobReport, language: Language) -> str:
    """What is said when a topic is closed."""
    said = phrase("bcf.closed", name=finding.name, job=report.job["name"], number=report.job["sha256"][:12])
    return said.in_language(language)


def description_of(finding: Finding, report: JobReport, language: Language) -> str:
    """Which column, whether it goes on, by which tolerances, from which scans."""
    column = finding.column
    said = [
        _joined(phrase(name), Phrase(value, value))
        for name, value in (("ui.column", column.id), ("ui.storey", column.storey), ("ui.grid", column.grid))
        if value
    ]
    said.append(_joined(phrase("ui.goes_on"), phrase(f"verdict.{column.goes_on}")))
    title = report.profile.title or report.profile.name
    said.append(_joined(phrase("ui.profile"), profile_words(report.profile.name, title)))
    for kind, group in column.groups.items():
        said.append(_joined(phrase(f"ui.{kind.plural}"), Phrase(group.source, group.source)))
    also = [in_both_languages(one.text) for one in column.findings if not one.holds_back]
    said += [_joined(phrase("bcf.also"), text) for text in also]
    return "\n".join(text.in_language(language) for text in said)


def is_own_description(text: str) -> bool:
    """Whether this program wrote a description: it begins with the column, in one of its forms."""
    begins = tuple(f"{word}{sign}" for word, sign in zip(phrase("ui.column"), (": ", "："), strict=True))
    return not text or text.startswith((*begins, "Column "))


def _joined(word: Phrase, said: Phrase) -> Phrase:
    return Phrase(f"{word.en}: {said.en}", f"{word.zh}：{said.zh}")
