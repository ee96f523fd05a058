"""Write the results of a check into the IFC model, or take them out again.

The model keeps every line that it had; property sets, an inspection task, the state of the approval, a link to the
report and marks at the measured centres are put behind them. Written twice it is the same as written once, and with
--remove it is again the model from before, byte for byte.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ..switches import ALL_PASS, add_switches

if TYPE_CHECKING:
    from aadm_workbench.report.ifc.model import WriteBack

EXAMPLE = """\
examples:
  aadm writeback floor3-report/report.json floor3.ifc
  aadm writeback floor3-report/report.json floor3.ifc --in-place
  aadm writeback floor3-report/report.json floor3.ifc --out results/floor3.ifc --ids results/aadm.ids
  aadm writeback floor3-checked.ifc --remove"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.usage = (
        "aadm writeback REPORT.json MODEL.ifc [--out FILE | --in-place] [--force] [--ids FILE] [--json] [--quiet]\n"
        "       aadm writeback [REPORT.json] MODEL.ifc --remove [--out FILE | --in-place] [--json] [--quiet]"
    )
    parser.add_argument("report", type=Path, metavar="REPORT.json", help="the report of a check; not with --remove")
    parser.add_argument("model", type=Path, nargs="?", metavar="MODEL.ifc", help="the model that was checked")
    place = parser.add_mutually_exclusive_group()
    place.add_argument(
        "--out",
        type=Path,
        metavar="FILE",
        help="the file to write (default: MODEL-checked.ifc beside MODEL.ifc, with --remove MODEL-restored.ifc)",
    )
    place.add_argument(
        "--in-place", action="store_true", help="change MODEL.ifc itself; a copy is kept as MODEL.ifc.HASH.bak"
    )
    parser.add_argument("--remove", action="store_true", help="take the results out again")
    parser.add_argument("--force", action="store_true", help="write into a model that has changed since the check")
    parser.add_argument(
        "--ids", type=Path, metavar="FILE", help="also write the IDS with which any IDS checker verifies the results"
    )
    add_switches(parser, prints_json="what was written")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Write the results into a model, or take them out."""
    done = _remove(options) if options.remove else _write(options)
    if options.ids is not None:
        from aadm_workbench.own_files import write_atomically
        from aadm_workbench.report.ifc.model import ids_path

        write_atomically(options.ids, ids_path().read_bytes())
    _show(done, options)
    return ALL_PASS


def _write(options: argparse.Namespace) -> WriteBack:
    from aadm_workbench.errors import ReportError
    from aadm_workbench.report.read import read_report

    from ..model_results import write_results

    if options.model is None:
        raise ReportError.because("command.writeback_of_what", file=options.report)
    out = options.model if options.in_place else options.out or _beside(options.model, "checked")
    return write_results(read_report(options.report), options.report.parent, options.model, out, force=options.force)


def _remove(options: argparse.Namespace) -> WriteBack:
    from aadm_workbench.report.ifc.model import remove_ifc

    model: Path = options.model or options.report
    return remove_ifc(model, model if options.in_place else options.out or _beside(model, "restored"))


def _beside(model: Path, suffix: str) -> Path:
    """``floor3-checked.ifc`` beside ``floor3.ifc``, and ``floor3-restored.ifc`` beside that."""
    return model.with_name(f"{model.stem.removesuffix('-checked')}-{suffix}.ifc")


def _show(done: WriteBack, options: argparse.Namespace) -> None:
    from ..model_results import written_json, written_lines
    from ..shown.terminal import show, show_json

    if options.json:
        show_json(written_json(done))
    elif not options.quiet:
        show(*written_lines(done, options))
