"""A floor with every verdict, checked once for all tests; they take copies."""

import copy
from typing import Any

import pytest

from tests.report.checked_floor import CASES, floor_report


@pytest.fixture(scope="session")
def _floor() -> dict[str, Any]:
    return floor_report(*CASES)


@pytest.fixture
def floor(_floor: dict[str, Any]) -> dict[str, Any]:
    """report.json of the floor, free to be changed."""
    return copy.deepcopy(_floor)
