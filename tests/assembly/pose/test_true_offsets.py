"""What leaning axes may be in truth: axes that are made here, measured with errors, and bent where nobody looks."""

import numpy as np
import pytest

from aadm_workbench.assembly.pose.true_offsets import MeasuredShifts

BARS, GROUPS, DRAWS = 12, 300, 200


@pytest.mark.parametrize(("lean_mm", "error_mm", "bent_mm"), [(0.5, 0.16, 0.3), (0.8, 0.6, 0.2), (0.8, 0.2, 0.0)])
def test_true_leans_lie_where_they_are_drawn(lean_mm: float, error_mm: float, bent_mm: float) -> None:
    """How far each axis is from its group's middle, and how much all of them are, in groups that are made anew.

    A bend that nobody saw is not among what was measured: axes that stand out are drawn back by the errors' part alone.
    """
    rng = np.random.default_rng(1)
    along, spread = [], []
    for _ in range(GROUPS):
        seen = rng.normal(0.0, lean_mm, (BARS, 2))
        measured = seen + rng.normal(0.0, error_mm, seen.shape)
        true = seen + rng.normal(0.0, bent_mm, seen.shape)
        errors = np.broadcast_to(error_mm**2 * np.eye(2), (BARS, 2, 2))
        group = MeasuredShifts(measured, errors, np.full(BARS, bent_mm), 0.8)
        drawn = group.drawn(DRAWS, rng)
        out = measured - measured.mean(axis=0)
        out /= np.sqrt((out**2).sum())
        back = ((true - measured) * out).sum()
        draws = (drawn * out).sum(axis=(1, 2))
        along.append((back - draws.mean()) / draws.std())
        lengths = np.hypot(*(measured + drawn).transpose(2, 0, 1)).max(axis=1)
        spread.append((lengths < np.hypot(*true.T).max()).mean())
    assert np.mean(along) == pytest.approx(0.0, abs=4.0 / np.sqrt(GROUPS))
    assert np.std(along) == pytest.approx(1.0, abs=0.25)
    # The longest of all: its place among the draws is spread evenly.
    assert np.mean(spread) == pytest.approx(0.5, abs=4.0 / np.sqrt(12.0 * GROUPS))
