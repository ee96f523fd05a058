"""Turns of a pattern onto itself."""

from typing import Any

import numpy as np

from aadm_workbench.assembly.matching.symmetry import symmetric_turns
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.model import Array


def test_symmetric_turns_of_patterns(build: Any, square: Array) -> None:
    assert len(symmetric_turns(square)) == 4
    assert len(symmetric_turns(build.rectangle(4, 3, 240.0, 160.0))) == 2
    assert len(symmetric_turns(build.circle(9, 200.0))) == 9
    assert len(symmetric_turns(build.irregular(9, 500.0, 1))) == 1
    for found in symmetric_turns(square):
        np.testing.assert_allclose(square[:, :2] @ turn(found.angle).T, square[found.onto, :2], atol=1e-9)


def test_a_pattern_that_is_almost_symmetric_is_not(build: Any) -> None:
    """The built parts scatter by 2 mm; a drawing that differs by more than half a millimetre means it."""
    assert len(symmetric_turns(build.rectangle(4, 4, 240.0, 240.2))) == 4
    assert len(symmetric_turns(build.rectangle(4, 4, 240.0, 241.0))) == 2
    assert len(symmetric_turns(np.zeros((1, 3)))) == 1
