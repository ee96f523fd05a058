"""Measure how exact and how fast the methods are, on synthetic scans whose truth is known."""

from __future__ import annotations

import argparse
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..job.command import METHODS, SCAN_METHODS
from ..study_loop import add_loop_study
from ..switches import ALL_PASS, add_switches, whole_number

if TYPE_CHECKING:
    from aadm_workbench.twin.study.hoisting import HoistingStudy
    from aadm_workbench.twin.study.methods import MethodStudy

EXAMPLE = """\
example:
  aadm study methods --setting lab --scenes 5 --out study"""
_METHODS = "all methods over random scenes, beside the tables of the paper"
_METHODS_EXAMPLE = """\
examples:
  aadm study methods --setting both --scenes 20 --out study
  aadm study methods --setting field --scenes 3 --methods refined fusion --json"""
_PACKAGES = ("manifold3d", "open3d")
_SETTINGS = ("lab", "field")

_STUDIES = {
    "distance": "hoisting: errors over the distance of the camera (Table 3, Fig. 16)",
    "height": "hoisting: errors over the height of the foot above the bars (Table 4, Fig. 17)",
    "angle": "hoisting: errors over the angle of the column (Table 5, Fig. 18)",
    "spacing": "hoisting: errors over the planar spacing (Table 6, Fig. 19)",
    "conditions": "hoisting: methods in the paper's conditions and in the field (Tables 7 to 9, 12, Figs. 20, 21)",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    kinds = parser.add_subparsers(title="what to study", metavar="WHAT", required=True)
    methods = kinds.add_parser(
        "methods",
        help=_METHODS,
        description=f"Run {_METHODS}: errors of diameters, spacings and centres, and times.",
        epilog=_METHODS_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    methods.add_argument(
        "--setting", choices=(*_SETTINGS, "both"), default="both", help="250 mm model, 600 mm column (default: both)"
    )
    methods.add_argument(
        "--scenes", type=whole_number, default=20, metavar="N", help="random scenes of each setting (default: 20)"
    )
    methods.add_argument("--seed", type=int, default=0, metavar="S", help="another seed, other scenes (default: 0)")
    methods.add_argument(
        "--methods", nargs="+", choices=METHODS, default=list(METHODS), metavar="M", help=f"of {', '.join(METHODS)}"
    )
    methods.add_argument(
        "--quick", action="store_true", help="a camera of half the resolution: a quarter of the time, other numbers"
    )
    methods.add_argument("--out", type=Path, metavar="DIR", help="folder for CSV, summary.json and plots")
    add_switches(methods, prints_json="the numbers")
    methods.set_defaults(run=_study_methods)
    _add_hoisting_studies(kinds)
    add_loop_study(kinds, _prepare)


def _study_methods(options: argparse.Namespace) -> int:
    _prepare(options)
    from aadm_workbench.twin.camera import PRO_M
    from aadm_workbench.twin.pair import SETTINGS
    from aadm_workbench.twin.study.methods import study_methods, thinned_camera

    from ..shown.progress import StepProgress
    from ..shown.study_tables import study_tables
    from ..shown.terminal import show, show_json

    names = _SETTINGS if options.setting == "both" else (options.setting,)
    with StepProgress("rendering", quiet=options.quiet) as progress:
        study = study_methods(
            [SETTINGS[name] for name in names],
            list(dict.fromkeys(options.methods)),
            scenes=options.scenes,
            seed=options.seed,
            finished=progress.start(options.scenes * len(names)),
            camera=thinned_camera(PRO_M, 2) if options.quick else PRO_M,
        )
    summary = _encoded(study, quick=options.quick)
    written = [] if options.out is None else _write(study, summary, options.out)
    if options.json:
        show_json(summary)
    elif not options.quiet:
        show(*study_tables(study))
        if written:
            show("", f"Wrote {', '.join(path.name for path in written)} to {options.out}")
    return ALL_PASS


def _prepare(options: argparse.Namespace) -> None:
    """Refuse what cannot work before hours of rendering."""
    from aadm_workbench.errors import AadmError, MissingDependencyError, install_of

    if options.seed < 0:
        raise AadmError.because("command.seed_below_zero", seed=options.seed)
    for package in (*_PACKAGES, *(() if options.out is None else ("matplotlib",))):
        if find_spec(package) is None:
            needed_for = "Plots of a study" if package == "matplotlib" else "The virtual camera"
            raise MissingDependencyError(package, needed_for, install_of("twin"))
    if options.out is not None:
        try:
            options.out.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise AadmError.because("command.no_folder", folder=options.out, why=error.strerror) from error


def _encoded(study: MethodStudy, *, quick: bool) -> bytes:
    """The numbers of a study; lengths in mm, times in s."""
    from aadm_workbench.model import Kind
    from aadm_workbench.report.json import encode
    from aadm_workbench.twin.study.published import TABLES
    from aadm_workbench.twin.study.scores import bare_seconds, scores

    rated = scores(study)
    document = {
        "synthetic": True,
        "seed": study.seed,
        "scenes": study.scenes,
        "half_resolution": quick,
        "settings": {
            setting: {
                "published": TABLES[setting],
                "measured": [score for score in rated if score.setting == setting],
                "bare_calls_s": {kind.plural: bare_seconds(study, setting, kind) for kind in Kind},
            }
            for setting in study.settings
        },
    }
    return encode(document)


def _write(study: MethodStudy, summary: bytes, folder: Path) -> list[Path]:
    from aadm_workbench.own_files import write_atomically
    from aadm_workbench.twin.study.files import write_tables
    from aadm_workbench.twin.study.plots import write_plots

    write_atomically(folder / "summary.json", summary)
    return [folder / "summary.json", *write_tables(study, folder), *write_plots(study, folder)]


def _add_hoisting_studies(kinds: Any) -> None:
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
        default = SCAN_METHODS if name == "conditions" else SCAN_METHODS[:2]
        parser.add_argument(
            "--methods",
            nargs="+",
            choices=SCAN_METHODS,
            default=list(default),
            metavar="M",
            help=f"of {', '.join(SCAN_METHODS)}",
        )
        parser.add_argument("--out", type=Path, metavar="DIR", help="folder for summary.json and plots")
        add_switches(parser, prints_json="the numbers")
        parser.set_defaults(run=_study_hoisting, study=name)


def _study_hoisting(options: argparse.Namespace) -> int:
    _prepare(options)
    from aadm_workbench.report.json import encode
    from aadm_workbench.twin.study.hoisting import cells_of, study_hoisting

    from ..shown.progress import StepProgress
    from ..shown.study_tables import hoisting_document, hoisting_tables
    from ..shown.terminal import show, show_json

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
    written = [] if options.out is None else _write_hoisting(study, summary, options.out)
    if options.json:
        show_json(summary)
    elif not options.quiet:
        show(*hoisting_tables(study))
        if written:
            show("", f"Wrote {', '.join(path.name for path in written)} to {options.out}")
    return ALL_PASS


def _write_hoisting(study: HoistingStudy, summary: bytes, folder: Path) -> list[Path]:
    from aadm_workbench.own_files import write_atomically
    from aadm_workbench.twin.study.hoisting_plots import write_hoisting_plots

    path = folder / f"{study.name}.json"
    write_atomically(path, summary)
    return [path, *write_hoisting_plots(study, folder)]
