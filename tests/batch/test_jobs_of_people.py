"""Jobs as people write them: paths of Windows, one column by two names, models that are broken."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.errors import DesignError, JobError
from aadm_workbench.inspection import as_designed
from aadm_workbench.model import Verdict
from batch.job.file import read_job
from batch.main import main
from batch.runner import run
from tests.design.step_yard import Step, Yard, yard

from .conftest import CENTRES, DESIGN, HEAD, WriteJob, column_text
from .runner.test_run import finished, of_model

MODEL_HEAD = HEAD + '[model]\npath = "model.ifc"\n'


@pytest.mark.parametrize(
    "written",
    [
        r'"..\base\foot.ply"',
        r'"..\scans\foot.ply"',
        r'"C:\Users\li\foot.ply"',
        r'"\\server\x.ply"',
        r'"scans\tall.ply"',
    ],
)
def test_paths_of_windows_in_double_quotes_are_told_from_escapes(written: str, tmp_path: Path) -> None:
    path = tmp_path / "job.toml"
    path.write_text(f'{HEAD}[[columns]]\nid = "C-1"\nsleeves = {written}\n{DESIGN}', encoding="utf-8")
    with pytest.raises(JobError, match=r"line 6: .*write paths of Windows with / or in single quotes"):
        read_job(path)


def test_other_faults_of_toml_say_nothing_of_windows(tmp_path: Path) -> None:
    path = tmp_path / "job.toml"
    path.write_text(f"{HEAD}[[columns]]\nid = \n", encoding="utf-8")
    with pytest.raises(JobError) as caught:
        read_job(path)
    assert "Windows" not in str(caught.value)


def test_paths_of_windows_in_single_quotes_are_read(write_job: WriteJob) -> None:
    path = write_job(
        MODEL_HEAD.replace('"model.ifc"', r"'..\models\a.ifc'")
        + of_model("C-1", "x").replace('"x"', r"'..\scans\a.ply'"),
        head="",
    )
    job = read_job(path)
    assert job.columns[0].sleeves == ("../scans/a.ply",)
    assert job.model is not None
    assert job.model.path == "../models/a.ifc"


def test_a_file_that_is_called_so_is_meant(write_job: WriteJob) -> None:
    path = write_job(column_text("C-1").replace("up =", "sleeves = 'a\\b.ply'\nup ="))
    (path.parent / "a\\b.ply").write_bytes(b"ply")
    assert read_job(path).columns[0].sleeves == ("a\\b.ply",)


@pytest.mark.parametrize("names", [("C-1", "0000000000000000000018"), ("C-1", "Precast column"), ("c-1", "Ｃ－１")])
def test_one_column_by_two_names_is_refused(names: tuple[str, str], write_job: WriteJob) -> None:
    path = write_job(*(of_model(name, "foot.ply") for name in names), clouds=("foot.ply",), head=MODEL_HEAD)
    text = yard()
    column = next(line for line in text.splitlines() if "IFCCOLUMN" in line)
    own_id = column.partition("('")[2].partition("'")[0]
    (path.parent / "model.ifc").write_text(text.replace(own_id, "0000000000000000000018"))
    with pytest.raises(
        JobError, match=rf'line 11: "{names[1]}" and "{names[0]}" \(line 7\) are one column of model.ifc'
    ):
        finished(path)
    assert main(["check", str(path), "--quiet"]) == 2


def broken_bar(step: Step, at: str) -> None:
    line = step.add(f"IFCPOLYLINE(({step.point(1.0, 1.0, 1.0)},{step.point(1.0, 1.0, 1.0)}))")
    step.bar(step.add(f"IFCSWEPTDISKSOLID({line},10.,$,$,$)"), step.placement("$", 9000.0), "stray")


@pytest.mark.usefixtures("exact_extraction")
def test_a_broken_element_costs_no_column_and_is_told(write_job: WriteJob) -> None:
    path = write_job(
        of_model("C-1", "foot.ply"),
        column_text("C-2", "foot-2.ply"),
        clouds=("foot.ply", "foot-2.ply"),
        head=MODEL_HEAD,
    )
    (path.parent / "model.ifc").write_text(yard(Yard(more=broken_bar)))
    told: list[str] = []

    class Listener(run.Follower):
        def message(self, text: str) -> None:
            told.append(text)

    done = run.run_job(read_job(path), run.RunOptions(), Listener())
    assert [column.id for column in done.report.columns] == ["C-1", "C-2"]
    assert done.report.columns[1].verdict is Verdict.PASS
    assert any("its geometry was left out" in text and text.startswith("model.ifc: ") for text in told)


@pytest.mark.usefixtures("exact_extraction")
@pytest.mark.parametrize("content", ["", "no model at all", yard()[:2000], yard().replace("IFC4", "IFC9")])
def test_a_model_that_cannot_be_read_costs_only_the_columns_that_need_it(content: str, write_job: WriteJob) -> None:
    path = write_job(
        of_model("C-1", "foot.ply"),
        column_text("C-2", "foot-2.ply"),
        clouds=("foot.ply", "foot-2.ply"),
        head=MODEL_HEAD,
    )
    (path.parent / "model.ifc").write_text(content)
    first, second = finished(path).report.columns
    assert first.verdict is Verdict.ERROR
    assert "model.ifc" in first.reasons[0]
    assert second.verdict is Verdict.PASS
    assert main(["check", str(path), "--quiet"]) == 12


def test_what_nobody_foresaw_in_a_model_is_a_bad_model(
    write_job: WriteJob, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def read_design(*_: Any, **__: Any) -> Callable[[], None]:
        raise KeyError("unforeseen")

    monkeypatch.setattr(as_designed, "read_design", read_design)
    path = write_job(of_model("C-1", "foot.ply"), head=MODEL_HEAD)
    with pytest.raises(DesignError, match=r"model\.ifc cannot be evaluated.*KeyError"):
        finished(path)
    assert main(["check", str(path), "--debug"]) == 2
    assert "Traceback" in capsys.readouterr().err


@pytest.mark.usefixtures("exact_extraction")
def test_a_global_id_of_two_elements_is_a_finding(write_job: WriteJob, monkeypatch: pytest.MonkeyPatch) -> None:
    design = inline_design("C-1", {"centres": CENTRES.tolist(), "sleeve_diameter": 36.0})
    design = replace(design, names=("C-1",), global_id="0" * 22, shared_ids=("column", "S2"))
    model = ModelDesign("model.ifc", "f" * 64, "IFC4", columns=(design,))
    monkeypatch.setattr(as_designed, "read_design", lambda *_, **__: model)
    path = write_job(of_model("C-1", "foot.ply"), clouds=("foot.ply",), head=MODEL_HEAD)
    (column,) = finished(path).report.columns
    (found,) = (finding for finding in column.findings if finding.code == "duplicate_global_id")
    assert found.about == ("column", "S2")
    assert column.verdict is Verdict.PASS
    assert found.text in column.notes
