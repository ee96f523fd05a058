"""Every sentence for people by its code; the first part of a code is the file that has it."""

from __future__ import annotations

from typing import NamedTuple


class Sentence(NamedTuple):
    """A sentence in both languages; the places in braces are the same in both, and filled with the same values."""

    en: str
    zh: str
