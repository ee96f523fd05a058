"""The rules of the house, read off every file's syntax tree.

Each rule is a function of a module's path and tree that yields what breaks it; the lower half of this file proves that
each one notices what it forbids and lets pass what it allows.
"""

import ast
import sys
from collections.abc import Callable, Iterator
from pathlib import Path, PurePosixPath
from typing import TypeAlias

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = "aadm_workbench"
STAGES = ("design", "camera", "scan", "extract", "assembly", "hoisting", "report", "inspection", "stack", "calibration")
NOUNS = {"errors", "model", "atomic", "bounded", "own_files"}

Finding: TypeAlias = tuple[int, str]
Rule: TypeAlias = Callable[[PurePosixPath, ast.Module], Iterator[Finding]]


def stage_of(path: PurePosixPath) -> str:
    """Folder of a module inside the package ("" for those at its root); for other files their first folder."""
    parts = path.parts[:-1]
    if parts[:1] == (PACKAGE,):
        return parts[1] if len(parts) > 1 else ""
    return parts[0] if parts else "."


def imports(path: PurePosixPath, tree: ast.Module) -> Iterator[Finding]:
    """Line and full dotted name of whatever a module imports, anywhere in it, by statement or by ``import_module``."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = path.parts[: len(path.parts) - node.level] if node.level else ()
            origin = ".".join([*above, *([node.module] if node.module else [])])
            yield from ((node.lineno, f"{origin}.{alias.name}") for alias in node.names)
        elif isinstance(node, ast.Call) and called(node).split(".")[-1] in {"import_module", "__import__"}:
            yield from ((node.lineno, str(word.value)) for word in node.args[:1] if isinstance(word, ast.Constant))


def called(node: ast.Call) -> str:
    """Dotted name of what is called; a part that is no plain name is left empty: ``.read_text``."""
    return dotted(node.func)


def dotted(node: ast.expr) -> str:
    """``np.random.rand`` of an attribute chain."""
    if isinstance(node, ast.Attribute):
        return f"{dotted(node.value)}.{node.attr}"
    return node.id if isinstance(node, ast.Name) else ""


def only_in(packages: set[str], allowed: Callable[[PurePosixPath], bool], places: str) -> Rule:
    """Rule: some third-party packages are imported in some places only."""

    def rule(path: PurePosixPath, tree: ast.Module) -> Iterator[Finding]:
        if not allowed(path):
            for line, name in imports(path, tree):
                if name.split(".")[0] in packages:
                    yield line, f"imports {name}, which only {places} may"

    return rule


def is_ifc_file(path: PurePosixPath) -> bool:
    """Whether a module reads or writes IFC models, by its name."""
    return stage_of(path) in {"design", "report"} and path.parts[2].startswith("ifc")


def is_published_or_twin(path: PurePosixPath) -> bool:
    """Whether a module belongs to the baselines of the literature or to the virtual camera."""
    return stage_of(path) == "twin" or path.parts[:3] == (PACKAGE, "extract", "published")


def is_test(path: PurePosixPath) -> bool:
    """Whether a file belongs to the tests: they may look behind every door."""
    return path.parts[0] in {"tests", "benchmarks", "samples"}


FREECAD = {"App", "Arch", "BIM", "Draft", "FreeCAD", "Mesh", "MeshPart", "Part", "Points", "TechDraw"}
WINDOW = {"FreeCADGui", "Gui", "PySide", "PySide2", "PySide6", "PyQt5", "PyQt6", "pivy", "shiboken2", "shiboken6"}

freecad_only_in_document_and_gui = only_in(
    FREECAD,
    lambda path: stage_of(path) in {"document", "gui"} or path.name in {"Init.py", "InitGui.py"} or is_test(path),
    "document/ and gui/",
)
window_only_in_gui = only_in(
    WINDOW, lambda path: stage_of(path) == "gui" or path.name == "InitGui.py" or is_test(path), "gui/"
)
ifcopenshell_only_in_ifc_files = only_in(
    {"ifcopenshell", "ifcpatch"}, lambda path: is_ifc_file(path) or is_test(path), "design/ifc* and report/ifc*"
)
open3d_only_in_published_and_twin = only_in(
    {"open3d"}, lambda path: is_published_or_twin(path) or is_test(path), "extract/published/ and twin/"
)


def stages_import_from_the_left(path: PurePosixPath, tree: ast.Module) -> Iterator[Finding]:
    """Rule: each stage may know those to its left, nothing beyond them; the nouns know each other alone."""
    stage = stage_of(path)
    if path.parts[0] != PACKAGE or stage not in {*STAGES, *NOUNS, ""}:
        return
    known: set[str] = set()
    if path.parts[1].removesuffix(".py") not in NOUNS:
        known = set(STAGES[: STAGES.index(stage) + 1]) if stage else {*STAGES}
    for line, name in imports(path, tree):
        parts = name.split(".")
        if parts[0] == PACKAGE and len(parts) > 1 and parts[1] not in known | NOUNS | {"__version__"}:
            yield line, f"{stage or 'the root'} imports {name}, which lies to its right"


def package_never_imports_batch(path: PurePosixPath, tree: ast.Module) -> Iterator[Finding]:
    """Rule: the command knows the package, never the other way round."""
    if path.parts[0] == PACKAGE:
        for line, name in imports(path, tree):
            if name.split(".")[0] in {"batch", "aadm_batch"}:
                yield line, f"imports {name}"


FILE_MODULES = {"glob", "io", "os", "pathlib", "shutil", "socket", "sqlite3", "subprocess", "tempfile"}
CLOCKS = {"datetime", "time"}
FILE_CALLS = {"open", "imread", "imwrite", "read_bytes", "read_text", "tofile", "write_bytes", "write_text"}
NUMPY_FILE_CALLS = {"fromfile", "genfromtxt", "load", "loadtxt", "memmap", "save", "savetxt", "savez"}


def extract_and_assembly_are_pure(path: PurePosixPath, tree: ast.Module) -> Iterator[Finding]:
    """Rule: extract/ and assembly/ touch no file, print nothing, read no clock; a generator comes in as an argument."""
    if path.parts[0] != PACKAGE or stage_of(path) not in {"extract", "assembly"}:
        return
    reads_profiles = path.parts[1:] == ("assembly", "tolerances.py")
    for line, name in imports(path, tree):
        top = name.split(".")[0]
        if top in CLOCKS or top == "random" or name.startswith("numpy.random"):
            yield line, f"imports {name}: clocks and generators stay outside"
        if top in FILE_MODULES and not reads_profiles:
            yield line, f"imports {name}: files are read in scan/ and written in report/"
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            what = called(node)
            last = what.split(".")[-1]
            if what in {"print", "input"}:
                yield node.lineno, f"calls {what}()"
            elif what.startswith(("np.random.", "numpy.random.", "random.")):
                yield node.lineno, f"calls {what}(): a generator is an argument"
            elif not reads_profiles and (
                last in FILE_CALLS or (what.startswith(("np.", "numpy.")) and last in NUMPY_FILE_CALLS)
            ):
                yield node.lineno, f"calls {what}(): files are read in scan/ and written in report/"


def no_grab_bags(path: PurePosixPath, tree: ast.Module) -> Iterator[Finding]:
    """Rule: a module's name says what it holds."""
    for part in (*path.parts[:-1], path.stem):
        if part.lower().rstrip("s") in {"util", "helper", "common", "manager", "base", "misc"}:
            yield 1, f"is called {part}, which says nothing"


