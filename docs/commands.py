"""Writes the reference of all commands from the command line itself: python docs/commands.py.

What stands in docs/commands.md is what ``--help`` says, so neither can be wrong without the other.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from batch.main import build_parser

PAGE = Path(__file__).with_name("commands.md")
_BEGIN = """\
# Every command and option

[中文](zh/commands.md)

Written by `docs/commands.py` from what `aadm COMMAND --help` says. `aadm --version` says which version you have, and
`-h` or `--help` of each command shows an example. Exit codes: [verdicts](verdicts.md#exit-codes).

"""


def commands(parser: argparse.ArgumentParser) -> Iterator[tuple[str, argparse.ArgumentParser]]:
    """Every command with its parser, ``aadm study methods``, in the order of the help."""
    groups = [action for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
    if not groups:
        yield parser.prog.partition(" JOB")[0], parser
    for group in groups:
        for name, inner in group.choices.items():
            for _, found in commands(inner):
                yield f"aadm {name}" if found is inner else f"aadm {name} {found.prog.split()[-1]}", found


def options(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """The arguments of a command, but for its help."""
    yield from (action for action in parser._actions if not isinstance(action, argparse._HelpAction))


def spelling(action: argparse.Action) -> str:
    """An argument as one types it: ``--only ID``, ``MODEL``."""
    metavar = action.metavar if isinstance(action.metavar, str) else ""
    if not action.option_strings:
        return metavar or action.dest
    if action.nargs == 0:
        return ", ".join(action.option_strings)
    listed = f"{{{','.join(map(str, action.choices))}}}" if action.choices else action.dest.upper()
    return f"{', '.join(action.option_strings)} {metavar or listed}"


def section(name: str, parser: argparse.ArgumentParser) -> str:
    """One command: what it does, its arguments, its examples."""
    rows = [f"| `{spelling(action)}` | {escaped(action.help or '')} |" for action in options(parser)]
    table = "\n".join(["| argument | what it says |", "|---|---|", *rows])
    examples = [line.strip() for line in (parser.epilog or "").splitlines() if line.strip().startswith("aadm ")]
    shown = "\n".join(["", "```sh", *examples, "```", ""]) if examples else ""
    return f"## {name}\n\n{(parser.description or '').strip()}\n{shown}\n{table}\n"


def escaped(text: str) -> str:
    """Text that a cell of a table can hold."""
    return text.replace("|", "\\|").replace("%%", "%").replace("*", "\\*")


def page() -> str:
    """The whole page."""
    return _BEGIN + "\n".join(section(name, parser) for name, parser in commands(build_parser()))


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
