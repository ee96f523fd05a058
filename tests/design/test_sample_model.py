"""The sample model: written the same each time, and read back to what it was written from."""

import math
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.read import read_model
from aadm_workbench.errors import DesignError


@pytest.fixture(scope="module")
def sample(repository: Path) -> Path:
    return repository / "samples" / "floor" / "floor3.ifc"


@pytest.fixture(scope="module")
def read(sample: Path) -> ModelDesign:
    return read_model(sample)


@pytest.fixture
def truth(repository: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """What the model is written from."""
    monkeypatch.syspath_prepend(repository / "samples")
    import make_model

    module: ModuleType = make_model
    return module


def test_it_is_written_byte_for_byte(repository: Path, sample: Path, tmp_path: Path) -> None:
    """In a process of its own: no time, no random GlobalId, no order of a set."""
    again = tmp_path / "again.ifc"
    subprocess.run([sys.executable, repository / "samples" / "make_model.py", again], check=True)
    assert again.read_bytes() == sample.read_bytes()


def test_every_column_comes_back(read: ModelDesign, truth: ModuleType, ring: list[tuple[float, float]]) -> None:
    assert [column.id for column in read.columns] == [f"C-30{k}" for k in range(1, 9)]
    assert sorted(ring) == sorted(truth.RING_MM)
    for column, (tag, grid, foot, turn_deg) in zip(read.columns, truth.columns(), strict=True):
        assert (column.id, column.grid, column.storey) == (tag, grid, "3F")
        assert (column.piece_mark, column.size_mm) == ("PCZ-1", (600.0, 600.0))
        assert column.warnings == ()
        assert column.embedded_length_mm == pytest.approx(160.0, abs=1e-3)
        turn = math.radians(turn_deg)
        T = column.T_model_column
        assert T is not None
        assert T[:3, 3] == pytest.approx(foot, abs=1e-3)
        assert T[:3, 0] == pytest.approx([math.cos(turn), math.sin(turn), 0.0], abs=1e-12)
        sleeves = np.array([point.centre for point in column.sleeves])
        rebars = np.array([point.centre for point in column.rebars])
        assert sleeves == pytest.approx(np.column_stack([ring, np.zeros(12)]), abs=1e-3)
        assert rebars == pytest.approx(np.column_stack([ring, np.full(12, 160.0)]), abs=1e-3)
        assert {(point.diameter_mm, point.length_mm) for point in column.sleeves} == {(36.0, 310.0)}
        assert {point.diameter_mm for point in column.rebars} == {20.0}


def test_each_element_is_taken_once(read: ModelDesign) -> None:
    taken = [point.global_id for column in read.columns for point in (*column.sleeves, *column.rebars)]
    assert len(set(taken)) == len(taken) == 8 * 24
    assert (read.loose_sleeves, read.loose_rebars, read.warnings) == ((), (), ())


def test_what_looks_alike_is_left_out_with_a_reason(read: ModelDesign) -> None:
    """Per column: two sockets for lifting, one for bracing, three stirrups, twelve bars of its own."""
    reasons = [left.reason for left in read.not_taken]
    assert len(reasons) == 8 * 18
    for words, number in (("吊装", 16), ("斜撑", 8), ("LIGATURE", 24), ("its own reinforcement", 96)):
        assert sum(words in reason for reason in reasons) == number


def test_the_selectors_of_a_job_give_the_same(sample: Path, read: ModelDesign) -> None:
    selected = read_model(
        sample, columns="IfcColumn", sleeves="IfcDiscreteAccessory, Name=/套筒|sleeve/", rebars="IfcReinforcingBar"
    )
    for one, other in zip(selected.columns, read.columns, strict=True):
        for a, b in zip((*one.sleeves, *one.rebars), (*other.sleeves, *other.rebars), strict=True):
            assert (a.global_id, a.centre.tolist()) == (b.global_id, b.centre.tolist())
    assert (selected.loose_sleeves, selected.loose_rebars) == ((), ())


def test_a_piece_mark_names_the_mould_not_the_piece(read: ModelDesign) -> None:
    with pytest.raises(DesignError) as caught:
        read.column("PCZ-1")
    said = str(caught.value)
    assert "names 8 columns" in said
    assert all(f"C-30{k}" in said for k in range(1, 9))


def test_lookup(read: ModelDesign) -> None:
    """By Tag, Name, GlobalId, and the assembly's name."""
    column = read.columns[2]
    for key in ("C-303", "预制柱 Precast column C-303", "预制构件 Cast unit C-303", column.global_id or ""):
        assert read.column(key) is column
    with pytest.raises(DesignError, match="no column called 'C-399'") as caught:
        read.column("C-399")
    assert "C-303" in str(caught.value)
