"""The sentences of a report in both languages.

report.json holds English sentences. Each is one of the table, filled: read back by it, it is the reason again that it
was, with its code, values and Chinese. What the table does not know stays a text, so that nothing is lost.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache, lru_cache
from pkgutil import iter_modules
from typing import NamedTuple

import aadm_workbench.model.sentences
from aadm_workbench.model import Reason
from aadm_workbench.model.reason import Place, places_of, sentences_of
from aadm_workbench.report.words.labels import Phrase

_NAME = "(?:(?![;:] ).)+?"
_VALUES = {"": _NAME, "word": _NAME, " ": ".+?", "and": ".+?", ";": ".+?", ".": ".+?"}
"""What stands in the place of a text, by its format; in any other stands a number."""
_SENTENCES = {"notes", "plan", "remedy", "said", "what", "why"}
"""Places that other sentences stand in; names and labels hold no sign that parts sentences."""
_LONGEST_SENTENCE = 1000
"""Characters: ours have at most some hundred, and patterns take a time that grows with their square."""
_KEPT = 4096  # sentences: those of some hundred columns, which repeat each other


class _Known(NamedTuple):
    """A sentence of the table: ``longest`` is the longest text between its places, and part of every filling.

    ``literal`` is the length of all texts between its places.
    """

    code: str
    english: str
    longest: str
    literal: int


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
    for known in _table():
        if known.longest in text and (found := _pattern(known.english).fullmatch(text)):
            places = [place for place in places_of(known.english) if place.name]
            return Reason(known.code, **{place.name: _value(found[place.name], place) for place in places})
    return None


def _value(text: str, place: Place) -> str | list[str]:
    if place.form not in _VALUES:
        return text
    sign = {"and": " and ", ";": "; ", ".": ". "}.get(place.form)
    return [_recognised(part) for part in text.split(sign)] if sign else _recognised(text)


def _parts(pieces: list[str]) -> list[str]:
    """Pieces as sentences: a sentence may hold the sign that parts them, so the longest one is tried first."""
    for count in range(len(pieces), 0, -1):
        found = _one("; ".join(pieces[:count]))
        if found is not None or count == 1:
            return [found or pieces[0], *_parts(pieces[count:])]
    return []


@cache
def _table() -> tuple[_Known, ...]:
    """All sentences but those that only put others together; the longest first, for one may begin as another does."""
    rooms = [module.name for module in iter_modules(aadm_workbench.model.sentences.__path__)]
    known = [
        _known(code, sentence.en) for room in rooms if room != "words" for code, sentence in sentences_of(room).items()
    ]
    plain = [one for one in known if one.longest.strip(" ;:,–")]
    return tuple(sorted(plain, key=lambda one: (-one.literal, one.code)))


def _filling(name: str, form: str) -> str:
    """What matches a value in a place."""
    if form in _VALUES:
        return ".+?" if name in _SENTENCES else _VALUES[form]
    digits = re.search(r"\.(\d)[f%]", form)
    if digits is None:
        return r"[-+]?(?:\d[\d.]*(?:e[-+]?\d+)?|nan|inf)"
    decimals = rf"\.\d{{{digits[1]}}}" if digits[1] != "0" else ""
    return rf"[-+]?(?:\d+{decimals}|nan|inf){'%' if form.endswith('%') else ''}"


def _known(code: str, english: str) -> _Known:
    texts = [place.before for place in places_of(english)]
    return _Known(code, english, max(texts, key=len), sum(map(len, texts)))


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
