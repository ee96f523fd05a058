"""The rules of the house, read off every file's syntax tree.

Each rule is a function of a module's path and tree that yields what breaks it; ``test_rules_are_proven.py`` proves
that each one notices what it forbids and lets pass what it allows.
"""

import ast
import sys
from collections.abc import Callable, Iterator
from pathlib import Path, PurePosixPath
from typing import TypeAlias

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = "aadm_workbench"
STAGES = ("design", "camera", "scan", "extract", "assembly", "hoisting", "report", "inspection", "stack", "calibration")
NOUNS = {"errors", "model", "bounded", "own_files"}

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
    """Rule: a file is a room of at most 350 lines (up to its last statement)."""
    last = max((node.end_lineno or 0 for node in tree.body), default=0)
    if last > LONGEST_FILE:
        yield last, f"is longer than {LONGEST_FILE} lines: cut it"


LONGEST_FILE = 350
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
