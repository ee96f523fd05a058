"""Errors as the command says them: in the language that was asked for, or that of the environment."""

from __future__ import annotations

import argparse

from aadm_workbench.errors import AadmError

from ..switches import spoken


def told(error: BaseException, options: argparse.Namespace) -> str:
    """The reason of an error in the language of ``--language``, where a command has that, else of the environment."""
    if spoken(getattr(options, "language", None)) == "en" or not isinstance(error, AadmError):
        return str(error)
    from aadm_workbench.report.words.reasons import in_both_languages

    return in_both_languages(error.reason).zh
