"""What cameras do to depth maps: each filter does what its name says, and no more."""

import numpy as np
import pytest

from aadm_workbench.errors import AadmError
from aadm_workbench.twin.filters import NAMES, Filters, filtered, filters_of, near_steps


@pytest.fixture
def step() -> np.ndarray:
    """A surface at 1300 mm, and from column 30 on one at 1200 mm."""
    depth = np.full((40, 60), 1300.0, np.float32)
    depth[:, 30:] = 1200.0
    return depth


@pytest.mark.parametrize("rings", [1, 2, 3])
def test_rings_go_on_both_sides_of_a_step_and_nowhere_else(step: np.ndarray, rings: int) -> None:
    lost = np.isnan(filtered(step, Filters(rings=rings)))
    assert np.flatnonzero(lost.all(axis=0)).tolist() == list(range(30 - rings, 30 + rings))
    assert lost.sum() == 40 * 2 * rings


@pytest.mark.parametrize("rings", [1, 2, 3])
def test_rings_go_around_a_patch_of_nothing_and_not_around_a_lost_pixel(rings: int) -> None:
    depth = np.full((40, 60), 1300.0, np.float32)
    depth[10, 50] = np.nan
    depth[15:25, 10:20] = np.nan
    lost = np.isnan(filtered(depth, Filters(rings=rings)))
    assert lost.sum() == 1 + (10 + 2 * rings) ** 2


def test_a_tilted_face_has_no_steps() -> None:
    depth = (1300.0 + 0.4 * np.arange(60, dtype=np.float32))[None].repeat(40, 0)
    assert not near_steps(depth, 3).any()


def test_the_edge_mask_asks_for_the_brightest_neighbour(step: np.ndarray) -> None:
    light = np.where(step > 1250.0, 0.6, 1.0).astype(np.float32)
    light[:, 29] = 0.45
    light[5, 5] = 0.28
    lost = np.isnan(filtered(step, Filters(edge_mask=0.5), light))
    assert lost[:, 29].all()
    assert lost[5, 5]
    assert lost.sum() == 41


def test_an_edge_mask_without_brightness_is_refused(step: np.ndarray) -> None:
    with pytest.raises(AadmError, match="camera fringe"):
        filtered(step, Filters(edge_mask=0.5))


def test_outliers_go_and_edges_stay(step: np.ndarray) -> None:
    step[10, 10] = 1230.0
    lost = np.isnan(filtered(step, Filters(outliers=5)))
    assert lost[10, 10]
    assert lost.sum() == 1


def test_what_is_nearer_gets_fat(step: np.ndarray) -> None:
    fat = filtered(step, Filters(fatten=2))
    assert np.flatnonzero((fat == 1200.0).all(axis=0)).tolist() == list(range(28, 60))
    assert (fat[:, :28] == 1300.0).all()


def test_narrow_gaps_are_filled_and_wide_ones_are_not() -> None:
    depth = np.full((40, 60), 1300.0, np.float32)
    depth[10:13, 10:13] = np.nan
    depth[20:32, 30:42] = np.nan
    full = filtered(depth, Filters(gaps=4))
    np.testing.assert_allclose(full[10:13, 10:13], 1300.0, atol=1e-3)
    assert np.isnan(full[20:32, 30:42]).all()


def test_a_median_keeps_a_step_and_takes_spikes(step: np.ndarray) -> None:
    spoilt = step.copy()
    spoilt[20, 10] = 1100.0
    spoilt[20, 40] = np.nan
    smooth = filtered(spoilt, Filters(median=5))
    assert np.isnan(smooth[20, 40])
    smooth[20, 40] = 1200.0
    np.testing.assert_array_equal(smooth, step)


def test_a_gaussian_halves_noise_as_its_kernel_says_and_rounds_steps(step: np.ndarray) -> None:
    rng = np.random.default_rng(3)
    noise = rng.normal(0.0, 0.1, (300, 300)).astype(np.float32)
    smooth = filtered(1300.0 + noise, Filters(gaussian=1.5))
    # The variance of white noise falls to 1 / (4 pi sigma^2).
    assert smooth.std() == pytest.approx(0.1 / np.sqrt(4.0 * np.pi * 1.5**2), rel=0.05)
    assert 1205.0 < filtered(step, Filters(gaussian=1.5))[20, 30] < 1255.0


def test_no_filter_changes_nothing(step: np.ndarray) -> None:
    step[3, 3] = np.nan
    np.testing.assert_array_equal(filtered(step, Filters()), step)


def test_words_become_filters() -> None:
    assert filters_of(["rings=2", "edge-mask=0.5", "gaussian=1.5"]) == Filters(rings=2, edge_mask=0.5, gaussian=1.5)


@pytest.mark.parametrize(
    ("word", "says"),
    [
        ("ring=1", "no filter ring"),
        ("rings", "a whole number"),
        ("rings=1.5", "a whole number"),
        ("rings=4", "from 0 to 3"),
        ("gaussian=-1", "from 0 to 10"),
        ("gaussian=nan", "from 0 to 10"),
        ("step-mm=4", "no filter step-mm"),
    ],
)
def test_a_word_that_is_no_filter_is_refused(word: str, says: str) -> None:
    with pytest.raises(AadmError, match=says):
        filters_of([word])


def test_every_filter_can_be_named() -> None:
    assert set(NAMES) == {"edge-mask", "outliers", "rings", "fatten", "gaps", "median", "gaussian"}
