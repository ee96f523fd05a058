"""What is lost at edges is learned from a camera whose losses are put in pixel by pixel, and taken from other discs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.calibration.learn.capture import PlateCapture
from aadm_workbench.calibration.learn.losses import Losses, losses_of
from aadm_workbench.calibration.learn.witness import mixed
from aadm_workbench.calibration.plate.plate import Plate, drawn_plate
from aadm_workbench.extract.edges.learned_edges import KnownEdges, known_edges, without_losses, without_view
from aadm_workbench.extract.edges.seen_disc import SightLines, seen_discs
from aadm_workbench.model import Array, Camera, CameraProfile, Kind, LearnedEdges, Measure, Plane, Scan

CAMERA = Camera(2400.0, 2400.0, 960.0, 600.0, 1920, 1200)
DISTANCE_MM = 1300.0
PROJECTOR_MM = 240.0
LOST, KEPT_FROM = 1.6, 0.06
"""Pixels that are lost at an edge, unless the wall behind is seen and lit at this slope or more."""


def wall_is_kept(at: Array, outward: Array, height_mm: float, side: float) -> Array:
    """Whether the wall behind an edge at a place (n, 2) is seen and lit; the projector stands beside the camera."""
    eye = DISTANCE_MM - height_mm
    seen = side * (outward * at).sum(axis=-1) / eye
    lit = side * (outward * (at - [PROJECTOR_MM, 0.0])).sum(axis=-1) / eye
    return np.asarray((seen > KEPT_FROM) & (lit > KEPT_FROM))


@pytest.fixture(scope="module")
def plate() -> Plate:
    return drawn_plate(12, 36.0, 160.0, 20.0)


def captured(plate: Plate, turn_deg: float, off: tuple[float, float]) -> PlateCapture:
    """A plate square to the view, painted by what each pixel's line of sight crosses; no noise at all."""
    c, s = np.cos(np.radians(turn_deg)), np.sin(np.radians(turn_deg))
    u, v = np.meshgrid(np.arange(CAMERA.width), np.arange(CAMERA.height))
    tangent = np.stack([(u - CAMERA.cx) / CAMERA.fx, (v - CAMERA.cy) / CAMERA.fy], -1)
    depth = np.full(u.shape, DISTANCE_MM)
    places = np.array([[one.x_mm, one.y_mm] for one in plate.places]) @ np.array([[c, s], [-s, c]]) + off
    for one, centre in zip(plate.places, places, strict=True):
        side = 1.0 if one.kind is Kind.SLEEVE else -1.0
        at = tangent * (DISTANCE_MM - one.z_mm)
        away = at - centre
        distance = np.maximum(np.hypot(away[..., 0], away[..., 1]), 1e-9)
        kept = wall_is_kept(centre, away / distance[..., None], one.z_mm, side)
        edge = one.diameter_mm / 2.0 + side * np.where(kept, 0.0, LOST) * (DISTANCE_MM - one.z_mm) / CAMERA.fx
        if one.kind is Kind.SLEEVE:
            depth[distance < edge] = np.nan
        else:
            depth[distance < edge] = DISTANCE_MM - one.z_mm
    points = np.concatenate([tangent * depth[..., None], depth[..., None]], axis=-1)
    # the face's own axes: x as the camera's, y against it
    face = Plane(np.array([0.0, 0.0, -1.0]), -DISTANCE_MM)
    flat = places * [1.0, -1.0]
    heights = np.array([one.z_mm for one in plate.places])
    sizes = np.array([one.diameter_mm for one in plate.places])
    scan = Scan(points, "painted", camera=CAMERA, viewpoint=np.zeros(3))
    return PlateCapture("painted", scan, CAMERA, face, flat, heights, np.arange(len(places)), np.eye(4), sizes)


@pytest.fixture(scope="module")
def losses(plate: Plate) -> Losses:
    poses = [(0.0, (12.0, -8.0)), (90.0, (-10.0, 5.0)), (180.0, (-6.0, -12.0)), (270.0, (9.0, 10.0))]
    captures = [captured(plate, turn, off) for turn, off in poses]
    # where the plate lies is not known better than this
    moved = [one.flat + np.array([0.05, -0.03]) for one in captures]
    return losses_of(captures, plate, moved)


def test_what_is_lost_is_learned_in_pixels(losses: Losses) -> None:
    for kind in Kind:
        law = dict(losses.lost[kind])
        assert law[-0.1] == pytest.approx(LOST, abs=0.25)
        assert law[0.16] == pytest.approx(0.0, abs=0.3)


