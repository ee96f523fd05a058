"""What a constant of the extraction decides: every number at the head of its modules, moved by 30 % either way.

    python -m benchmarks.constants [sleeves|rebars|hoisting|published] [--only NAME ...] [--by 0.3]

Centres are found again in a few scans with each constant moved: sleeves and rebars in a laboratory and a field scan of
the ray caster, a path-traced one and a thinned cloud; hoisting in three frames; the published methods in one scan of
each kind. Printed are how many centres more or fewer are found, how far the farthest of the others moved, in mm and in
its own standard uncertainties, and by how much uncertainties changed. "±30 %" in comments on constants is about this.
"""

from __future__ import annotations

import argparse
import ast
import json
import platform
import tomllib
from collections.abc import Callable, Iterator, Mapping
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from types import ModuleType
from typing import Any

import numpy as np

import aadm_workbench.extract
from aadm_workbench.extract.method import METHODS, extract
from aadm_workbench.model import Array, Camera, Kind, Scan
from aadm_workbench.scan.read import read_scan
from tests import hoisting_scenes, scenes

ROOT = Path(__file__).resolve().parents[1]

Found = Mapping[str, tuple[Array, Array]]
"""By scan: centres (k, 3) mm, and their standard uncertainties (k,) mm per axis, NaN where none is stated."""

SAME_MM = 5.0  # a centre farther off than this is another one


def scans(kind: Kind) -> Iterator[tuple[str, Scan, float]]:
    """Name, scan and nominal diameter, mm."""
    for name, setting in scenes.SETTINGS.items():
        scan = (scenes.sleeve_scan if kind is Kind.SLEEVE else scenes.bar_scan)(name).scan()
        yield name, scan, setting.sleeve_diameter if kind is Kind.SLEEVE else setting.bar_diameter
    diameter_mm = (
        scenes.SETTINGS["field"].sleeve_diameter if kind is Kind.SLEEVE else scenes.SETTINGS["field"].bar_diameter
    )
    yield "cloud", scenes.as_cloud(scan, 3, keep=0.5)[0], diameter_mm
    folder = ROOT / "tests" / "fringe_scans" / "a-field1"
    job = tomllib.loads((folder / "job.toml").read_text(encoding="utf-8"))
    step_mm = job["camera"].pop("depth_scale_mm")
    file = "foot.tiff" if kind is Kind.SLEEVE else "bars.tiff"
    scan = read_scan(folder / file, camera=Camera(**job["camera"]), depth_scale_mm=step_mm)
    yield "path-traced", scan, job["columns"][0]["design"][f"{kind.value}_diameter"]


def of_kind(kind: Kind) -> Callable[[], Found]:
    """Finds the centres of one kind by ``refined``."""
    every = list(scans(kind))

    def find() -> Found:
        return {name: centres(scan, kind, diameter_mm, "refined") for name, scan, diameter_mm in every}

    return find


def published() -> Callable[[], Found]:
    """Finds the centres of both kinds in the laboratory scan by every published method."""
    every = [(kind, *next(scans(kind))) for kind in Kind]

    def find() -> Found:
        return {
            f"{kind} {method}": centres(scan, kind, diameter_mm, method)
            for kind, _, scan, diameter_mm in every
            for method in list(METHODS)[1:]
        }

    return find


def centres(scan: Scan, kind: Kind, diameter_mm: float, method: str) -> tuple[Array, Array]:
    """What a method finds in a scan."""
    points = extract(scan, kind, diameter_mm, method, np.random.default_rng(0)).points
    u_mm = [np.nan if p.covariance is None else float(np.sqrt(np.trace(p.covariance) / 3.0)) for p in points]
    return np.array([point.centre for point in points]).reshape(-1, 3), np.array(u_mm)


def hoisting() -> Callable[[], Found]:
    """Finds the sleeves and the bars that are seen in three frames of a hanging column."""
    from aadm_workbench.hoisting.measure import HoistingSettings, measure_hoisting
    from aadm_workbench.twin.scenes import FIELD, LAB
    from aadm_workbench.twin.study.hoisting import design_of

    frames = {
        "usual": (hoisting_scenes.usual().frame.scan(), LAB),
        "turned": (hoisting_scenes.turned_and_aside().frame.scan(), LAB),
        "field": (hoisting_scenes.field().frame.scan(), FIELD),
    }

    def find() -> Found:
        found: dict[str, tuple[Array, Array]] = {}
        for name, (scan, setting) in frames.items():
            near = hoisting_scenes.NEAR
            pairs = measure_hoisting(scan, design_of(setting), near=near, settings=HoistingSettings()).report.pairs
            for kind in Kind:
                seen = [pair for pair in pairs if getattr(pair, f"{kind}_seen")]
                places = np.array([getattr(pair, f"{kind}_scan_mm") for pair in seen]).reshape(-1, 3)
                found[f"{name} {kind}"] = places, np.array([pair.u_mm or np.nan for pair in seen])
        return found

    return find


