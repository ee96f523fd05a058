"""``aadm``: parses the command line and runs one command.

Heavy packages are imported by the commands when they run, so that the command line itself answers at once.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Collection, Sequence
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, NoReturn, Protocol, cast

from aadm_workbench import __version__
from aadm_workbench.errors import AadmError

from .switches import BAD_USAGE, INTERNAL, INTERRUPTED, calculate_in_one_thread, printable, spoken

if TYPE_CHECKING:
    from aadm_workbench.model.reason import Language


class Command(Protocol):
    """What a module of ``commands/`` offers."""

    EXAMPLE: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare arguments, and the function that runs the command as ``run``."""


COMMANDS = MappingProxyType(
    {
        "check": "check the columns of a job",
        "match": "find out which column goes on which bars",
        "watch": "measure each new hoisting frame in a folder",
        "cameras": "list the cameras that are there",
        "capture": "take frames with a live camera",
        "link": "show the hoisting state to machines, read only",
        "plan": "say where to put the camera while a column hangs",
        "design": "list the sleeves and rebars of a model",
        "extract": "find the points in one scan",
        "simulate": "make synthetic scans with known truth",
        "study": "measure methods on synthetic scans of known truth",
        "report": "make HTML, PDF, XLSX, CSV, BCF, crew pages and scan cards from a report",
        "diff": "say what changed between two inspections",
        "stack": "say what set columns do to beams and to the next storey",
        "camera": "draw a plate, learn a camera from captures of it, verify it later",
        "gauge": "study repeat captures: what the camera repeats, and whether its u is to be believed",
        "writeback": "write the results of a check into the IFC model",
        "profiles": "list tolerance profiles and their rules",
        "doctor": "say what is installed and what is missing",
        "ask": "answer a question of the FreeCAD workbench",
    }
)
"""By the name of their module: what each does."""

_EXIT_CODES = """\
exit codes:
  0 all pass   10 some column fails   11 some is inconclusive or not measured   12 some ended in an error
  2 bad usage, job text or model: nothing was checked   70 internal error, or results could not be written
  130 interrupted: what was checked is kept, --resume goes on"""


class _ChineseParser(argparse.ArgumentParser):
    """Says in Chinese what is wrong with a command line; so do the parsers of its commands."""

    def error(self, message: str) -> NoReturn:
        """End with the usage, and with what is wrong."""
        from aadm_workbench.model import Reason
        from aadm_workbench.model.reason import as_said_by

        begin = Reason("command.usage.usage")
        wrong = Reason("command.usage.error", program=self.prog, what=as_said_by("command.usage", message))
        usage = self.format_usage().removeprefix(begin)
        self.exit(BAD_USAGE, printable(f"{begin.in_language('zh')}{usage}{wrong.in_language('zh')}\n"))


def build_parser(wanted: Collection[str] = COMMANDS.keys(), language: Language = "en") -> argparse.ArgumentParser:
    """The parser of the whole command line; commands that are not ``wanted`` are listed, without their arguments."""
    kind = _ChineseParser if language == "zh" else argparse.ArgumentParser
    parser = kind(
        prog="aadm",
        description="Checks precast columns before they are hoisted: grouting sleeves against connecting rebars.",
        epilog=f"example:\n  aadm check floor3.toml\n\n{_EXIT_CODES}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"aadm {__version__}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, summary in COMMANDS.items():
        found = commands.add_parser(name, help=summary, formatter_class=argparse.RawDescriptionHelpFormatter)
        if name in wanted:
            command = cast(Command, import_module(f"{__package__}.commands.{name}"))
            found.description, found.epilog = command.__doc__, command.EXAMPLE
            command.add_arguments(found)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code; bad usage ends in ``SystemExit(2)``."""
    _never_fail_on_a_sign()
    calculate_in_one_thread()
    words = sys.argv[1:] if arguments is None else arguments
    command = [word for word in words if not word.startswith("-")][:1]
    options = build_parser(command, _language_of(words)).parse_args(words)
    try:
        code: int = options.run(options)
    except AadmError as error:
        if options.debug and error.__cause__ is not None:
            _show_trace()
        from .shown.told import told

        _say(told(error, options))
        return BAD_USAGE
    except KeyboardInterrupt:
        from .shown.told import words_for

        _say(words_for(options, "told")("interrupted"))
        return INTERRUPTED
    except Exception as error:  # noqa: BLE001 - this is the outermost boundary
        if options.debug:
            _show_trace()
        _say(_internal(error, options))
        return INTERNAL
    return code


def _internal(error: Exception, options: argparse.Namespace) -> str:
    """What is said of an error that nobody foresaw; in English where the words themselves cannot be read."""
    what = f"{type(error).__name__}: {error}"
    try:
        from .shown.told import words_for

        return words_for(options, "told")("internal" if options.debug else "internal_where", what=what)
    except Exception:  # noqa: BLE001 - the error itself is what has to be said
        hint = "" if options.debug else "; repeat the command with --debug to see where it happened"
        return f"internal error: {what}{hint}"


def _language_of(words: Sequence[str]) -> Language:
    """The language that a command line asks for, as far as one can tell before it is known to be one."""
    asked = None
    for word, following in zip(words, [*words, ""][1:], strict=True):
        name, sign, value = word.partition("=")
        if name.startswith("--l") and "--language".startswith(name):
            asked = value if sign else following
    return spoken(asked)


def _never_fail_on_a_sign() -> None:
    """A terminal that lacks a sign shows a question mark instead."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


def _show_trace() -> None:
    import traceback

    traceback.print_exc()


def _say(message: str) -> None:
    sys.stderr.write(f"aadm: {printable(message)}\n")


if __name__ == "__main__":
    raise SystemExit(main())
