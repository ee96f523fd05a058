"""The sentences of a report in both languages.

report.json holds English sentences. Each is one of the table, filled: read back by it, it is the reason again that it
was, with its code, values and Chinese. What the table does not know stays a text, so that nothing is lost.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache, lru_cache
from pkgutil import iter_modules

import aadm_workbench.model.sentences
from aadm_workbench.model import Reason
from aadm_workbench.model.reason import Place, places_of, sentences_of
from aadm_workbench.report.words.labels import Phrase

_NAME = "(?:(?![;:] ).)+?"
_VALUES = {"": _NAME, "word": _NAME, " ": ".+?", "and": ".+?", "or": ".+?", ";": ".+?", ".": ".+?"}
"""What stands in the place of a text, by its format; in any other stands a number."""
_SENTENCES = {"notes", "plan", "remedy", "said", "what", "why"}
"""Places that other sentences stand in; names and labels hold no sign that parts sentences."""
_LONGEST_SENTENCE = 1000
"""Characters: ours have at most some hundred, and patterns take a time that grows with their square."""
_MOST_PIECES = 8  # that one sentence consists of: a text of nothing but such signs would take for ever
_KEPT = 4096  # sentences: those of some hundred columns, which repeat each other


def in_both_languages(sentence: str) -> Phrase:
    """A sentence of report.json, and its Chinese as far as the table knows it."""
    reason = recognised(sentence)
    return Phrase(str(sentence), reason.in_language("zh") if isinstance(reason, Reason) else sentence)


def recognised(sentence: str) -> str:
    """A sentence as the reason that it is; as it stands where it is none."""
    return sentence if isinstance(sentence, Reason) else _recognised(sentence)


@lru_cache(_KEPT)
def _recognised(text: str) -> str:
    if len(text) > _LONGEST_SENTENCE:
        return text
    one = _one(text)
    if one is not None:
        return one
    parts = _parts(text.split("; "))
    known = len(parts) > 1 and any(isinstance(part, Reason) for part in parts)
    return Reason("said.all", parts=parts) if known else text


def _one(text: str) -> Reason | None:
    """One sentence of the table, or of whom one is told."""
    found = _of_table(text)
    what, colon, why = text.partition(": ")
    if found is not None or not colon or "; " in what:
        return found
    told = _one(why)
    return None if told is None else Reason("said.of", what=what, why=told)


def _of_table(text: str) -> Reason | None:
    for longest, code, english in _table():
        if longest in text and (found := _pattern(english).fullmatch(text)):
            places = [place for place in places_of(english) if place.name]
            return Reason(code, **{place.name: _value(found[place.name], place) for place in places})
    return None


def _value(text: str, place: Place) -> str | list[str]:
    if place.form not in _VALUES or (place.form == "word" and f"words.{text}" in sentences_of("words")):
        return text
    sign = {"and": " and ", "or": " or ", ";": "; ", ".": ". "}.get(place.form)
    return [_recognised(part) for part in text.split(sign)] if sign else _recognised(text)


def _parts(pieces: list[str]) -> list[str]:
    """Pieces as sentences: a sentence may hold the sign that parts them, so the longest one is tried first."""
    for count in range(min(len(pieces), _MOST_PIECES), 0, -1):
        found = _one("; ".join(pieces[:count]))
        if found is not None or count == 1:
            return [found or pieces[0], *_parts(pieces[count:])]
    return []


@cache
def _table() -> tuple[tuple[str, str, str], ...]:
    """All sentences but those that only put others together: the longest text between their places, code, English.

    The longest sentence comes first, for one may begin as another does.
    """
    rooms = [module.name for module in iter_modules(aadm_workbench.model.sentences.__path__)]
    found = [(code, told.en) for room in rooms if room != "words" for code, told in sentences_of(room).items()]
    found.sort(key=lambda one: (-sum(map(len, _texts(one[1]))), one[0]))
    known = [(max(_texts(english), key=len), code, english) for code, english in found]
    return tuple(one for one in known if one[0].strip(" ;:,–"))


def _texts(english: str) -> list[str]:
    return [place.before for place in places_of(english)]


def _filling(name: str, form: str) -> str:
    """What matches a value in a place."""
    if form in _VALUES:
        return ".+?" if name in _SENTENCES else _VALUES[form]
    digits = re.search(r"\.(\d)[f%]", form)
    if digits is None:
        return r"[-+]?(?:\d[\d.]*(?:e[-+]?\d+)?|nan|inf)"
    decimals = rf"\.\d{{{digits[1]}}}" if digits[1] != "0" else ""
    return rf"[-+]?(?:\d+{decimals}|nan|inf){'%' if form.endswith('%') else ''}"


@cache
def _pattern(english: str) -> re.Pattern[str]:
    return re.compile("".join(_patterns(places_of(english))), re.DOTALL)


def _patterns(places: tuple[Place, ...]) -> Iterator[str]:
    """What matches a sentence with any values; the same place twice must hold the same value."""
    seen: set[str] = set()
    for before, name, form in places:
        yield re.escape(before)
        if name:
            yield f"(?P={name})" if name in seen else f"(?P<{name}>{_filling(name, form)})"
        seen.add(name)