GROUPS: dict[str, tuple[Callable[[], Callable[[], Found]], Callable[[str], bool]]] = {
    "sleeves": (lambda: of_kind(Kind.SLEEVE), lambda module: not module.startswith(("hoisting", "published"))),
    "rebars": (lambda: of_kind(Kind.REBAR), lambda module: not module.startswith(("hoisting", "published"))),
    "hoisting": (hoisting, lambda module: module.startswith(("hoisting", "pattern_fit"))),
    "published": (published, lambda module: module.startswith("published")),
}


def modules() -> dict[str, ModuleType]:
    """All modules of the extraction by their names in it."""
    package = aadm_workbench.extract
    names = [module.name for module in walk_packages(package.__path__, f"{package.__name__}.")]
    return {name.removeprefix(f"{package.__name__}."): import_module(name) for name in names}


def constants(module: ModuleType) -> Iterator[tuple[str, Any]]:
    """Names and values of the numbers, and of tuples of numbers, that stand at the head of a module."""
    for node in ast.parse(Path(str(module.__file__)).read_text(encoding="utf-8")).body:
        for target in node.targets if isinstance(node, ast.Assign) else ():
            for name in target.elts if isinstance(target, ast.Tuple) else [target]:
                value = getattr(module, name.id) if isinstance(name, ast.Name) else None
                if moved(value, 1.1) is not None:
                    yield name.id, value


def moved(value: Any, factor: float) -> Any:
    """A number, or a tuple of them, times a factor; a whole one by one at least. None for anything else."""
    if isinstance(value, bool):
        return None
    if isinstance(value, int):
        return value + max(1, round(abs(factor - 1.0) * abs(value))) * (1 if factor > 1.0 else -1)
    if isinstance(value, float):
        return factor * value
    parts = [moved(part, factor) for part in value] if isinstance(value, tuple) else []
    return None if not parts or None in parts else tuple(parts)


def compared(usual: Found, found: Found) -> dict[str, float]:
    """How many centres more or fewer; the largest move, mm and in u; the largest change of u, relative."""
    more, farthest_mm, in_u, u_ratio = 0, 0.0, 0.0, 0.0
    for name, (places, u_mm) in usual.items():
        others, others_u_mm = found[name]
        more += len(others) - len(places)
        if len(places) and len(others):
            apart = np.linalg.norm(places[:, None] - others[None], axis=2)
            same = apart.min(axis=1) < SAME_MM
            farthest_mm = max(farthest_mm, float(apart.min(axis=1)[same].max(initial=0.0)))
            if np.isfinite(u_mm).all():
                in_u = max(in_u, float((apart.min(axis=1) / u_mm)[same].max(initial=0.0)))
                ratio = others_u_mm[apart.argmin(axis=1)][same] / u_mm[same]
                u_ratio = max(u_ratio, float(abs(np.median(ratio) - 1.0)))
    return {"more": more, "farthest_mm": farthest_mm, "farthest_u": in_u, "u": u_ratio}


def studied(find: Callable[[], Found], parts: Mapping[str, ModuleType], only: set[str], by: float) -> Iterator[Any]:
    """Name, value and effect of each constant; wherever it was imported it is moved, too."""
    usual = find()
    everywhere = modules().values()
    for part, module in parts.items():
        for name, value in constants(module):
            if only and name not in only:
                continue
            holders = [holder for holder in everywhere if vars(holder).get(name) is value]
            for factor in (1.0 - by, 1.0 + by):
                try:
                    for holder in holders:
                        setattr(holder, name, moved(value, factor))
                    effect: Any = compared(usual, find())
                except (ValueError, IndexError, np.linalg.LinAlgError) as error:
                    effect = {"error": str(error)}
                finally:
                    for holder in holders:
                        setattr(holder, name, value)
                yield {"constant": f"{part}.{name}", "value": value, "times": factor, **effect}


def main() -> None:
    """Print the machine and a line for each constant and direction, as JSON."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("groups", nargs="*", metavar="GROUP", help=f"{', '.join(GROUPS)} (default: all)")
    parser.add_argument("--only", nargs="+", default=[], metavar="NAME")
    parser.add_argument("--by", type=float, default=0.3)
    options = parser.parse_args()
    if unknown := {*options.groups} - GROUPS.keys():
        parser.error(f"there is no group {min(unknown)!r}; write one of {', '.join(GROUPS)}")
    print(json.dumps({"machine": platform.platform(), "python": platform.python_version(), "numpy": np.__version__}))
    for group in options.groups or GROUPS:
        make, belongs = GROUPS[group]
        parts = {name: module for name, module in modules().items() if belongs(name)}
        for line in studied(make(), parts, {*options.only}, options.by):
            print(json.dumps({"group": group, **line}), flush=True)


if __name__ == "__main__":
    main()
