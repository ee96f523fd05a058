"""The demo's last step: compares the verdicts of a check with those that its sample was made to have.

Example: ``python -m aadm_batch.demo_verdicts samples/floor/truth.json build/demo-report/report.json --exit-code 12``
"""

from __future__ import annotations

import argparse
import json
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from aadm_workbench.model import Verdict

from .switches import exit_code_of

MISSING = "missing"


@dataclass(frozen=True)
class Comparison:
    """One column: the verdict that its sample was made to have, and the one that the check came to.

    ``story`` says what the sample was made with.
    """

    column: str
    expected: str
    got: str
    story: str = ""

    @property
    def agrees(self) -> bool:
        """Whether the check came to what was expected."""
        return self.expected == self.got


def compare(truth: Path, report: Path) -> list[Comparison]:
    """Verdicts of two files, column by column in the report's order, then those that one of the files lacks.

    Parameters
    ----------
    truth
        JSON file of a sample: ``{"columns": {ID: {"verdict": ..., "story": ...}}}``.
    report
        report.json of a check.
    """
    made = json.loads(truth.read_text("utf-8"))["columns"]
    got = {column["id"]: column["verdict"] for column in json.loads(report.read_text("utf-8"))["columns"]}
    nothing = {"verdict": MISSING}
    names = [*got, *(name for name in made if name not in got)]
    return [
        Comparison(
            name, (sample := made.get(name, nothing))["verdict"], got.get(name, MISSING), sample.get("story", "")
        )
        for name in names
    ]


def table_of(comparisons: list[Comparison]) -> Table:
    """The comparison for a terminal."""
    table = Table("Column", "Made so that", "Expected", "Got", "")
    for comparison in comparisons:
        sign = "[green]agrees[/]" if comparison.agrees else "[red]DIFFERS[/]"
        table.add_row(escape(comparison.column), escape(comparison.story), comparison.expected, comparison.got, sign)
    return table


def main(arguments: list[str] | None = None) -> int:
    """Print the comparison; 0 where every verdict and the exit code of the check agree, else 1."""
    parser = argparse.ArgumentParser(prog="python -m aadm_batch.demo_verdicts", description=__doc__)
    parser.add_argument("truth", type=Path, help="truth.json of the sample")
    parser.add_argument("report", type=Path, help="report.json of the check")
    parser.add_argument("--exit-code", type=int, required=True, help="what aadm check ended with")
    options = parser.parse_args(arguments)
    console = Console()
    if not options.report.is_file():
        console.print(f"aadm check ended with {options.exit_code} and wrote no report", style="red", markup=False)
        return 1
    comparisons = compare(options.truth, options.report)
    console.print(table_of(comparisons))
    console.print(f"Report: {options.report.parent}", markup=False, soft_wrap=True)
    differing = sum(not comparison.agrees for comparison in comparisons)
    owed = exit_code_of(Verdict(comparison.expected) for comparison in comparisons if comparison.expected != MISSING)
    if differing or not comparisons:
        console.print(f"{differing} of {len(comparisons)} verdicts differ from the truth", style="red", markup=False)
    elif options.exit_code != owed:
        console.print(f"aadm check ended with {options.exit_code}; its verdicts call for {owed}", style="red")
    else:
        console.print(f"All {len(comparisons)} verdicts are as the sample was made", style="green", markup=False)
        return 0
    return 1


if __name__ == "__main__":
    raise SystemExit(main())
