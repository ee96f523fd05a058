"""The floor of benchmarks/design.py, in small: read exactly, and not one of its other elements taken."""

from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.design.ifc.model import read_ifc
from benchmarks.design import measure, write_floor


@pytest.fixture(scope="module")
def floor(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("floor") / "floor.ifc"
    write_floor(path, columns=6, others=240)
    return path


def test_every_centre_is_exact(floor: Path) -> None:
    timing = measure(floor, columns=6)
    assert (timing.columns, timing.points) == (6, 6 * 24)
    assert timing.worst_mm < 1e-3
    assert timing.parse > 0.0
    assert timing.read > 0.0


def test_nothing_else_is_taken(floor: Path) -> None:
    read = read_ifc(floor)
    assert (read.loose_sleeves, read.loose_rebars, read.warnings) == ((), (), ())
    assert {left.what for left in read.not_taken} == {"rebar"}


def test_only_what_may_be_a_sleeve_is_evaluated(floor: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Facets of fittings and brackets, walls, beams and pipes stay closed."""
    from aadm_workbench.design.ifc.geometry.solids import Solids

    opened: set[tuple[str, int]] = set()
    evaluate = Solids.of_item

    def of_item(self: Solids, item: Any) -> Any:
        opened.add((item.is_a(), item.id()))
        return evaluate(self, item)

    monkeypatch.setattr(Solids, "of_item", of_item)
    read_ifc(floor)
    kinds = sorted(kind for kind, _ in opened)
    assert kinds == ["IfcExtrudedAreaSolid"] * 2 + ["IfcSweptDiskSolid"] * 3, "column, sleeve, bar, cage and tie, once"
