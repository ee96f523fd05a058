"""List the tolerance profiles, or the rules of one.

A rule that is marked unverified was recalled or taken from a secondary source: the text of its clause was not opened.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ..switches import ALL_PASS, add_switches

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.model import Profile, Rule

EXAMPLE = """\
examples:
  aadm profiles
  aadm profiles cn
  aadm profiles our-yard.toml --json"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("name", nargs="?", metavar="NAME", help="a built-in profile, or the path of a .toml file")
    add_switches(parser, prints_json="profiles with their rules")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print profiles."""
    from aadm_workbench.assembly.tolerances import load_profile, profile_names
    from aadm_workbench.report.json import encode, profile_document

    from ..shown.terminal import show, show_json

    names = profile_names() if options.name is None else (options.name,)
    profiles = [load_profile(name, Path()) for name in names]
    if options.json:
        show_json(encode({"profiles": [profile_document(profile) for profile in profiles]}))
    elif not options.quiet:
        if options.name is None:
            show(_profile_table(profiles))
        else:
            show(profiles[0].title, "", _rule_table(profiles[0]), *_notes(profiles[0]))
    return ALL_PASS


def _profile_table(profiles: list[Profile]) -> Table:
    from ..shown.terminal import new_table

    table = new_table("Profile", "Rules", "Unverified", "Title", numbers=("Rules", "Unverified"))
    for profile in profiles:
        unverified = sum(rule.source != "verified" for rule in profile.rules)
        table.add_row(profile.name, str(len(profile.rules)), str(unverified), profile.title)
    return table


def _rule_table(profile: Profile) -> Table:
    from ..shown.terminal import new_table

    table = new_table("Rule", "Limit mm", "How", "Clause", "Severity", "Source", numbers=("Limit mm",))
    for rule in profile.rules:
        source = f"{rule.source}, advisory" if rule.advisory else rule.source
        table.add_row(rule.name, _limit(rule), rule.kind.replace("_", " "), rule.clause, rule.severity, source)
    return table


def _limit(rule: Rule) -> str:
    if rule.kind != "signed":
        return f"{rule.upper:g}"
    return f"{'' if rule.lower is None else f'{rule.lower:+g}'} … {rule.upper:+g}"


def _notes(profile: Profile) -> list[str]:
    notes = [f"{rule.name}: {rule.note}" for rule in profile.rules if rule.note]
    return ["", *notes] if notes else []
