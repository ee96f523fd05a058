"""Make scans with a virtual camera, with their exact truth beside them."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

from ..switches import ALL_PASS, add_switches, whole_number

EXAMPLE = """\
example:
  aadm simulate pair --setting field --out pair --seed 7
  aadm simulate floor --out floor --seed 2026
  aadm simulate floor --columns 3 --defect "C-302: R5 +7.5,0" --hoisting
  aadm simulate tower --out tower --columns 8"""
_PAIR = "a column foot and the bars under it: two scans, truth.json and a job.toml that aadm check runs"
_PAIR_EXAMPLE = """\
example:
  aadm simulate pair --setting lab --out pair --seed 7 --format ply
  aadm check pair/job.toml

  a camera that projects fringes, minutes per scan, and one that drops what is at depth steps:
  aadm simulate pair --setting field --out fringe --camera fringe
  aadm simulate pair --setting field --out rings --filter rings=1 --filter median=3

  a roughened foot with plugged sleeves, and a job with half of the camera's focal length:
  aadm simulate pair --setting lab --out site --site rough --site plugs --slip focal-half

  a section that is too wide, with the sleeves beside their place in it and chipped corners:
  aadm simulate pair --setting lab --out section --site off-size --site pattern-beside --site broken-corners"""
_CAMERA = (
    "ray: rays and a law of noise (default); pixel: the same with pixels that have a size; fringe: fringe projection, "
    "path-traced, minutes per scan"
)
_FILTER = (
    "what the camera does to its depth maps, again for each: edge-mask=0..1 (of the brightest neighbour, camera fringe "
    "alone), outliers=N (of 24 neighbours), and in pixels rings=0..3, fatten=N, gaps=N, median=N, gaussian=SIGMA"
)
_SITE = (
    "what the site did, again for each: rough, keyed (feet), spalls, tapes, taped-spalls, proud-rings, plugs, burrs, "
    "caps, kinks, leans, two-heights, cut-off, other-bars, other-sleeves; of the foot's own section off-size, askew, "
    "pattern-beside, bowed, warped, broken-corners, broken-edges"
)
_SLIP = (
    "what goes wrong between camera and job, again for each: focal-half, focal-double, focal-2-percent, "
    "principal-point, depth-x10, depth-by-10, unit, up, swapped, twice (of the job); outliers, no-floor, mirrored (of "
    "the scans)"
)
_OWN = "so many sound columns C-301, C-302, …, whose job brings its own design, instead of the sample floor"
_DEFECT = (
    'put a point off its place, mm, or plug a mouth, again for each: "C-302: R5 +7.5,0", "C-301: S7 plugged"; '
    "without --columns there are three"
)
_JOBS = {
    "floor": "the sample floor: scans, truth.json and job.toml of eight columns; the job wants floor3.ifc beside it",
    "lab": "the laboratory model: clouds, truth.json and job.toml of two columns",
    "tower": "columns that will be set with known errors: scans, control points, truth.json, and a job for aadm stack",
}
_PLATE = "captures of a plate by a virtual camera whose scale is off, and truth.json: for aadm camera learn"
_PLATE_EXAMPLE = """\
example:
  aadm simulate plate --out plate --seed 7 --filter rings=1
  aadm camera learn plate/plate.toml plate/plate-*.tiff --camera plate/camera.toml --out camera-0042.toml"""
_PACKAGES = ("manifold3d", "open3d")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    kinds = parser.add_subparsers(title="what to simulate", metavar="WHAT", required=True)
    pair = kinds.add_parser(
        "pair",
        help=_PAIR,
        description=f"Simulate {_PAIR}.",
        epilog=_PAIR_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    pair.add_argument(
        "--setting", choices=("lab", "field"), required=True, help="250 mm model at 0.8 m, 600 mm at 1.3 m"
    )
    pair.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder for the files")
    pair.add_argument("--seed", type=int, default=0, metavar="N", help="another seed, other errors (default: 0)")
    pair.add_argument("--format", choices=("tiff", "ply", "pcd"), default="tiff", help="of the scans (default: tiff)")
    pair.add_argument("--camera", choices=("ray", "pixel", "fringe"), default="ray", help=_CAMERA)
    pair.add_argument("--filter", action="append", default=[], metavar="NAME=AMOUNT", help=_FILTER)
    pair.add_argument("--site", action="append", default=[], metavar="NAME", help=_SITE)
    pair.add_argument("--slip", action="append", default=[], metavar="NAME", help=_SLIP)
    add_switches(pair, prints_json=None)
    pair.set_defaults(run=_simulate_pair)
    plate = kinds.add_parser("plate", help=_PLATE, description=f"Simulate {_PLATE}.", epilog=_PLATE_EXAMPLE)
    plate.formatter_class = argparse.RawDescriptionHelpFormatter
    plate.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder for the files")
    plate.add_argument("--seed", type=int, default=0, metavar="N", help="another plate and camera (default: 0)")
    plate.add_argument("--captures", type=whole_number, default=8, metavar="N", help="how many (default: 8)")
    plate.add_argument("--camera", choices=("ray", "pixel", "fringe"), default="ray", help=_CAMERA)
    plate.add_argument("--filter", action="append", default=[], metavar="NAME=AMOUNT", help=_FILTER)
    add_switches(plate, prints_json=None)
    plate.set_defaults(run=_simulate_plate)
    for name, summary in _JOBS.items():
        job = kinds.add_parser(
            name,
            help=summary,
            description=f"Simulate {summary}.",
            epilog=f"example:\n  aadm simulate {name} --out {name} --seed 2026",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        job.add_argument("--out", type=Path, default=Path(name), metavar="DIR", help=f"folder (default: {name})")
        job.add_argument("--seed", type=int, default=2026, metavar="N", help="other errors (default: 2026)")
        if name == "tower":
            job.add_argument("--columns", type=whole_number, default=8, metavar="N", help="how many (default: 8)")
        if name == "floor":
            _add_own_floor(job)
        add_switches(job, prints_json=None)
        job.set_defaults(run=_simulate_job, what=name)


def _add_own_floor(parser: argparse.ArgumentParser) -> None:
    """What makes a floor of one's own out of the sample floor."""
    parser.add_argument("--columns", type=whole_number, metavar="N", help=_OWN)
    parser.add_argument("--defect", action="append", default=[], metavar="DEFECT", help=_DEFECT)
    parser.add_argument("--hoisting", action="store_true", help="also a frame of each column hanging over its bars")