CORE = {"cv2", "ifcopenshell", "msgspec", "numpy", "rich", "scipy"}  # the dependencies that have no extra


def core_starts_without_extras(path: PurePosixPath, tree: ast.Module) -> Iterator[Finding]:
    """Rule: what comes with an extra is imported where it is used, so that the rest works without it."""
    if path.parts[0] != PACKAGE or stage_of(path) in {"document", "gui"} or is_published_or_twin(path):
        return
    at_start = ast.Module([node for node in tree.body if isinstance(node, ast.Import | ast.ImportFrom)], [])
    for line, name in imports(path, at_start):
        if (top := name.split(".")[0]) not in CORE | {PACKAGE, *sys.stdlib_module_names}:
            yield line, f"imports {top} at its start, which not everybody has: import it where it is used"


LISTENS = {
    "LocalCluster",
    "distributed.LocalCluster",
    "distributed.Nanny",
    "distributed.Scheduler",
    "distributed.Worker",
}
LISTENING_MODULES = {"http.server", "multiprocessing", "socketserver", "wsgiref", "xmlrpc.server"}
LISTENING_CALLS = {"bind", "create_server", "listen", "serve_forever", "start_server", "start_unix_server"}


def nothing_listens(path: PurePosixPath, tree: ast.Module) -> Iterator[Finding]:
    """Rule: whoever reaches a port could use it, so a check has none; links to machines are there for that."""
    if path.parts[0] not in {PACKAGE, "batch"} or {"camera", "link"} & set(path.parts):
        return
    for line, name in imports(path, tree):
        if any(name == module or name.startswith(f"{module}.") for module in LISTENING_MODULES):
            yield line, f"imports {name}, which listens on a port"
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            what = called(node)
            if what in LISTENS or what.split(".")[-1] in LISTENING_CALLS:
                yield node.lineno, f"calls {what}(): other users of the machine could reach it"


