"""EOPA against scipy, against its own equations, and against a plate on a coordinate measuring machine."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from aadm_workbench.assembly.pose.eopa import EopaFit, NoFit, fit_eopa, fit_eopa_planar
from aadm_workbench.errors import AadmError


def fitted(fit: EopaFit | NoFit) -> EopaFit:
    assert isinstance(fit, EopaFit), fit
    return fit


@pytest.mark.parametrize("seed", range(40))
def test_agrees_with_scipy(seed: int) -> None:
    """Rotation.align_vectors solves the same problem by another road."""
    rng = np.random.default_rng(seed)
    X = rng.uniform(-300.0, 300.0, (12, 3))
    truth = Rotation.random(random_state=seed).as_matrix()
    Y = X @ truth + rng.uniform(-1e3, 1e3, 3) + rng.normal(0.0, 1.0, X.shape)
    weights = rng.uniform(0.2, 3.0, 12)
    fit = fitted(fit_eopa(X, Y, weights))
    share = weights / weights.sum()
    reference, _ = Rotation.align_vectors(Y - share @ Y, X - share @ X, weights)
    np.testing.assert_allclose(fit.R, reference.as_matrix().T, atol=1e-9)
    np.testing.assert_allclose(fit.t, share @ Y - share @ X @ reference.as_matrix().T, atol=1e-9)


@pytest.mark.parametrize("seed", range(200))
def test_coplanar_centres_are_never_mirrored(seed: int, build: Any) -> None:
    """The published R = VWᵀ has determinant −1 for half of all coplanar sets."""
    rng = np.random.default_rng(seed)
    X = build.rectangle(4, 4, 240.0, 240.0)
    noise = rng.normal(0.0, 1.0, X.shape) * np.array([1.0, 1.0, seed % 2])
    turned = build.rotation(rng)
    fit = fitted(fit_eopa((X + noise) @ turned.T, X))
    assert np.linalg.det(fit.R) == pytest.approx(1.0, abs=1e-12)
    assert fit.rms_mm < 3.0
    np.testing.assert_allclose(fit.R, turned, atol=0.02)


def test_published_equation_needs_the_determinant(build: Any) -> None:
    """Proof that the added diag(1, 1, det) is needed: without it some fits are mirrors."""
    X = build.rectangle(4, 4, 240.0, 240.0)
    signs = set()
    for seed in range(20):
        turned = build.rotation(np.random.default_rng(seed))
        Y = X @ turned.T
        V, _, Wt = np.linalg.svd((X - X.mean(axis=0)).T @ (Y - Y.mean(axis=0)))
        signs.add(round(float(np.linalg.det(V @ Wt))))
    assert signs == {-1, 1}


def test_T_maps_column_vectors_and_residuals_are_E(build: Any) -> None:
    rng = np.random.default_rng(1)
    X = rng.uniform(-300.0, 300.0, (7, 3))
    Y = X @ build.rotation(rng) + 5.0 + rng.normal(0.0, 0.5, X.shape)
    fit = fitted(fit_eopa(X, Y))
    aligned = (fit.T @ np.column_stack([X, np.ones(7)]).T).T[:, :3]
    np.testing.assert_allclose(Y - aligned, fit.residuals, atol=1e-10)
    assert fit.rms_mm == pytest.approx(np.sqrt((fit.residuals**2).sum(axis=1).mean()))


def test_no_other_pose_is_better() -> None:
    """The defining property: any small change of the pose raises the sum of squares."""
    rng = np.random.default_rng(3)
    X = rng.uniform(-300.0, 300.0, (12, 3))
    Y = X + rng.normal(0.0, 1.0, X.shape)
    fit = fitted(fit_eopa(X, Y))
    best = (fit.residuals**2).sum()
    for _ in range(100):
        change = Rotation.from_rotvec(rng.normal(0.0, 1e-4, 3)).as_matrix()
        assert ((Y - X @ fit.R @ change - fit.t - rng.normal(0.0, 1e-3, 3)) ** 2).sum() > best


def test_scale_is_a_diagnostic_and_never_applied() -> None:
    X = np.random.default_rng(2).uniform(-300.0, 300.0, (12, 3))
    fit = fitted(fit_eopa(X, 1.001 * X))
    assert fit.scale == pytest.approx(1.001, abs=1e-12)
    assert fit.rms_mm > 0.1
    np.testing.assert_allclose(fit.R @ fit.R.T, np.eye(3), atol=1e-12)


def test_map_coordinates_keep_their_digits() -> None:
    """Six million metres from the origin, as georeferenced models have it."""
    rng = np.random.default_rng(5)
    X = rng.uniform(-300.0, 300.0, (12, 3))
    fit = fitted(fit_eopa(X, X + np.array([6.7e9, 4.0e8, 1.0e5])))
    assert fit.rms_mm < 1e-5


@pytest.mark.parametrize(
    ("points", "reason"),
    [
        (np.zeros((0, 3)), "needs 3"),
        (np.array([[0.0, 0, 0], [1, 0, 0]]), "needs 3"),
        (np.array([[0.0, 0, 0], [1, 1, 1], [2, 2, 2], [5, 5, 5]]), "one line"),
        (np.ones((5, 3)), "coincide"),
        (np.array([[0.0, 0, 0], [1, 0, 0], [0, np.nan, 0]]), "finite"),
    ],
)
def test_what_cannot_be_fitted_says_why(points: Any, reason: str) -> None:
    fit = fit_eopa(points, points)
    assert not fit
    assert isinstance(fit, NoFit)
    assert reason in fit.reason


def test_wrong_shapes_are_an_error() -> None:
    with pytest.raises(AadmError, match=r"\(n, 3\)"):
        fit_eopa(np.zeros((4, 3)), np.zeros((5, 3)))


def test_planar_fit_needs_only_two_points() -> None:
    fit = fitted(fit_eopa_planar(np.array([[0.0, 0.0], [100.0, 0.0]]), np.array([[5.0, 5.0], [5.0, 106.0]])))
    assert fit.yaw == pytest.approx(np.pi / 2.0)
    assert fit.rms_mm == pytest.approx(0.5)
    assert not fit_eopa_planar(np.ones((3, 2)), np.ones((3, 2)))


def test_plate_on_a_measuring_machine(reference_data: Path) -> None:
    """53 drilled holes: unweighted least squares, nominal to measured."""
    lines = (reference_data / "csayres_D8300_1").read_text().splitlines()
    rows = np.array([[float(word) for word in line.split()[:4]] for line in lines[4:] if len(line.split()) == 9])
    assert len(rows) == 53
    fit = fitted(fit_eopa_planar(rows[:, 2:], rows[:, :2]))
    assert fit.t == pytest.approx([0.2711, 0.0797], abs=5e-5)
    assert np.degrees(fit.yaw) == pytest.approx(-0.0268, abs=5e-5)
    assert fit.rms_mm == pytest.approx(0.00664, abs=5e-6)
