"""camera-….toml: what was learned about a camera, read and written."""

from __future__ import annotations

import hashlib
import math
import tomllib
from pathlib import Path

import msgspec

from aadm_workbench.bounded import toml_fault
from aadm_workbench.errors import CameraError
from aadm_workbench.model import CameraProfile, Kind, LearnedEdges, Measure
from aadm_workbench.model.reason import said_of
from aadm_workbench.scan.file import load
from aadm_workbench.scan.intrinsics import Intrinsics, checked_camera

_KINDS = {"sleeves": Kind.SLEEVE, "rebars": Kind.REBAR}
_FARTHEST = 0.02  # of a stretch or a scale: a camera that is off by more was not learned but mistaken


class _Camera(msgspec.Struct, forbid_unknown_fields=True):
    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int


class _Edges(msgspec.Struct, forbid_unknown_fields=True):
    stretch: tuple[float, float]
    spread: float
    scatter_pitches: float
    size: tuple[float, float]
    lost: tuple[tuple[float, float], ...] = ()
    share: float = 0.0
    apart_pitches: float = 0.0
    rings: float | None = None


class _Learned(msgspec.Struct, forbid_unknown_fields=True):
    captures: int
    distance_mm: tuple[float, float]
    tilt_deg: tuple[float, float]
    scale: tuple[float, float]
    sleeves: _Edges
    rebars: _Edges
    projector_mm: tuple[float, float] = (0.0, 0.0)


class _File(msgspec.Struct, forbid_unknown_fields=True):
    schema: int
    serial: str
    settings: str
    date: str
    valid_days: int
    plate_sha256: str
    camera: _Camera
    learned: _Learned
    temperature_c: float | None = None
    figures: dict[str, object] = {}
    laws: int = 0


def profile_text(profile: CameraProfile, figures: str = "") -> str:
    """What the file holds; ``figures`` is a table of TOML for people, which is not read back."""
    camera, quoted = profile.camera, msgspec.json.encode
    lines = [
        "# What aadm camera learn found about one camera with its settings: each figure with its standard uncertainty.",
        "schema = 1",
        *(f"{name} = {quoted(getattr(profile, name)).decode()}" for name in ("serial", "settings", "date")),
        f"valid_days = {profile.valid_days}",
        f"laws = {profile.laws}",
        f'plate_sha256 = "{profile.plate_sha256}"',
        "",
        "[camera]",
        *(f"{name} = {getattr(camera, name)!r}" for name in ("fx", "fy", "cx", "cy", "width", "height")),
        "",
        "[learned]",
        f"captures = {profile.captures}",
        f"distance_mm = [{profile.distance_mm[0]:.1f}, {profile.distance_mm[1]:.1f}]",
        f"tilt_deg = [{profile.tilt_deg[0]:.2f}, {profile.tilt_deg[1]:.2f}]",
        f"scale = {_pair(profile.scale)}",
        f"projector_mm = [{profile.projector_mm[0]:.0f}, {profile.projector_mm[1]:.0f}]",
    ]
    for name, kind in _KINDS.items():
        edges = profile.edges[kind]
        lines += ["", f"[learned.{name}]", f"stretch = {_pair(edges.stretch)}", f"spread = {edges.spread:.4g}"]
        lines += [f"scatter_pitches = {edges.scatter_pitches:.4g}", f"size = {_pair(edges.size)}"]
        lines += [f"share = {edges.share:.3f}", f"apart_pitches = {edges.apart_pitches:.4g}"]
        lines += [] if edges.rings is None else [f"rings = {edges.rings:.2f}"]
        lines += [f"lost = [{', '.join(f'[{slope:g}, {pitches:.3f}]' for slope, pitches in edges.lost)}]"]
    return "\n".join(lines) + "\n" + figures


def _pair(measure: Measure) -> str:
    return f"[{measure.value:.6g}, {measure.u:.4g}]"


def read_profile(path: Path, source: str = "") -> CameraProfile:
    """A camera's profile; ``source`` is what reports call it.

    Raises
    ------
    CameraError
        Where the file is none, or holds numbers that no camera has.
    """
    content = load(path, source or str(path)).content
    try:
        found = msgspec.convert(tomllib.loads(content.decode("utf-8-sig")), _File, strict=False)
    except (ValueError, msgspec.ValidationError) as error:
        raise CameraError(said_of(source or path, "calibration.no_profile", why=toml_fault(error))) from error
    learned = found.learned
    numbers = [*learned.scale, *learned.sleeves.stretch, *learned.rebars.stretch]
    numbers += [learned.sleeves.spread, learned.rebars.spread]
    if not all(math.isfinite(one) and abs(one) < _FARTHEST for one in numbers):
        raise CameraError(said_of(source or path, "calibration.far_profile", most=100.0 * _FARTHEST))
    one = found.camera
    intrinsics = Intrinsics("", one.fx, one.fy, one.cx, one.cy, one.width, one.height, learned.scale[1])
    return CameraProfile(
        source or str(path),
        hashlib.sha256(content).hexdigest(),
        found.serial,
        found.settings,
        found.date,
        found.valid_days,
        checked_camera(intrinsics),
        learned.distance_mm,
        learned.tilt_deg,
        Measure(*learned.scale),
        {kind: _edges(getattr(learned, name)) for name, kind in _KINDS.items()},
        found.plate_sha256,
        learned.captures,
        learned.projector_mm,
        found.laws,
    )


def _edges(found: _Edges) -> LearnedEdges:
    return LearnedEdges(
        Measure(*found.stretch),
        found.spread,
        found.scatter_pitches,
        Measure(*found.size),
        found.lost,
        found.share,
        found.apart_pitches,
        found.rings,
    )
