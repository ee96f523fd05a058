"""The job file, read: everything that can be wrong with its text is found before any work starts.

Each error names the file and the line.
"""

from __future__ import annotations

import hashlib
import re
import tomllib
from pathlib import Path
from typing import Literal, cast

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.errors import CameraError, JobError, ScanError
from aadm_workbench.inspection.job import Job, JobModel
from aadm_workbench.model import Camera, CameraProfile, Profile, StackSettings
from aadm_workbench.scan.file import load

from ..switches import steering_character
from .columns import read_columns
from .table import JobTable, Lines

LARGEST_JOB_BYTES = 16 * 2**20
"""A job of a thousand columns with designs of their own takes a megabyte."""

_MOST_PARTS_OF_A_KEY = 64  # keys of a job have three; tables nested a thousand deep end the parser's stack
_DOTTED = re.compile(r"[\w\"'-][ \t]*\.")

CHECKS = ("sleeves", "rebars", "trial")
_TOP = (
    "schema",
    "name",
    "units",
    "tolerances",
    "decision",
    "checks",
    "turns",
    "model",
    "camera",
    "capture",
    "stack",
    "columns",
)
_MODEL = ("path", "columns", "sleeves", "rebars", "units")
_CAMERA = ("fx", "fy", "cx", "cy", "width", "height", "depth_scale_mm", "scale_error", "profile")
_CAPTURE = ("date", "operator", "camera_serial", "calibration", "settings")


def read_job(path: Path) -> Job:
    """Read a job file.

    Raises
    ------
    JobError
        Naming the file and the line: text that is no TOML, unknown keys, wrong types and values, two columns with one
        id, an unknown tolerance profile, a column without a design in a job without a model.
    """
    content = _content(path)
    top = _parsed(content, str(path))
    top.allow(_TOP)
    _check_schema(top)
    camera, depth_scale_mm = _camera(top)
    learned = _camera_profile(top, path.parent)
    model, units = _model(top), top.one_of("units", ("mm", "m"), "mm")
    lines = top.lines  # and not the table itself: what the text says is let go of
    return Job(
        source=str(path),
        folder=path.parent,
        sha256=hashlib.sha256(content).hexdigest(),
        name=top.text("name") or path.stem,
        units=units,
        profile=_profile(top, path.parent),
        decision=cast(Literal["guarded", "simple"], top.one_of("decision", ("guarded", "simple"), "guarded")),
        checks=_checks(top),
        turns=top.flag("turns", False),
        model=model,
        camera=camera,
        depth_scale_mm=depth_scale_mm,
        columns=(columns := read_columns(top, units=units, has_model=model is not None)),
        capture=_capture(top),
        stack=_stack(top),
        camera_profile=learned,
        line_of=lambda name: lines.of(("columns", [column.id for column in columns].index(name), "id")),
    )


def _content(path: Path) -> bytes:
    try:
        content = load(path, str(path)).content
    except ScanError as error:
        if isinstance(error.__cause__, FileNotFoundError):
            raise JobError.because("jobfile.no_file", file=path) from error
        raise JobError.because("jobfile.unreadable", error=error) from error
    if len(content) > LARGEST_JOB_BYTES:
        raise JobError.because("jobfile.too_large", file=path, size=len(content), most=LARGEST_JOB_BYTES)
    return content


def _parsed(content: bytes, source: str) -> JobTable:
    try:
        # Editors on Windows mark UTF-8 with three bytes; newlines are one sign wherever the file was written.
        text = content.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise JobError.because("jobfile.not_utf8", file=source, line=line) from error
    _check_keys(text, source)
    try:
        values = tomllib.loads(text)
    except RecursionError as error:
        raise JobError.because("jobfile.too_deep", file=source) from error
    except ValueError as error:
        from aadm_workbench.bounded import toml_fault

        place = re.search(r"\(at line (\d+), column \d+\)", str(error))
        line = int(place[1]) if place else text.count("\n") + 1
        what = toml_fault(re.sub(r"\s*\(at [^)]*\)$", "", str(error)))
        escaped = "\\" in text.split("\n")[line - 1]  # a path of Windows, in which TOML takes backslashes for its own
        code = "jobfile.no_toml.backslashes" if escaped else "jobfile.no_toml"
        raise JobError.because(code, file=source, line=line, what=what) from error
    return JobTable(values, (), "the job", source, Lines(text))


