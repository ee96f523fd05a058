"""Fixtures of the design tests: an author of small IFC models, and the models of other people's programs."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.design.authoring import Author


@pytest.fixture
def author(tmp_path: Path) -> Callable[..., Author]:
    """``author(schema=..., unit=..., wcs=...)`` starts a model."""
    return lambda **settings: Author(tmp_path, **settings)


@pytest.fixture(scope="session")
def reference_models() -> Path:
    """Models of other people's programs; AADM_REFERENCE_DATA names the folder, ../shared/data by default."""
    default = Path(__file__).resolve().parents[3] / "shared" / "data"
    folder = Path(os.environ.get("AADM_REFERENCE_DATA", default)) / "ifc"
    if not folder.is_dir():
        pytest.skip("no reference data in ../shared/data, and AADM_REFERENCE_DATA names no folder with them")
    return folder


@pytest.fixture
def ring() -> list[tuple[float, float]]:
    """Twelve centres, 160 mm apart, in the order of their labels."""
    side = (-240.0, -80.0, 80.0, 240.0)
    return (
        [(x, -240.0) for x in side]
        + [(240.0, y) for y in side[1:]]
        + [(x, 240.0) for x in side[-2::-1]]
        + [(-240.0, y) for y in side[-2:0:-1]]
    )