def test_the_light_is_found_on_its_side(losses: Losses) -> None:
    x, y = losses.projector_mm
    assert x >= 120.0
    assert abs(y) < 0.6 * x


def profile_of(losses: Losses) -> CameraProfile:
    nothing = Measure(0.0, 0.0)
    edges = {kind: LearnedEdges(nothing, 0.0, 0.1, nothing, losses.lost[kind], share=1.0) for kind in Kind}
    span = (1300.0, 1300.0)
    return CameraProfile("", "", "", "", "", 90, CAMERA, span, span, nothing, edges, projector_mm=losses.projector_mm)


def test_discs_of_another_foot_are_set_right(losses: Losses) -> None:
    """Mouths at places that the plate had not, painted by the same law, at half the distance between pixels."""
    rng = np.random.default_rng(5)
    places, radius = rng.uniform(-300.0, 300.0, (10, 2)), 20.0
    places = places[np.hypot(*places.T) > 120.0]
    pitch = DISTANCE_MM / CAMERA.fx
    grid = np.stack(np.meshgrid(np.arange(-28.0, 28.0, pitch), np.arange(-28.0, 28.0, pitch)), -1).reshape(-1, 2)
    lines = [grid + rng.uniform(0.0, pitch, 2) for _ in places]
    distance = np.array([np.hypot(*one.T) for one in lines])
    outward = np.array(lines) / distance[..., None]
    kept = np.array([wall_is_kept(place, out, 0.0, 1.0) for place, out in zip(places, outward, strict=True)])
    height = np.where(distance > radius + np.where(kept, 0.0, LOST) * pitch, 0.0, np.nan)
    x, y = np.moveaxis(np.array(lines), -1, 0)
    sight = SightLines(x, y, height, places / DISTANCE_MM)
    eye = np.column_stack([-places, np.full(len(places), DISTANCE_MM)])
    known = known_edges(profile_of(losses), Kind.SLEEVE, eye, np.eye(3))
    assert known is not None
    start, found = np.zeros_like(places), []
    for seen in (sight, without_losses(sight, start, 1.0, known)):
        discs = seen_discs(seen, np.isfinite(seen.height), start, radius, pitch, 1.0)
        found.append((np.hypot(*discs.centre.T), discs.radius - radius))
    (raw, raw_radius), (right, right_radius) = found
    assert np.median(raw) > 0.15
    assert np.median(right) < 0.4 * np.median(raw)
    assert abs(right_radius) < 0.3 * abs(raw_radius)


def test_nothing_is_known_without_a_profile_that_knows_it(losses: Losses) -> None:
    eye = np.array([[0.0, 0.0, DISTANCE_MM]])
    assert known_edges(None, Kind.SLEEVE, eye, np.eye(3)) is None
    profile = profile_of(losses)
    assert known_edges(profile, Kind.SLEEVE, None, np.eye(3)) is None
    bare = {kind: replace(edges, lost=()) for kind, edges in profile.edges.items()}
    assert known_edges(replace(profile, edges=bare), Kind.SLEEVE, eye, np.eye(3)) is None
    known = known_edges(profile, Kind.SLEEVE, eye, np.eye(3))
    assert isinstance(known, KnownEdges)
    assert known.pitch_mm == pytest.approx(DISTANCE_MM / CAMERA.fx)


def test_only_the_part_along_the_views_is_taken_from_others() -> None:
    rng = np.random.default_rng(8)
    slope, own = rng.normal(0.0, 0.2, (12, 2)), rng.normal(0.0, 0.05, (12, 2))
    like = rng.normal(0.0, 1e-9, (12, 2))
    moved = without_view(own + 0.7 * slope + [0.2, -0.1], like, slope)
    again = without_view(own, like, slope)
    assert moved == pytest.approx(again + np.array([0.2, -0.1]), abs=1e-6)


def test_centres_are_drawn_by_their_kinds_share(plate: Plate) -> None:
    one = captured(plate, 0.0, (0.0, 0.0))
    fewer = np.arange(1, len(one.place))
    other = replace(one, flat=one.flat[fewer] + 1.0, place=one.place[fewer])
    found = mixed(one, other, {Kind.SLEEVE: 0.25, Kind.REBAR: 1.0}, plate)
    pins = np.array([plate.places[k].kind is Kind.REBAR for k in one.place])
    assert found.flat[0] == pytest.approx(one.flat[0])
    assert found.flat[1:] - one.flat[1:] == pytest.approx(np.where(pins, 1.0, 0.25)[1:, None] * np.ones(2))
