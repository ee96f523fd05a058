"""The one place where findings are made: a code, what it is about, its values, and the sentence that they fill."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from aadm_workbench.model import Finding
from aadm_workbench.model.finding_sentences import FINDING_SENTENCES


def make_finding(name: str, about: Sequence[str], **values: Any) -> Finding:
    """A finding that holds back, whose sentence is ``name``, a code with or without a part after a dot.

    Parameters
    ----------
    name
        A key of :data:`~aadm_workbench.model.finding_sentences.FINDING_SENTENCES`.
    about
        Labels of points, or ``sleeves``, ``rebars``, ``column``.
    values
        What the sentence says; numbers as they are, the sentence rounds them.
    """
    text = FINDING_SENTENCES[name].en.format(about=", ".join(about), **values)
    return Finding(name.partition(".")[0], tuple(about), values, text, holds_back=True)
