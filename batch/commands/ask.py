"""Answer a question of the FreeCAD workbench, which runs no packages of its own. For programs, not for people.

QUESTION.json says under "about" what is asked: "columns" of a model or of shapes that FreeCAD has sampled, the "scan"
in a file, or the "camera" in one. The answer appears whole or not at all.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ..switches import ALL_PASS, add_switches

EXAMPLE = """\
examples:
  aadm ask question.json answer.json"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("question", type=Path, metavar="QUESTION.json", help="the question")
    parser.add_argument("answer", type=Path, metavar="ANSWER.json", help="where the answer is written")
    add_switches(parser, prints_json=None)
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Answer."""
    import json

    from aadm_workbench.errors import JobError
    from aadm_workbench.own_files import write_atomically

    from ..answers import ANSWERS

    try:
        question = json.loads(options.question.read_text(encoding="utf-8"))
        answer = ANSWERS[question["about"]]
    except (OSError, ValueError, LookupError, TypeError) as error:
        raise JobError.because("command.no_question", file=options.question, error=error) from error
    write_atomically(options.answer, json.dumps(answer(question), ensure_ascii=False).encode())
    return ALL_PASS
