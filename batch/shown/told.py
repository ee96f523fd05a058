"""What the command says, in the language that was asked for, or that of the environment: errors, tables, lines."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from aadm_workbench.errors import AadmError

from ..switches import spoken

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.model.reason import Language


def told(error: BaseException, options: argparse.Namespace) -> str:
    """The reason of an error in the language of ``--language``, where a command has that, else of the environment."""
    if spoken(getattr(options, "language", None)) == "en" or not isinstance(error, AadmError):
        return str(error)
    from aadm_workbench.report.words.reasons import in_both_languages

    return in_both_languages(error.reason).zh


def words_for(options: argparse.Namespace, section: str) -> Words:
    """The words of a command, in the language of ``--language``, where it has that, else of the environment."""
    return Words(spoken(getattr(options, "language", None)), section)


@dataclass(frozen=True)
class Words:
    """Words in one language; ``section`` is that of ``words*.toml`` in which names without a dot stand."""

    language: Language
    section: str

    def __call__(self, name: str, /, **values: object) -> str:
        """One text, its ``{places}`` filled in; none for no name."""
        from aadm_workbench.report.words.labels import phrase

        full = name if "." in name else f"{self.section}.{name}"
        return phrase(full, **values).in_language(self.language) if name else ""

    def counted(self, name: str, number: int, /, **values: object) -> str:
        """A text with a number in it: that called ``one_NAME`` for one."""
        return self(f"one_{name}" if number == 1 else name, number=number, **values)

    def table(self, *names: str, numbers: tuple[str, ...] = (), title: str | None = None) -> Table:
        """An empty table by the names of its headings; columns of ``numbers`` are set flush right."""
        from .terminal import new_table

        headings = {name: self(name) for name in names}
        return new_table(*headings.values(), numbers=tuple(headings[name] for name in numbers), title=title)

    def said(self, sentence: str) -> str:
        """A sentence of the table of sentences; what that does not know stays as it is."""
        if self.language == "en":
            return str(sentence)
        from aadm_workbench.report.words.reasons import in_both_languages

        return in_both_languages(sentence).zh

    def word(self, english: str) -> str:
        """A word that fills places of sentences, or a verdict."""
        if self.language == "en":
            return english.replace("_", " ")
        from aadm_workbench.model.reason import sentences_of

        return sentences_of("words").get(f"words.{english}", (english, english))[1]

    def of(self, about: str, said: str) -> str:
        """What is said of something."""
        return f"{about}: {said}" if self.language == "en" else f"{about}：{said}"

    def joined(self, sentences: Iterable[str]) -> str:
        """Several sentences as one."""
        return ("; " if self.language == "en" else "；").join(map(self.said, sentences))

    def listed(self, names: tuple[str, ...] | list[str]) -> str:
        """Names in a row."""
        return (", " if self.language == "en" else "、").join(names)
