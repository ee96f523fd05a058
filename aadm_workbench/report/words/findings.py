"""The sentences of findings in Chinese: found by their English, of which one table holds both."""

from __future__ import annotations

import re
from functools import cache

from aadm_workbench.model.finding_sentences import FINDING_SENTENCES, FINDING_WORDS

_PLACE = re.compile(r"\{(\w+)(?::[^}]*)?\}")


def finding_in_chinese(text: str) -> str:
    """A text in which every sentence of a finding is told in Chinese; all else stays as it is."""
    for pattern, chinese in _patterns():
        text = pattern.sub(lambda found, told=chinese: _filled(told, found), text)  # type: ignore[misc]
    return text


@cache
def _patterns() -> tuple[tuple[re.Pattern[str], str], ...]:
    # The longest first: one sentence may begin as another does.
    ordered = sorted(FINDING_SENTENCES.values(), key=lambda sentence: -len(sentence.en))
    return tuple((_pattern(sentence.en), sentence.zh) for sentence in ordered)


def _pattern(english: str) -> re.Pattern[str]:
    """What matches a sentence with any values; the same place twice must hold the same value."""
    parts, end, known = [], 0, set()
    for place in _PLACE.finditer(english):
        parts.append(re.escape(english[end : place.start()]))
        name, end = place[1], place.end()
        parts.append(f"(?P={name})" if name in known else f"(?P<{name}>.+?)")
        known.add(name)
    last = re.escape(english[end:])
    return re.compile("".join([*parts, last]) + ("" if last else "$"))


def _filled(chinese: str, found: re.Match[str]) -> str:
    values = {name: FINDING_WORDS.get(value, value) for name, value in found.groupdict().items()}
    if "about" in values:
        values["about"] = ", ".join(FINDING_WORDS.get(one, one) for one in found["about"].split(", "))
    return _PLACE.sub(lambda place: values.get(place[1], place[0]), chinese)
