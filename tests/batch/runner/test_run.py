"""The runner: columns in the order of the job, each one's trouble its own, the same bytes for the same job."""

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.errors import DesignError, JobError, MissingDependencyError
from aadm_workbench.inspection import as_designed, column
from aadm_workbench.inspection.tasks import report_of
from aadm_workbench.model import ColumnReport, Verdict
from aadm_workbench.report.json import encoded_report
from aadm_workbench.report.read import parsed_report
from batch.job.file import read_job
from batch.runner.pools import PoolOptions
from batch.runner.record import Record
from batch.runner.run import Follower, JobRun, RunOptions, run_job
from batch.shown.verdict_table import verdict_table
from tests.batch.conftest import CENTRES, HEAD, WriteJob, column_text

MODEL_HEAD = HEAD + '[model]\npath = "models/floor3.ifc"\n'


def finished(path: Path, **options: Any) -> JobRun:
    """The run of a job that nobody watches."""
    processes = options.pop("processes", None)
    return run_job(read_job(path), RunOptions(**options, pool=PoolOptions(processes)))


def of_model(name: str, scan: str) -> str:
    """A column whose design is in the job's model."""
    return f'[[columns]]\nid = "{name}"\nsleeves = "{scan}"\nup = "-y"\n'


def raising(error: BaseException) -> Callable[..., ColumnReport]:
    """Stands in for the check of a column that ends in an error."""

    def check_column(*_: object) -> ColumnReport:
        raise error

    return check_column


@pytest.mark.usefixtures("exact_extraction")
def test_one_scan_for_two_columns_passes_neither(write_job: WriteJob) -> None:
    """By its bytes, whatever the copy is called; a column with scans of its own passes as ever."""
    path = write_job(
        column_text("C-1", "foot.ply", "bars.ply"),
        column_text("C-2", "foot-2.ply", "bars-2.ply"),
        column_text("C-3", "foot-3.ply"),
        clouds=("foot.ply", "foot-2.ply", "foot-3.ply", "bars.ply"),
    )
    (path.parent / "bars-2.ply").write_bytes((path.parent / "bars.ply").read_bytes())
    first, second, third = finished(path).report.columns
    assert [column.verdict for column in (first, second, third)] == ["inconclusive", "inconclusive", "pass"]
    assert (first.goes_on, second.goes_on) == ("inconclusive", "inconclusive")
    assert "is the same file as that of C-2" in first.reasons[0]
    assert [(finding.code, finding.about) for finding in second.findings] == [("same_scan_twice", ("rebars",))]
    content = encoded_report(finished(path).report)
    assert encoded_report(parsed_report(content, "report.json")) == content


@pytest.mark.usefixtures("exact_extraction")
def test_results_are_unpacked_twice_for_a_report(write_job: WriteJob, monkeypatch: pytest.MonkeyPatch) -> None:
    """Once for what all columns show together, once to write them; one more of a mould, and each for the table."""
    names = tuple(f"foot-{number}.ply" for number in range(4))
    path = write_job(*(column_text(name[5], name) for name in names), clouds=names)
    done = finished(path)
    unpacked = []
    monkeypatch.setattr(Record, "column", lambda record, own=Record.column: unpacked.append(record.id) or own(record))
    content = encoded_report(done.report)
    done.report.summary()
    assert sorted(unpacked) == sorted("0" + 2 * "0123")
    unpacked.clear()
    verdict_table(done.report)
    assert unpacked == list("0123")
    assert encoded_report(report_of(done.plan, tuple(done.columns))) == content


@pytest.mark.usefixtures("exact_extraction")
def test_what_is_kept_gives_the_report_of_what_never_was(write_job: WriteJob) -> None:
    """Numbers are kept as they are shown; moulds, which are judged by all of them, come out the same."""
    names = tuple(f"mould-{number}.ply" for number in range(4))
    columns = [column_text(f"C-{name[6]}", name, "4mm.ply") for name in names]
    done = finished(write_job(*columns, clouds=(*names, "4mm.ply")))
    assert done.report.mould_drift[0].drifting
    exact = [column.inspect_column(task).report for task in done.plan.tasks]
    assert encoded_report(report_of(done.plan, exact)) == encoded_report(done.report)


@pytest.mark.usefixtures("exact_extraction")
def test_verdicts_in_the_order_of_the_job(write_job: WriteJob) -> None:
    path = write_job(
        column_text("C-3", "foot-3.ply", "4mm.ply"),
        column_text("C-1", "foot.ply", "bars.ply"),
        column_text("C-2", "foot-2.ply"),
        clouds=("foot.ply", "foot-2.ply", "foot-3.ply", "bars.ply", "4mm.ply"),
    )
    report = finished(path).report
    assert [(column.id, column.verdict) for column in report.columns] == [
        ("C-3", Verdict.FAIL),
        ("C-1", Verdict.PASS),
        ("C-2", Verdict.PASS),
    ]
    assert [column.goes_on for column in report.columns] == [Verdict.PASS, Verdict.PASS, Verdict.NOT_ASSESSED]
    assert report.columns[0].reasons[0].startswith("R10 is 3.44 mm from design, limit 2 mm")
    assert report.columns[1].sleeves is not None
    assert report.columns[1].sleeves.source == "foot.ply"


