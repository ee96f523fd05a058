"""What the FreeCAD workbench asks for: the columns of a model, and scans, in plain numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from aadm_workbench.errors import DesignError
from aadm_workbench.model import Reason, in_one
from aadm_workbench.private.answers import FoundColumns, ReadCamera, ReadScan

_SHOWN = 6  # reasons in a message; more say no more
_DIGITS_OF_BODY = 1  # of what is drawn as a ghost, mm
_DIGITS = 4  # of a point that is drawn, mm


def columns(question: Mapping[str, Any]) -> FoundColumns:
    """Columns with their assembly points.

    Parameters
    ----------
    question
        ``path`` of a model, or :class:`~aadm_workbench.private.answers.Shapes`.

    Raises
    ------
    DesignError
        Where there is none; says what was looked at.
    """
    from aadm_workbench.design.design_text import write_design

    bodies: dict[str, list[Any]] = {}
    model, designs = (_read(question["path"], bodies), None) if "path" in question else _sampled(question)
    found = model.columns if designs is None else designs
    if not found:
        said = in_one([*_reasons(model.not_taken), *filter(None, [model.hint])])
        raise DesignError.because("design.no_sleeves", source=model.source, help=said)
    return {
        "source": model.source,
        "sha256": model.sha256,
        "schema": model.schema,
        "project": model.project,
        "warnings": list(model.warnings),
        "columns": [write_design(design) for design in found],
        "bodies": [_in_column_frame(bodies.get(design.global_id or "", ()), design) for design in found],
    }


def _read(path: str, bodies: dict[str, list[Any]]) -> Any:
    """The model in a file; of an IFC file ``bodies`` gets what encloses its columns, too."""
    if Path(path).suffix.lower() == ".ifc":
        from aadm_workbench.design.ifc.model import read_ifc

        return read_ifc(path, bodies=bodies)
    from aadm_workbench.inspection.as_designed import read_design

    return read_design(path)


def _in_column_frame(faces: Sequence[Any], design: Any) -> list[list[list[float]]]:
    T = design.T_model_column
    if T is None:
        return []
    return [((face - T[:3, 3]) @ T[:3, :3]).round(_DIGITS_OF_BODY).tolist() for face in faces]


def _sampled(question: Mapping[str, Any]) -> tuple[Any, Sequence[Any] | None]:
    """The model that FreeCAD's shapes make, and the columns that were pointed at, one for each object."""
    from aadm_workbench.design.element_json import from_json
    from aadm_workbench.design.recognise.columns import Origin, recognise

    elements = from_json(question["elements"])
    origin = Origin(question["source"], question["sha256"], "FreeCAD", tuple(question["problems"]))
    if not question["chosen"]:
        return recognise(elements, origin), None
    models = []
    for chosen in question["chosen"]:
        ids = set(chosen["ids"])
        model = recognise(elements, origin, chosen=[one for one in elements if one.GlobalId in ids])
        _check_one(model, chosen["label"])
        models.append(model)
    return models[0], [model.columns[0] for model in models]


def _reasons(not_taken: Sequence[Any]) -> list[Reason]:
    """Why the first of some elements were left out."""
    return list(dict.fromkeys(Reason("said.of", what=one.name, why=one.reason) for one in not_taken))[:_SHOWN]


def _check_one(model: Any, label: str) -> None:
    """Refuse an object that is no column, or holds several."""
    if not model.columns:
        reasons = _reasons([left for left in model.not_taken if left.what == "sleeve"])
        raise DesignError.because("command.no_sleeves", label=label, why=in_one(reasons))
    if len(model.columns) > 1:
        called = ", ".join(column.id for column in model.columns[:_SHOWN])
        raise DesignError.because("command.several_columns", model=label, count=len(model.columns), called=called)


def scan(question: Mapping[str, Any]) -> ReadScan:
    """A scan for the eye.

    Parameters
    ----------
    question
        ``file``, ``units``, ``camera`` (intrinsics, the file that holds them, or None), ``depth_scale_mm`` or None,
        ``most_points``.

    Returns
    -------
    ReadScan
        Its points, and how it was read.

    Raises
    ------
    AadmError
        Where it cannot be read.
    """
    from aadm_workbench.model import Camera
    from aadm_workbench.scan.camera import read_camera, read_depth_scale_mm
    from aadm_workbench.scan.read import read_scan
    from aadm_workbench.scan.thinned import thinned

    file, asked, step_mm = Path(question["file"]), question["camera"], question["depth_scale_mm"]
    if isinstance(asked, str):
        camera: Camera | None = read_camera(Path(asked))
        step_mm = read_depth_scale_mm(Path(asked)) if step_mm is None else step_mm
    else:
        camera = None if asked is None else Camera(**asked)
    read = read_scan(file, units=question["units"], camera=camera, depth_scale_mm=step_mm, source=file.name)
    points, count = thinned(read.points, int(question["most_points"]))
    return {
        "sha256": read.sha256,
        "count": count,
        "points": (points @ read.R_file_scan.T).round(_DIGITS).tolist(),
        "R_file_scan": read.R_file_scan.tolist(),
        "camera": None if camera is None else asdict(camera),
        "depth_scale_mm": step_mm,
        "notes": list(read.notes),
    }


def camera(question: Mapping[str, Any]) -> ReadCamera:
    """A camera for all scans of a job.

    Parameters
    ----------
    question
        ``file`` with its intrinsics.

    Raises
    ------
    CameraError
        Where there are none in it.
    """
    from aadm_workbench.scan.camera import read_camera, read_depth_scale_mm

    file = Path(question["file"])
    return {"camera": asdict(read_camera(file)), "depth_scale_mm": read_depth_scale_mm(file)}


Answer = FoundColumns | ReadScan | ReadCamera
ANSWERS: dict[str, Callable[[Mapping[str, Any]], Answer]] = {"columns": columns, "scan": scan, "camera": camera}
"""By what is asked."""
