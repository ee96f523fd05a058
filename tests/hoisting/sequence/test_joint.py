"""Frames of one column put together, on patterns that are made and moved with complex numbers."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.hoisting.pattern_fit import Evidence, Pattern
from aadm_workbench.hoisting.sequence.joint import JointShape, Sight, join_sights
from aadm_workbench.model import Array

SIDE = [complex(-440.0 + 220.0 * k, -440.0) for k in range(4)]
RING = np.array([place * 1j**corner for corner in range(4) for place in SIDE])
SCATTER_MM, NOISE_MM, COMMON_MM = 0.5, 0.08, 0.15


def flat(places: np.ndarray) -> Array:
    return np.column_stack([places.real, places.imag])


def sight(shape: np.ndarray, camera: complex, rng: np.random.Generator, quarters: int = 0) -> tuple[Sight, np.ndarray]:
    """Ten of sixteen points of a shape that lies anyhow, all pushed along the view; and where all of them lie."""
    turn, shift = rng.uniform(-3.0, 3.0), complex(*rng.uniform(-200.0, 200.0, 2))
    lies = shape * np.exp(1j * turn) + shift
    index = np.sort(np.argsort(np.abs(shape - 1500.0 * camera))[:10])
    along = camera / abs(camera) * np.exp(1j * turn)
    noise = rng.normal(0.0, NOISE_MM, 10) + 1j * rng.normal(0.0, NOISE_MM, 10) + along * rng.normal(0.0, COMMON_MM)
    view = np.tile([along.real, along.imag], 10)
    covariance = NOISE_MM**2 * np.eye(20) + COMMON_MM**2 * np.outer(view, view)
    labels = np.array([int(np.abs(RING - RING[k] * 1j**quarters).argmin()) for k in index])
    order = np.argsort(labels)
    rows = (2 * order[:, None] + np.arange(2)).ravel()
    seen = Evidence(labels[order], flat((lies[index] + noise)[order]), covariance[np.ix_(rows, rows)])
    pose = np.array([shift.real + 2.0, shift.imag - 2.0, turn - 0.5 * np.pi * quarters + 0.004])
    return Sight(seen, pose), lies


def joined(seed: int, corners: list[complex], quarters: int = 0) -> tuple[JointShape, Array]:
    """A scene from some corners, and where its points truly lie in the last frame; the last may be labelled wrongly."""
    rng = np.random.default_rng([61, seed])
    shape = RING + rng.normal(0.0, SCATTER_MM, len(RING)) + 1j * rng.normal(0.0, SCATTER_MM, len(RING))
    sights = [sight(shape, camera, rng, quarters if camera == corners[-1] else 0) for camera in corners]
    found = join_sights([one for one, _ in sights], Pattern(flat(RING), np.full(len(RING), 0.7)))
    return found, flat(sights[-1][1])


TWO, THREE = [-1.0 - 1.0j, 1.0 + 1.0j], [-1.0 - 1.0j, 1.0 - 1.0j, 1.0 + 1.0j]


@pytest.mark.parametrize("corners", [TWO, THREE])
def test_what_the_last_frame_hides_is_known_as_well_as_it_says(corners: list[complex]) -> None:
    hidden = np.argsort(np.abs(RING - 1500.0 * corners[-1]))[10:]
    errors, squares, chances = [], [], []
    for seed in range(60):
        found, truth = joined(seed, corners)
        assert found.seen.all()
        off = found.centres - truth
        errors.append(np.hypot(*off[hidden].T))
        own = [found.covariance[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] for k in hidden]
        squares += [e @ np.linalg.solve(c, e) for e, c in zip(off[hidden], own, strict=True)]
        assert found.chance is not None
        chances.append(found.chance)
    assert np.mean(errors) < 0.35 < SCATTER_MM * np.sqrt(np.pi / 2.0)  # the error without the other frames
    assert 0.92 < np.mean(np.array(squares) < 5.991) < 0.99
    assert 0.4 < np.mean(chances) < 0.65  # frames that agree differ by chance, as much as chance has it
    assert min(chances) > 1e-4


def test_a_third_frame_tells_more() -> None:
    two, three = (
        np.mean([np.trace(joined(seed, corners)[0].covariance) for seed in range(10)]) for corners in (TWO, THREE)
    )
    assert three < 0.95 * two


@pytest.mark.parametrize("quarters", [1, -1, 2])
def test_a_frame_of_a_wrong_corner_does_not_fit_the_others(quarters: int) -> None:
    for seed in range(8):
        chance = joined(seed, THREE, quarters)[0].chance
        assert chance is not None
        assert chance < 1e-6


def test_one_frame_twice_is_no_surer_than_its_pushes_allow() -> None:
    found, _ = joined(3, [TWO[0], TWO[0]])
    assert not found.seen.all()
    hidden = ~found.seen
    spread = np.sqrt(np.diag(found.covariance).reshape(-1, 2).mean(axis=1))
    assert spread[hidden].min() > 0.3