def no_long_files(path: PurePosixPath, tree: ast.Module) -> Iterator[Finding]:
    """Rule: a file is a room of at most 400 lines (up to its last statement)."""
    last = max((node.end_lineno or 0 for node in tree.body), default=0)
    if last > LONGEST_FILE:
        yield last, f"is longer than {LONGEST_FILE} lines: cut it"


LONGEST_FILE = 400
RULES: dict[str, Rule] = {
    "FreeCAD only in document and gui": freecad_only_in_document_and_gui,
    "windows only in gui": window_only_in_gui,
    "ifcopenshell only in ifc files": ifcopenshell_only_in_ifc_files,
    "open3d only in published and twin": open3d_only_in_published_and_twin,
    "stages import from the left": stages_import_from_the_left,
    "package never imports batch": package_never_imports_batch,
    "extract and assembly are pure": extract_and_assembly_are_pure,
    "core starts without extras": core_starts_without_extras,
    "no grab-bags": no_grab_bags,
    "nothing listens": nothing_listens,
    "no long files": no_long_files,
}


def modules() -> list[Path]:
    """All Python files of the project."""
    outside = {".venv", "build", "dist"}
    return sorted(path for path in ROOT.rglob("*.py") if not outside & set(path.relative_to(ROOT).parts))


def broken(rule: Rule, path: str, tree: ast.Module) -> list[str]:
    """What a rule has against a module, one line a finding."""
    return [f"{path}:{line} {finding}" for line, finding in rule(PurePosixPath(path), tree)]


def test_every_module_keeps_the_rules() -> None:
    looked_at, findings = set(), []
    for module in modules():
        path, tree = module.relative_to(ROOT).as_posix(), ast.parse(module.read_text(encoding="utf-8"))
        looked_at.add(path)
        findings += [f"{name}: {finding}" for name, rule in RULES.items() for finding in broken(rule, path, tree)]
    assert f"{PACKAGE}/errors.py" in looked_at, "nothing was looked at"
    assert findings == []


