"""The paper's hoisting studies: what they run, and what they print beside the paper's numbers."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.twin.study.hoisting import HoistingStudy, cells_of, study_hoisting
from aadm_workbench.twin.study.hoisting_plots import mean_key_error, write_hoisting_plots
from aadm_workbench.twin.study.hoisting_tables import CELLS, CONDITIONS
from batch.shown.study_tables import hoisting_document, hoisting_tables


@pytest.fixture(scope="module")
def study() -> HoistingStudy:
    """The nearest and the farthest camera, one scene each."""
    cells = [cell for cell in cells_of("distance") if cell.value in (550.0, 1050.0)]
    return study_hoisting("distance", cells, ["refined", "fusion"], scenes=1, seed=1)


def test_every_cell_of_the_paper_is_studied() -> None:
    for name, published in CELLS.items():
        assert {cell.value for cell in cells_of(name)} == set(published)
    assert {cell.name for cell in cells_of("conditions")} == set(CONDITIONS)


def test_the_papers_means_are_those_of_its_keys() -> None:
    for published in CELLS.values():
        for cell in published.values():
            if cell.mean is not None:
                keys = [key for key in cell.keys if key is not None]
                assert sum(keys) / 3 == pytest.approx(cell.mean, abs=0.011)


def test_refined_beats_the_published_method_in_the_same_frames(study: HoistingStudy) -> None:
    for cell in study.cells:
        mean = mean_key_error(study, cell, "refined")
        assert mean is not None
        assert mean < 0.2
        published = mean_key_error(study, cell, "fusion")
        assert published is None or published > 2 * mean


def test_tables_plots_and_numbers(study: HoistingStudy, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    tables = hoisting_tables(study)
    assert any(isinstance(part, str) and "Synthetic frames" in part for part in tables)
    document = hoisting_document(study)
    assert [cell["cell"] for cell in document["cells"]] == ["550", "1050"]
    paths = write_hoisting_plots(study, tmp_path)
    assert [path.name for path in paths] == ["distance-errors.png", "distance-times.png"]
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in paths)
    from aadm_workbench.report.json import encode

    assert json.loads(encode(document))["synthetic"] is True