@pytest.mark.usefixtures("exact_extraction")
def test_a_scan_that_is_missing_or_broken_costs_its_own_column(write_job: WriteJob) -> None:
    path = write_job(
        column_text("missing", "foot.ply", "nowhere.ply"),
        column_text("broken", "broken.ply"),
        column_text("metres", "metres.ply"),
        column_text("folder", "."),
        column_text("no scan"),
        column_text("good", "foot.ply", "bars.ply"),
        clouds=("foot.ply", "bars.ply"),
    )
    content = (path.parent / "foot.ply").read_bytes()
    (path.parent / "broken.ply").write_bytes(content[: len(content) // 2])
    rows = [f"{x / 1000} {y / 1000} 0\n" for x in range(-300, 300, 20) for y in range(-300, 300, 20)]
    (path.parent / "metres.ply").write_text(
        f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"end_header\n{''.join(rows)}"
    )
    report = finished(path).report
    verdicts = {column.id: column.verdict for column in report.columns}
    assert verdicts.pop("good") is Verdict.PASS
    assert verdicts.pop("no scan") is Verdict.NOT_MEASURED
    assert set(verdicts.values()) == {Verdict.ERROR}
    reasons = {column.id: column.reasons for column in report.columns}
    assert reasons["missing"][0].startswith("nowhere.ply: there is no such file")
    assert reasons["broken"][0].startswith("broken.ply: ")
    assert 'write units = "m" in the job' in reasons["metres"][0]
    assert reasons["no scan"] == ("the job names no scan of its sleeves or rebars",)
    assert report.summary() == {"pass": 1, "fail": 0, "inconclusive": 0, "not_measured": 1, "error": 4}


@pytest.mark.parametrize(
    ("error", "reason"),
    [
        (MemoryError(), "there is not enough memory"),
        (RuntimeError("OpenCV: (-4:Insufficient memory) Failed to allocate 9 bytes"), "there is not enough memory"),
        (OSError(5, "Input/output error"), "[Errno 5] Input/output error"),
        (JobError("the job asks for trial"), "the job asks for trial"),
        (ValueError("singular"), "internal error (ValueError: singular); --debug shows where"),
    ],
)
def test_any_error_of_a_column_is_its_verdict(
    write_job: WriteJob, monkeypatch: pytest.MonkeyPatch, error: Exception, reason: str
) -> None:
    monkeypatch.setattr(column, "check_column", raising(error))
    done = finished(write_job(column_text("C-1", "foot.ply"), column_text("C-2"), clouds=("foot.ply",)))
    first, second = done.report.columns
    assert (first.verdict, first.goes_on) == (Verdict.ERROR, Verdict.NOT_ASSESSED)
    assert reason in first.reasons[0]
    assert first.size_mm == (600.0, 600.0)
    assert second.verdict is Verdict.NOT_MEASURED
    assert ("raise error" in done.traces.get("C-1", "")) == isinstance(error, ValueError | RuntimeError)


def test_an_interrupt_is_no_verdict(write_job: WriteJob, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(column, "check_column", raising(KeyboardInterrupt()))
    path = write_job(column_text("C-1", "foot.ply"), clouds=("foot.ply",))
    with pytest.raises(KeyboardInterrupt):
        finished(path)


@pytest.mark.usefixtures("exact_extraction")
def test_the_same_job_gives_the_same_bytes_wherever_it_lies(
    write_job: WriteJob, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    columns = (column_text("C-1", "foot.ply", "4mm.ply"), column_text("C-2", "missing.ply"))
    path = write_job(*columns, clouds=("foot.ply", "4mm.ply"))
    first = encoded_report(finished(path).report)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    for name in ("job.toml", "foot.ply", "4mm.ply"):
        (elsewhere / name).write_bytes((tmp_path / name).read_bytes())
    monkeypatch.chdir(elsewhere)
    assert encoded_report(finished(Path("job.toml")).report) == first
    assert str(tmp_path).encode() not in first


@pytest.mark.usefixtures("exact_extraction")
def test_a_hoisting_frame_that_cannot_be_read_costs_itself_alone(write_job: WriteJob) -> None:
    path = write_job(column_text("C-1", "foot.ply", more='hoisting = "h.ply"\nup = "-y"\n'), clouds=("foot.ply",))
    (column,) = finished(path).report.columns
    assert column.verdict is Verdict.PASS
    (frame,) = column.hoisting
    assert frame.verdict is Verdict.ERROR
    assert "h.ply" in frame.reasons[0]


@pytest.mark.usefixtures("exact_extraction")
def test_only(write_job: WriteJob) -> None:
    path = write_job(*(column_text(name, "foot.ply") for name in ("C-1", "C-2", "C-3")), clouds=("foot.ply",))
    assert [column.id for column in finished(path, only=("C-3", "C-1")).report.columns] == ["C-1", "C-3"]
    with pytest.raises(JobError, match=r'has no column "C-33" \(--only\); did you mean "C-3"\?'):
        finished(path, only=("C-33",))


@pytest.mark.usefixtures("exact_extraction")
def test_columns_of_a_model(write_job: WriteJob, monkeypatch: pytest.MonkeyPatch) -> None:
    table = {"centres": CENTRES.tolist(), "sleeve_diameter": 36.0}
    design = replace(inline_design("C-301", table), names=("C-301",), global_id="0" * 22)
    other = replace(inline_design("PCZ-1", table), names=("PCZ-1",), global_id="1" * 22)
    asked: list[dict[str, object]] = []

    def read_design(path: Path, **selectors: object) -> ModelDesign:
        asked.append({"path": path, **selectors})
        return ModelDesign(str(path), "f" * 64, "IFC4", columns=(design, other))

    monkeypatch.setattr(as_designed, "read_design", read_design)
    head = MODEL_HEAD + 'columns = "IfcColumn"\n'
    bars = of_model("PCZ-1", "foot.ply").replace("sleeves", "rebars")
    path = write_job(
        of_model("C-301", "foot.ply"), of_model("C-302", "foot.ply"), bars, clouds=("foot.ply",), head=head
    )
    report = finished(path).report
    assert asked == [
        {
            "path": path.parent / "models/floor3.ifc",
            "columns": "IfcColumn",
            "sleeves": None,
            "rebars": None,
            "units": "mm",
            "only": ["C-301", "C-302", "PCZ-1"],
        }
    ]
    assert report.model == {"source": "models/floor3.ifc", "sha256": "f" * 64}
    first, second, third = report.columns
    assert (first.id, first.verdict, first.global_id) == ("C-301", Verdict.PASS, "0" * 22)
    assert (second.verdict, second.reasons[0]) == (
        Verdict.ERROR,
        "models/floor3.ifc has no column called 'C-302'. Near to it: C-301.",
    )
    assert third.reasons == ("the design has no rebars, but the job names a scan of them (foot.ply)",)


def test_a_model_that_cannot_be_read_stops_the_job(write_job: WriteJob) -> None:
    path = write_job(of_model("C-301", "foot.ply"), head=MODEL_HEAD)
    with pytest.raises(DesignError, match=r"floor3\.ifc"):
        finished(path)


@pytest.mark.usefixtures("exact_extraction")
def test_times_and_progress(write_job: WriteJob) -> None:
    path = write_job(column_text("C-1", "foot.ply", "bars.ply"), column_text("C-2"), clouds=("foot.ply", "bars.ply"))
    seen: list[object] = []

    class Seen(Follower):
        def started(self, total: int) -> None:
            seen.append(total)

        def column(self, record: Record, kept: bool) -> None:
            seen.append((record.id, kept))

    seconds = run_job(read_job(path), RunOptions(), Seen()).seconds
    assert seen == [2, ("C-1", False), ("C-2", False)]
    assert isinstance(seconds["columns"], dict)
    assert list(seconds["columns"]["C-1"]) == ["read", "extract", "assembly", "total"]
    assert list(seconds["columns"]["C-2"]) == ["total"]
    assert isinstance(seconds["total"], float)


def test_processes_come_to_the_same_report(write_job: WriteJob) -> None:
    pytest.importorskip("distributed")
    path = write_job(column_text("C-1", "missing.ply"), column_text("C-2"), column_text("C-3", "foot.ply"))
    (path.parent / "foot.ply").write_text("ply\n")
    alone = finished(path)
    spread = finished(path, processes=2)
    assert encoded_report(spread.report) == encoded_report(alone.report)
    assert [column.verdict.value for column in spread.report.columns] == ["error", "not_measured", "error"]
    seconds = spread.seconds["columns"]
    assert isinstance(seconds, dict)
    assert list(seconds) == ["C-1", "C-2", "C-3"]


def test_several_processes_without_psutil(write_job: WriteJob, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "psutil", None)
    path = write_job(column_text("C-1"), column_text("C-2"))
    with pytest.raises(MissingDependencyError, match=r"pip install 'aadm-workbench\[batch\]'"):
        finished(path, processes=2)
    assert len(finished(path, processes=2, only=("C-1",)).report.columns) == 1
