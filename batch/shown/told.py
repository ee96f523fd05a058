"""Errors as the command says them: in English, or in the language that was asked for."""

from __future__ import annotations

import argparse

from aadm_workbench.errors import AadmError


def told(error: BaseException, options: argparse.Namespace) -> str:
    """The reason of an error in the language of ``--language``, where a command has that, else in English."""
    if getattr(options, "language", None) != "zh" or not isinstance(error, AadmError):
        return str(error)
    from aadm_workbench.report.words.reasons import in_both_languages

    return in_both_languages(error.reason).zh
