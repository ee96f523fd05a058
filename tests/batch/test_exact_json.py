"""What is kept comes back bit by bit, whatever a report may hold."""

import typing
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aadm_workbench.model import Array, ColumnReport, JobReport, Verdict
from batch.job.file import read_job
from batch.runner.exact_json import from_exact_json, to_exact_json
from batch.runner.run import RunOptions, run_job

SAMPLES = Path(__file__).resolve().parents[2] / "samples"


@dataclass(frozen=True, eq=False)
class Inner:
    """Some of everything."""

    pair: tuple[float, float]
    verdict: Verdict
    matrix: Array | None
    words: tuple[str, ...]
    any: dict[str, Any]


@dataclass(frozen=True, eq=False)
class Outer:
    """Nested."""

    inner: tuple[Inner, ...]
    number: float | None = None


def test_every_bit_comes_back() -> None:
    rng = np.random.default_rng(3)
    values = rng.standard_normal(200) * 10.0 ** rng.integers(-300, 300, 200)
    inner = Inner(
        (float(values[0]), float("nan")),
        Verdict.NOT_MEASURED,
        values[:16].reshape(4, 4),
        ("层 3", 'a "quoted"\nline', "\ud800"),
        {"u": np.float64(0.1), "list": [1, 2.5, None], "nothing": None, "n": np.int64(3), "flag": np.bool_(True)},
    )
    back = from_exact_json(Outer, to_exact_json(Outer((inner,), float("-inf"))))
    assert back.number == float("-inf")
    (found,) = back.inner
    assert found.pair[0] == values[0]
    assert np.isnan(found.pair[1])
    assert found.verdict is Verdict.NOT_MEASURED
    assert found.matrix is not None
    assert found.matrix.tobytes() == inner.matrix.tobytes() if inner.matrix is not None else False
    assert found.words == inner.words
    assert found.any == {"u": 0.1, "list": [1, 2.5, None], "nothing": None, "n": 3, "flag": True}


@pytest.mark.parametrize(
    "text", ["{}", "[]", "3", '{"number": 1, "more": 2}', '{"inner": 3, "number": 1}', '{"inner": [{}]}']
)
def test_another_versions_text_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"Outer|Inner"):
        from_exact_json(Outer, text)


def test_what_cannot_be_kept_is_said() -> None:
    with pytest.raises(TypeError, match="complex cannot be kept"):
        to_exact_json({"a": 1j})


def test_every_noun_of_a_report_can_be_kept() -> None:
    """A new field of a report must have a type that comes back; this fails before a night's journal does."""
    seen: set[type] = set()

    def visit(kind: Any) -> None:
        if is_dataclass(kind) and isinstance(kind, type) and kind not in seen:
            seen.add(kind)
            # An empty dictionary is no such noun, which is found out after its decoder was made.
            with pytest.raises(ValueError, match=kind.__name__):
                from_exact_json(kind, "{}")
            for hint in typing.get_type_hints(kind).values():
                visit(hint)
        for argument in typing.get_args(kind):
            visit(argument)

    visit(ColumnReport)
    assert len(seen) > 10


def test_the_sample_comes_back_equal() -> None:
    job = read_job(SAMPLES / "lab" / "job.toml")
    report: JobReport = run_job(job, RunOptions()).report
    for column in report.columns:
        text = to_exact_json(column)
        again = from_exact_json(ColumnReport, text)
        assert to_exact_json(again) == text
        assert [item.name for item in fields(again)] == [item.name for item in fields(column)]
