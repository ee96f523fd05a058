"""``aadm study distance|height|angle|spacing|conditions``: the paper's studies of alignment during hoisting."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .exit_codes import ALL_PASS
from .job.command import METHODS
from .switches import add_switches, whole_number

if TYPE_CHECKING:
    from aadm_workbench.twin.study.hoisting import HoistingStudy

_STUDIES = {
    "distance": "hoisting: errors over the distance of the camera (Table 3, Fig. 16)",
    "height": "hoisting: errors over the height of the foot above the bars (Table 4, Fig. 17)",
    "angle": "hoisting: errors over the angle of the column (Table 5, Fig. 18)",
    "spacing": "hoisting: errors over the planar spacing (Table 6, Fig. 19)",
    "conditions": "hoisting: methods in the paper's conditions and in the field (Tables 7 to 9, 12, Figs. 20, 21)",
}


def add_hoisting_studies(kinds: Any, prepare: Callable[[argparse.Namespace], None]) -> None:
    """Declare the studies; ``prepare`` refuses what cannot work before hours of rendering."""
    for name, about in _STUDIES.items():
        parser = kinds.add_parser(
            name,
            help=about,
            description=f"{about[0].upper()}{about[1:]}, on synthetic frames of known truth.",
            epilog=f"example:\n  aadm study {name} --scenes 5 --out study",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        parser.add_argument(
            "--scenes", type=whole_number, default=5, metavar="N", help="random scenes of each cell (default: 5)"
        )
        parser.add_argument("--seed", type=int, default=0, metavar="S", help="another seed, other scenes (default: 0)")
        default = METHODS if name == "conditions" else METHODS[:2]
        parser.add_argument(
            "--methods", nargs="+", choices=METHODS, default=list(default), metavar="M", help=f"of {', '.join(METHODS)}"
        )
        parser.add_argument("--out", type=Path, metavar="DIR", help="folder for summary.json and plots")
        add_switches(parser, prints_json="the numbers")
        parser.set_defaults(run=_study, study=name, prepare=prepare)


def _study(options: argparse.Namespace) -> int:
    options.prepare(options)
    from aadm_workbench.report.json import encode
    from aadm_workbench.twin.study.hoisting import cells_of, study_hoisting

    from .shown.progress import StepProgress
    from .shown.study_hoisting_tables import hoisting_document, hoisting_tables
    from .shown.terminal import show, show_json

    cells = cells_of(options.study)
    with StepProgress("rendering", quiet=options.quiet) as progress:
        study = study_hoisting(
            options.study,
            cells,
            list(dict.fromkeys(options.methods)),
            scenes=options.scenes,
            seed=options.seed,
            finished=progress.start(options.scenes * len(cells)),
        )
    summary = encode(hoisting_document(study))
    written = [] if options.out is None else _write(study, summary, options.out)
    if options.json:
        show_json(summary)
    elif not options.quiet:
        show(*hoisting_tables(study))
        if written:
            show("", f"Wrote {', '.join(path.name for path in written)} to {options.out}")
    return ALL_PASS


def _write(study: HoistingStudy, summary: bytes, folder: Path) -> list[Path]:
    from aadm_workbench.atomic import write_atomically
    from aadm_workbench.twin.study.hoisting_plots import write_hoisting_plots

    path = folder / f"{study.name}.json"
    write_atomically(path, summary)
    return [path, *write_hoisting_plots(study, folder)]