def _simulate_pair(options: argparse.Namespace) -> int:
    _require_virtual_camera()
    from aadm_workbench.errors import AadmError
    from aadm_workbench.twin.filters import filters_of
    from aadm_workbench.twin.pair import SETTINGS, Taken, make_pair
    from aadm_workbench.twin.site import known_site
    from aadm_workbench.twin.slips import slip_of

    from ..shown.terminal import show

    filters, slip = filters_of(options.filter), slip_of(options.slip)
    known_site(options.site)
    if options.camera == "fringe":
        _require_renderer()
    elif filters.edge_mask:
        raise AadmError.because("command.edge_mask_camera")
    _prepare(options)
    words = "" if options.camera == "ray" else f" --camera {options.camera}"
    for switch in ("filter", "site", "slip"):
        words += "".join(f" --{switch} {word}" for word in getattr(options, switch))
    taken = Taken(options.camera, filters, words, tuple(options.site), slip)
    make_pair(options.out, SETTINGS[options.setting], options.seed, options.format, taken)
    if not options.quiet:
        names = (f"foot.{options.format}", f"bars.{options.format}", "truth.json", "job.toml")
        show(f"Wrote {', '.join(names)} to {options.out}", f"Check it: aadm check {options.out / 'job.toml'}")
    return ALL_PASS


def _simulate_plate(options: argparse.Namespace) -> int:
    _require_virtual_camera()
    from aadm_workbench.calibration.plate.plate import drawn_plate
    from aadm_workbench.twin.filters import filters_of
    from aadm_workbench.twin.pair import Taken
    from aadm_workbench.twin.plate import make_plate

    from ..shown.terminal import say, show

    taken = Taken(options.camera, filters_of(options.filter))
    if options.camera == "fringe":
        _require_renderer()
    _prepare(options)
    for line in make_plate(options.out, drawn_plate(12, 36.0, 160.0, 20.0), options.seed, options.captures, taken):
        if not options.quiet:
            say(line)
    if not options.quiet:
        show(f"Wrote plate.toml, plate.csv, camera.toml, truth.json and the captures to {options.out}")
    return ALL_PASS


def _simulate_job(options: argparse.Namespace) -> int:
    _require_virtual_camera()
    from ..shown.terminal import say, show

    _prepare(options)
    for line in _made(options):
        if not options.quiet:
            say(line)
    if not options.quiet:
        show(
            f"Wrote scans, truth.json and job.toml to {options.out}", f"Check it: aadm check {options.out / 'job.toml'}"
        )
    return ALL_PASS


def _made(options: argparse.Namespace) -> Iterator[str]:
    """The files of a job, one column after another, a line of each."""
    from aadm_workbench.twin.floor import make_floor
    from aadm_workbench.twin.lab import make_lab
    from aadm_workbench.twin.tower import make_tower

    if options.what == "tower":
        return make_tower(options.out, options.seed, options.columns)
    if options.what == "floor" and (options.columns or options.defect or options.hoisting):
        from aadm_workbench.twin.own_floor import defect_of, make_own_floor

        defects = [defect_of(text) for text in options.defect]
        return make_own_floor(options.out, options.seed, options.columns or 3, defects, hoisting=options.hoisting)
    return {"floor": make_floor, "lab": make_lab}[options.what](options.out, options.seed)


def _prepare(options: argparse.Namespace) -> None:
    """Refuse a seed that is none, and make the folder."""
    from aadm_workbench.errors import AadmError

    if options.seed < 0:
        raise AadmError.because("command.seed_below_zero", seed=options.seed)
    try:
        options.out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise AadmError.because("command.no_folder", folder=options.out, why=error.strerror) from error


def _require_virtual_camera() -> None:
    from aadm_workbench.errors import MissingDependencyError, install_of

    for package in _PACKAGES:
        if find_spec(package) is None:
            raise MissingDependencyError(package, "The virtual camera", install_of("twin"))


def _require_renderer() -> None:
    """Say what is missing before a folder is made."""
    from aadm_workbench.twin.fringe.renderer import mitsuba_ready

    mitsuba_ready()