def _check_keys(text: str, source: str) -> None:
    """Refuse keys of very many parts, on which the parser would spend minutes: ``a.a.a.a...``."""
    for number, line in enumerate(text.split("\n"), start=1):
        if line.count(".") <= _MOST_PARTS_OF_A_KEY:
            continue
        pieces = line.split("=")
        for piece in pieces[:-1] or pieces:
            if "," not in piece and len(_DOTTED.findall(piece)) > _MOST_PARTS_OF_A_KEY:
                raise JobError.because("jobfile.too_deep_line", file=source, line=number)


def _check_schema(top: JobTable) -> None:
    top.require("schema", "schema = 1 as its first line")
    schema = top.values["schema"]
    if isinstance(schema, bool) or schema != 1:
        raise top.wrong("schema", "jobfile.schema", shown=repr(schema))


def _profile(top: JobTable, folder: Path) -> Profile:
    name = top.text("tolerances") or "cn"
    try:
        return load_profile(name, folder)
    except JobError as error:
        raise top.wrong("tolerances", "said.sentences", parts=(error.reason,)) from error


def _checks(top: JobTable) -> tuple[str, ...] | None:
    checks = top.texts("checks")
    for index, check in enumerate(checks):
        if check not in CHECKS:
            listed = ", ".join(f'"{known}"' for known in CHECKS)
            raise top.wrong("checks", "jobfile.unknown_check", index, check=check, listed=listed)
        if check in checks[:index]:
            raise top.wrong("checks", "jobfile.check_twice", index, check=check)
    return tuple(check for check in CHECKS if check in checks) or None


def _model(top: JobTable) -> JobModel | None:
    table = top.table("model", "[model]")
    if table is None:
        return None
    from aadm_workbench.design.model_units import MM_PER_UNIT

    table.allow(_MODEL)
    table.require("path", 'path = "floor3.ifc", or remove the table where every column has a [columns.design]')
    units = table.one_of("units", tuple(MM_PER_UNIT), "mm")
    columns, sleeves, rebars = (table.text(key) for key in _MODEL[1:4])
    return JobModel(table.path("path") or "", columns, sleeves, rebars, units)


def _camera(top: JobTable) -> tuple[Camera | None, float | None]:
    table = top.table("camera", "[camera]")
    if table is None:
        return None, None
    from aadm_workbench.scan.intrinsics import Intrinsics, checked_camera

    table.allow(_CAMERA)
    if table.text("profile") is not None and not any(key in table.values for key in _CAMERA[:6]):
        return None, table.length("depth_scale_mm")
    for key in _CAMERA[:6]:
        table.require(key, f"{key} = ...; the six intrinsics belong together")
    scale_error = table.number("scale_error")
    if scale_error is not None and scale_error < 0.0:
        raise table.wrong("scale_error", "jobfile.scale_error", value=scale_error)
    fx, fy, cx, cy = (table.length(key) for key in _CAMERA[:4])
    width, height = (table.count(key) for key in _CAMERA[4:6])
    found = Intrinsics("", fx, fy, cx, cy, width, height, Camera.scale_error if scale_error is None else scale_error)
    try:
        return checked_camera(found), table.length("depth_scale_mm")
    except CameraError as error:
        raise table.wrong(None, "jobfile.camera", why=error) from error


def _camera_profile(top: JobTable, folder: Path) -> CameraProfile | None:
    """What was learned of the camera, where the job names its file."""
    table = top.table("camera", "[camera]")
    name = None if table is None else table.path("profile")
    if table is None or name is None:
        return None
    from aadm_workbench.scan.camera_profile import read_profile

    try:
        return read_profile(folder / name, name)
    except (CameraError, ScanError) as error:
        raise table.wrong("profile", "said.sentences", parts=(error.reason,)) from error


def _stack(top: JobTable) -> StackSettings | None:
    if "stack" not in top.values:
        return None
    from .stack import read_stack

    return read_stack(top)


def _capture(top: JobTable) -> dict[str, str]:
    table = top.table("capture", "[capture]")
    if table is None:
        return {}
    table.allow(_CAPTURE)
    kept = {}
    for key, value in table.values.items():
        # A date may stand without quotes, and "" is a form that nobody has filled in.
        is_text = isinstance(value, str) or (key == "date" and hasattr(value, "isoformat"))
        if not is_text:
            raise table.wrong(key, "jobfile.not_text", shown=repr(value))
        if (sign := steering_character(str(value), but="\n\t")) is not None:
            raise table.wrong(key, "jobfile.control_character.plain", sign=sign)
        kept[key] = str(value)
    return kept
