"""What was learned, as a profile for jobs and as figures for people: in the file, as JSON, in the terminal."""

from __future__ import annotations

import json
from collections.abc import Iterator

import numpy as np

from aadm_workbench.calibration.learn.edges import SIDES
from aadm_workbench.calibration.learn.learn import Learned
from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.extract.edges.learned_edges import EDGE_LAWS
from aadm_workbench.model import CameraProfile, Json, Kind, Measure


def profile_of(found: Learned, plate: Plate, serial: str, settings: str, date: str, valid_days: int) -> CameraProfile:
    """The profile that a job uses; its hash is that of its file, once it is written."""
    distances = [capture.distance_mm for capture in found.captures]
    tilts = [capture.tilt_deg for capture in found.captures]
    return CameraProfile(
        "",
        "",
        serial,
        settings,
        date,
        valid_days,
        found.captures[0].camera,
        (min(distances), max(distances)),
        (min(tilts), max(tilts)),
        found.scale,
        found.edges,
        plate.sha256,
        len(found.captures),
        found.projector_mm,
        EDGE_LAWS,
    )


def learned_document(found: Learned) -> dict[str, Json]:
    """All figures with their u, where they have one: lengths in mm, stretches relative, edges in pixels."""
    lengths, bend = found.lengths, found.bend_mm
    return {
        "captures": [
            {"source": one.source, "distance_mm": one.distance_mm, "tilt_deg": one.tilt_deg} for one in found.captures
        ],
        "scale": _pair(found.scale),
        "stretch": {kind.plural: _pair(found.edges[kind].stretch) for kind in Kind},
        "spread": {kind.plural: found.edges[kind].spread for kind in Kind},
        "scatter_mm": {kind.plural: found.stretches.scatter_mm[kind] for kind in Kind},
        "size": {kind.plural: _pair(found.edges[kind].size) for kind in Kind},
        "bars_from_sleeves_mm": [_pair(one) for one in found.stretches.apart],
        "edges": {
            kind.plural: {
                side: {
                    "lost_pixels": _pair(found.sides[kind][side].lost),
                    "overhang_pixels": _pair(found.sides[kind][side].overhang),
                    "curl_mm": _pair(found.sides[kind][side].curl_mm),
                }
                for side in SIDES
            }
            for kind in Kind
        },
        "noise_mm": [face.noise_mm for face in found.faces],
        "noise_grows_with_power": _pair(found.noise_grows),
        "length_error_mm": [lengths.worst_mm, lengths.u_mm],
        "length_error_over_mm": lengths.over_mm,
        "length_error_rms_mm": lengths.rms_mm,
        "flatness_mm": max(face.flatness_mm for face in found.faces),
        "form_95_mm": max(face.form_95_mm for face in found.faces),
        "bend_map_mm": [[None if not np.isfinite(one) else round(float(one), 4) for one in row] for row in bend],
    }


def _pair(measure: Measure | None) -> Json:
    """A number with its u; None: not measured."""
    return None if measure is None else [measure.value, measure.u]


def figures_text(found: Learned, temperature_c: float | None) -> str:
    """The figures as a table of TOML, for people: jobs do not read them. What was not measured is left out."""
    lines = [] if temperature_c is None else [f"temperature_c = {temperature_c:g}"]
    for name, value in _flat("", learned_document(found)):
        if name not in {"captures", "bend_map_mm"}:
            lines.append(f'"{name}" = {json.dumps(value)}')
    return "\n[figures]\n" + "\n".join(lines) + "\n"


def _flat(before: str, value: dict[str, Json]) -> Iterator[tuple[str, Json]]:
    for name, one in value.items():
        if isinstance(one, dict):
            yield from _flat(f"{before}{name}.", one)
        elif one is not None:
            yield f"{before}{name}", _shortened(one)


def _shortened(value: Json) -> Json:
    if isinstance(value, list):
        return [_shortened(one) for one in value]
    return float(f"{value:.4g}") if isinstance(value, float) else value
