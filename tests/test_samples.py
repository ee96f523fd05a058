"""The samples as a user would check them: every verdict is the one that their truth implies."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

from aadm_workbench.report.json import encoded_report, report_schema
from aadm_workbench.report.words.reasons import in_both_languages
from batch.job.file import read_job
from batch.runner.run import RunOptions, run_job
from tests.frozen import KEPT, frozen

SAMPLES = Path(__file__).resolve().parents[1] / "samples"


@cache
def truth(sample: str) -> dict[str, Any]:
    columns: dict[str, Any] = json.loads((SAMPLES / sample / "truth.json").read_text(encoding="utf-8"))["columns"]
    return columns


@cache
def report(sample: str, method: str = "refined", only: tuple[str, ...] = ()) -> dict[str, Any]:
    run = run_job(read_job(SAMPLES / sample / "job.toml"), RunOptions(method, only))
    return json.loads(encoded_report(run.report))  # type: ignore[no-any-return]


def in_plane_errors(document: dict[str, Any], sample: str, kind: str) -> np.ndarray:
    """Distances mm, in the plane of the column frame, of measured centres from the true ones."""
    errors = []
    for column in document["columns"]:
        if column[kind] is None or column[kind]["fit"] is None:
            continue
        rotation = np.array(column[kind]["fit"]["T_design_scan"])[:2, :3]
        for point, true in zip(column[kind]["points"], truth(sample)[column["id"]][kind], strict=True):
            assert point["label"] == true["label"]
            assert (point["scan_mm"] is not None) == true["measurable"]
            if point["scan_mm"] is not None:
                errors.append(np.linalg.norm(rotation @ (np.array(point["scan_mm"]) - true["scan_mm"])))
    return np.array(errors)


@pytest.mark.parametrize("sample", ["floor", "lab"])
def test_every_verdict_is_the_one_that_the_truth_implies(sample: str) -> None:
    found = {column["id"]: (column["verdict"], column["goes_on"]) for column in report(sample)["columns"]}
    assert found == {key: (true["verdict"], true["goes_on"]) for key, true in truth(sample).items()}


@pytest.mark.parametrize(
    ("sample", "kind", "bound_mm"),
    [("floor", "sleeves", 0.065), ("floor", "rebars", 0.09), ("lab", "sleeves", 0.04), ("lab", "rebars", 0.055)],
)  # half as much again as was measured
def test_refined_centres_stay_as_accurate_as_they_were(sample: str, kind: str, bound_mm: float) -> None:
    errors = in_plane_errors(report(sample), sample, kind)
    assert len(errors) > 20
    assert errors.mean() < bound_mm


def test_published_centres_are_within_one_and_a_half_millimetres() -> None:
    document = report("floor", "fusion", ("C-301", "C-305"))
    for kind in ("sleeves", "rebars"):
        assert in_plane_errors(document, "floor", kind).mean() < 1.5


def test_least_squares_and_minimax_say_what_the_truth_says() -> None:
    column = next(entry for entry in report("floor")["columns"] if entry["id"] == "C-303")
    for name in ("least_squares", "minimax"):
        assert column["trial_assembly"][name]["max_mm"] == pytest.approx(
            truth("floor")["C-303"][name]["max_mm"], abs=0.3
        )
    assert any(pair["verdict"] == "fail" for pair in column["trial_assembly"]["least_squares"]["pairs"])
    assert all(pair["verdict"] == "pass" for pair in column["trial_assembly"]["minimax"]["pairs"])


@pytest.mark.parametrize("sample", ["floor", "lab"])
def test_nothing_has_changed_that_was_not_meant_to(sample: str) -> None:
    kept = json.loads(KEPT.read_text(encoding="utf-8"))[sample]
    assert_alike(frozen(report(sample)), kept)


def assert_alike(found: Any, kept: Any, at: str = "") -> None:
    """The same but for a few µm, which other processors and libraries add."""
    if isinstance(kept, dict):
        assert found.keys() == kept.keys(), at
        for key, value in kept.items():
            assert_alike(found[key], value, f"{at}/{key}")
    elif isinstance(kept, list):
        assert len(found) == len(kept), at
        for number, value in enumerate(kept):
            assert_alike(found[number], value, f"{at}/{number}")
    elif isinstance(kept, float):
        assert found == pytest.approx(kept, abs=0.005), at
    else:
        assert found == kept, at


@pytest.mark.parametrize("sample", ["floor", "lab"])
def test_the_report_meets_its_schema(sample: str) -> None:
    jsonschema.validate(report(sample), report_schema())


def test_the_samples_stay_small_and_say_that_they_are_synthetic() -> None:
    assert sum(path.stat().st_size for path in SAMPLES.rglob("*") if path.is_file()) < 40e6
    for sample in ("floor", "lab"):
        assert json.loads((SAMPLES / sample / "truth.json").read_text(encoding="utf-8"))["synthetic"] is True


TOLD = {"advice", "axis_limit_from", "conclusion", "notes", "reason", "reasons", "text"}
NO_ENGLISH = {"GB", "CCES", "JGJ", "table", "mm", "scans", "bars", "tiff", "foot", "near"}
"""Standards and their tables, units, names of files."""


def sentences(value: Any, key: str = "") -> Iterator[str]:
    """Every sentence of a report that a person reads."""
    if isinstance(value, dict):
        for name, item in value.items():
            yield from sentences(item, name)
    elif isinstance(value, list):
        for item in value:
            yield from sentences(item, key)
    elif isinstance(value, str) and value and key in TOLD:
        yield value


@pytest.mark.parametrize("sample", ["floor", "lab"])
def test_every_sentence_is_told_wholly_in_chinese(sample: str) -> None:
    told = {text: in_both_languages(text).zh for text in sentences(report(sample))}
    assert len(told) > 3
    left = {zh for zh in told.values() if {*re.findall("[A-Za-z]{2,}", zh)} - NO_ENGLISH}
    assert left == set()
