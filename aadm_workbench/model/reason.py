"""A sentence for people as a value: its code, and what fills its places; every language from one table."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from enum import Enum
from functools import cache
from importlib import import_module
from string import Formatter
from typing import Literal, NamedTuple, TypeAlias

from aadm_workbench.model.sentences import Sentence

Language: TypeAlias = Literal["en", "zh"]
Value: TypeAlias = "str | tuple[str, ...]"
"""What fills a place: a text, a reason, or several of them; numbers are rounded already as the sentence wants them."""

_JOINED = {" ": (" ", ""), "and": (" and ", "和"), "or": (" or ", "或"), ";": ("; ", "；"), ".": (". ", "。")}
"""What several values of one place are joined by, English and Chinese, where its format says so; else by commas."""

_TEXTS = {"", "word", *_JOINED}
"""Formats of places that numbers fill as they are."""

_SAID = {"what", "why"}
"""Places in which a library puts another of its sentences."""


class Place(NamedTuple):
    """A text, and the place behind it: its name and its format; no name at the end of a sentence."""

    before: str
    name: str
    form: str


class Reason(str):
    """Why something is as it is: a code of the table of sentences, and the values that fill the sentence.

    As text it is the English sentence, which report.json holds; decisions go by ``code``, never by words.

    Parameters
    ----------
    code
        A key of the table, ``extract.plugged``; its first part is the file of :mod:`aadm_workbench.model.sentences`.
    values
        One for each place. Numbers are rounded by the format of the place; of texts, ``word`` says that they are words
        of the table of words, ``;``, ``.``, ``and`` and ``or`` what several of them are joined by.

    Raises
    ------
    KeyError
        For a code that the table does not have, or a place without a value.
    """

    __slots__ = ("code", "values")
    code: str
    values: Mapping[str, Value]

    def __new__(cls, code: str, /, **values: object) -> Reason:
        """Fill the English sentence; the values are kept as they stand in it."""
        places = _english(code)
        kept = {place.name: _kept(values[place.name], place.form) for place in places if place.name}
        reason = super().__new__(cls, _filled(places, kept, 0))
        _set(reason, "code", code)
        _set(reason, "values", kept)
        return reason

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"{name} of a reason cannot be set")

    def __reduce__(self) -> tuple[object, ...]:
        return _again, (self.code, dict(self.values))

    def in_language(self, language: Language) -> str:
        """The sentence in a language."""
        return str(self) if language == "en" else _filled(places_of(sentence(self.code)[1]), self.values, 1)


def listed(names: Sequence[str], most: int) -> Reason:
    """The first of some names, and how many more there are."""
    if len(names) > most:
        return Reason("said.and_more", shown=names[:most], count=len(names) - most)
    return Reason("said.list", parts=names)


def said_of(file: object, code: str, **values: object) -> Reason:
    """What is said of a file."""
    return Reason("said.of_file", file=file, why=Reason(code, **values))


def reason_of(error: BaseException) -> str:
    """The reason that an error was raised with; its text where that is none of the table."""
    return next((said for said in error.args[:1] if isinstance(said, Reason)), str(error))


def renamed(text: str, old: str, new: str) -> str:
    """A sentence in which one name, of a file, stands for another."""
    if not isinstance(text, Reason):
        return text.replace(old, new)
    values = {
        name: [renamed(part, old, new) for part in value] if isinstance(value, tuple) else renamed(value, old, new)
        for name, value in text.values.items()
    }
    return Reason(text.code, **values)


def codes_of(text: str) -> frozenset[str]:
    """The codes of a sentence, and of those that it holds; none of what is a mere text."""
    if not isinstance(text, Reason):
        return frozenset()
    parts = [part for value in text.values.values() for part in (value if isinstance(value, tuple) else (value,))]
    return frozenset({text.code}).union(*map(codes_of, parts))


def in_one(sentences: Iterable[str]) -> str:
    """Several sentences as one; empty where there is none."""
    parts = list(dict.fromkeys(sentences))
    return Reason("said.all", parts=parts) if len(parts) > 1 else next(iter(parts), "")


def sentence(code: str) -> Sentence:
    """A sentence with its places in braces, English and Chinese."""
    return sentences_of(code.partition(".")[0])[code]


@cache
def sentences_of(room: str) -> dict[str, Sentence]:
    """All sentences of one file of the table, by their codes."""
    table: dict[str, Sentence] = import_module(f"aadm_workbench.model.sentences.{room}").SENTENCES
    return table


def as_said_by(library: str, words: str) -> Reason:
    """What a library says in English, as the sentence that has these words; ``other`` where none has.

    ``library`` is what the codes of its sentences begin with: ``bounded.toml``.
    """
    for code, names, pattern in _patterns_of(library):
        if found := pattern.fullmatch(words):
            said = zip(names, found.groups(), strict=True)
            return Reason(code, **{name: as_said_by(library, text) if name in _SAID else text for name, text in said})
    return Reason(f"{library}.other", words=words)


@cache
def _patterns_of(library: str) -> list[tuple[str, list[str], re.Pattern[str]]]:
    """Code, places and pattern of each sentence of a library: those that hold another one first, then the longest."""
    found = []
    for code, told in sentences_of(library.partition(".")[0]).items():
        if not code.startswith(f"{library}."):
            continue
        places = places_of(told.en)
        pattern = "".join(re.escape(place.before) + "(.+?)" * bool(place.name) for place in places)
        found.append((code, [place.name for place in places if place.name], re.compile(pattern, re.DOTALL)))
    return sorted(found, key=lambda one: (_SAID.isdisjoint(one[1]), -len(one[2].pattern)))


@cache
def places_of(text: str) -> tuple[Place, ...]:
    """The places of a sentence, and the texts before them."""
    return tuple(Place(before, name or "", form or "") for before, name, form, _ in Formatter().parse(text))


_set = object.__setattr__


@cache
def _english(code: str) -> tuple[Place, ...]:
    return places_of(sentence(code)[0])


def _again(code: str, values: dict[str, Value]) -> Reason:
    return Reason(code, **values)


def _kept(value: object, form: str) -> Value:
    if isinstance(value, float):  # most are: no other question is asked of them
        return str(value) if form in _TEXTS else format(value, form)
    if isinstance(value, str) and not isinstance(value, Enum):
        return value
    if isinstance(value, BaseException):
        return reason_of(value)
    parts = tuple(value) if isinstance(value, Iterable) else ()
    if parts and all(isinstance(part, str) for part in parts):
        return parts
    plain = value.value if isinstance(value, Enum) else value
    return str(plain) if form in _TEXTS else format(plain, form)


def _filled(places: tuple[Place, ...], values: Mapping[str, Value], language: int) -> str:
    parts: list[str] = []
    for before, name, form in places:
        parts.append(before)
        if name:
            parts.append(_shown(values[name], form, language))
    return "".join(parts)


def _shown(value: Value, form: str, language: int) -> str:
    if isinstance(value, tuple):
        return _JOINED.get(form, (", ", "、"))[language].join(_shown(one, form, language) for one in value)
    if isinstance(value, Reason):
        return value.in_language("zh") if language else str(value)
    return sentences_of("words").get(f"words.{value}", (value, value))[language] if form == "word" else value