BREAKS = [
    (freecad_only_in_document_and_gui, "aadm_workbench/report/pages/html.py", "import FreeCAD"),
    (freecad_only_in_document_and_gui, "batch/main.py", "def go():\n    import FreeCAD as App"),
    (
        freecad_only_in_document_and_gui,
        "aadm_workbench/scan/formats/ply.py",
        "from importlib import import_module as m\nm.import_module('Part')",
    ),
    (window_only_in_gui, "aadm_workbench/document/column.py", "from PySide import QtCore"),
    (window_only_in_gui, "aadm_workbench/document/column.py", "if True:\n    import FreeCADGui"),
    (window_only_in_gui, "Init.py", "import FreeCADGui"),
    (ifcopenshell_only_in_ifc_files, "aadm_workbench/design/mesh.py", "import ifcopenshell.geom"),
    (ifcopenshell_only_in_ifc_files, "aadm_workbench/scan/ifc.py", "from ifcopenshell import guid"),
    (ifcopenshell_only_in_ifc_files, "batch/main.py", "import ifcopenshell"),
    (open3d_only_in_published_and_twin, "aadm_workbench/extract/plane.py", "import open3d as o3d"),
    (open3d_only_in_published_and_twin, "aadm_workbench/extract/published.py", "__import__('open3d')"),
    (
        stages_import_from_the_left,
        "aadm_workbench/scan/formats/ply.py",
        "from aadm_workbench.extract.plane import Plane",
    ),
    (stages_import_from_the_left, "aadm_workbench/design/mesh.py", "from aadm_workbench import scan"),
    (stages_import_from_the_left, "aadm_workbench/assembly/trial/virtual.py", "from ...report import json"),
    (stages_import_from_the_left, "aadm_workbench/extract/published/hough.py", "from ...assembly.eopa import fit"),
    (stages_import_from_the_left, "aadm_workbench/report/json.py", "import aadm_workbench.twin.scene"),
    (stages_import_from_the_left, "aadm_workbench/model.py", "from aadm_workbench.scan import read"),
    (stages_import_from_the_left, "aadm_workbench/model/scan.py", "from aadm_workbench.scan import read"),
    (stages_import_from_the_left, "aadm_workbench/inspection/check.py", "from aadm_workbench.twin import scene"),
    (
        stages_import_from_the_left,
        "aadm_workbench/report/json.py",
        "from aadm_workbench.inspection.check import check_column",
    ),
    (package_never_imports_batch, "aadm_workbench/gui/check.py", "from aadm_batch.job.table import JobTable"),
    (package_never_imports_batch, "aadm_workbench/report/pages/html.py", "import batch"),
    (extract_and_assembly_are_pure, "aadm_workbench/extract/plane.py", "with open('x') as f: pass"),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/extract/plane.py",
        "def f(scan):\n    return scan.source.read_bytes()",
    ),
    (extract_and_assembly_are_pure, "aadm_workbench/extract/plane.py", "import numpy as np\nnp.load('x.npy')"),
    (extract_and_assembly_are_pure, "aadm_workbench/extract/plane.py", "import cv2\ncv2.imread('x.png')"),
    (extract_and_assembly_are_pure, "aadm_workbench/extract/published/hough.py", "from pathlib import Path"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/trial/virtual.py", "print('passed')"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/trial/virtual.py", "from time import perf_counter"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/trial/virtual.py", "import datetime"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/trial/virtual.py", "import random"),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/assembly/trial/virtual.py",
        "import numpy as np\nnp.random.normal(0, 1)",
    ),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/assembly/trial/virtual.py",
        "import numpy as np\nnp.random.default_rng(1)",
    ),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/trial/virtual.py", "from numpy.random import default_rng"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/tolerances.py", "import time"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/tolerances.py", "print(1)"),
    (no_grab_bags, "aadm_workbench/scan/utils.py", ""),
    (no_grab_bags, "aadm_workbench/common/plane.py", ""),
    (no_grab_bags, "batch/Manager.py", ""),
    (core_starts_without_extras, "aadm_workbench/report/sheets/xlsx.py", "import openpyxl"),
    (core_starts_without_extras, "aadm_workbench/design/mesh.py", "from trimesh.proximity import signed_distance"),
    (nothing_listens, "batch/runner/cluster.py", "import distributed\ndistributed.LocalCluster(host='127.0.0.1')"),
    (nothing_listens, "batch/runner/local_worker.py", "distributed.Worker('tcp://127.0.0.1:1')"),
    (nothing_listens, "batch/runner/run.py", "import socket\nsocket.socket().bind(('127.0.0.1', 0))"),
    (nothing_listens, "aadm_workbench/gui/jobs.py", "from http.server import HTTPServer"),
    (nothing_listens, "batch/runner/run.py", "from multiprocessing.connection import Listener"),
    (no_long_files, "aadm_workbench/scan/formats/ply.py", "x = 1\n" * 401),
]
KEEPS = [
    (freecad_only_in_document_and_gui, "aadm_workbench/document/column.py", "import FreeCAD, Part"),
    (freecad_only_in_document_and_gui, "aadm_workbench/twin/parts.py", "from aadm_workbench.twin.Part import Part"),
    (window_only_in_gui, "aadm_workbench/gui/panel.py", "from PySide import QtGui\nfrom pivy import coin"),
    (window_only_in_gui, "InitGui.py", "import FreeCADGui"),
    (ifcopenshell_only_in_ifc_files, "aadm_workbench/design/ifc/geometry/placement.py", "import ifcopenshell"),
    (ifcopenshell_only_in_ifc_files, "aadm_workbench/report/ifc/model.py", "import ifcopenshell.api"),
    (open3d_only_in_published_and_twin, "aadm_workbench/extract/published/cloud.py", "import open3d"),
    (open3d_only_in_published_and_twin, "aadm_workbench/twin/raycast.py", "def f():\n    import open3d"),
    (
        stages_import_from_the_left,
        "aadm_workbench/report/json.py",
        "from aadm_workbench.design.ifc.model import columns",
    ),
    (
        stages_import_from_the_left,
        "aadm_workbench/report/json.py",
        "from aadm_workbench import __version__, errors, model",
    ),
    (
        stages_import_from_the_left,
        "aadm_workbench/model/scan.py",
        "from .camera import Camera\nfrom ..errors import AadmError",
    ),
    (
        stages_import_from_the_left,
        "aadm_workbench/scan/formats/ply.py",
        "from .points import Points\nfrom ..model import Scan",
    ),
    (stages_import_from_the_left, "aadm_workbench/twin/scene.py", "from aadm_workbench.scan.camera import Camera"),
    (stages_import_from_the_left, "aadm_workbench/inspection/check.py", "from aadm_workbench.report import json"),
    (stages_import_from_the_left, "batch/main.py", "from aadm_workbench.report import json"),
    (package_never_imports_batch, "batch/main.py", "from aadm_batch.job.table import JobTable"),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/assembly/tolerances.py",
        "from pathlib import Path\nPath('x').read_text()",
    ),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/extract/plane.py",
        "def f(rng: 'np.random.Generator'): return rng.normal()",
    ),
    (extract_and_assembly_are_pure, "aadm_workbench/scan/formats/ply.py", "open('x')"),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/extract/published/ransac_plane.py",
        "def f(open3d, rng): open3d.utility.random.seed(int(rng.integers(9)))",
    ),
    (no_grab_bags, "aadm_workbench/design/baseline.py", ""),
    (core_starts_without_extras, "aadm_workbench/design/mesh.py", "import json\ndef read():\n    import trimesh"),
    (core_starts_without_extras, "aadm_workbench/design/mesh.py", "import numpy as np\nfrom .paths import kind"),
    (core_starts_without_extras, "aadm_workbench/twin/meshes.py", "import manifold3d"),
    (nothing_listens, "batch/runner/cluster.py", "import distributed\ndistributed.Client('tls://h:1')"),
    (nothing_listens, "batch/link/opcua.py", "server.start_server()"),
    (nothing_listens, "tests/batch/test_tls.py", "socket.create_server(('127.0.0.1', 0))"),
    (no_long_files, "aadm_workbench/scan/formats/ply.py", "x = 1\n" * 400),
]


@pytest.mark.parametrize(("rule", "path", "source"), BREAKS)
def test_rule_notices_what_it_forbids(rule: Rule, path: str, source: str) -> None:
    assert broken(rule, path, ast.parse(source))


@pytest.mark.parametrize(("rule", "path", "source"), KEEPS)
def test_rule_lets_pass_what_it_allows(rule: Rule, path: str, source: str) -> None:
    assert broken(rule, path, ast.parse(source)) == []


def test_every_rule_is_proven() -> None:
    assert (
        {id(rule) for rule in RULES.values()}
        == {id(rule) for rule, _, _ in BREAKS}
        == {id(rule) for rule, _, _ in KEEPS}
    )
