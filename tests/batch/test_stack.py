"""``aadm stack``: from report.json and a model to tables, JSON, a page and an exit code."""

import json
from pathlib import Path
from typing import Any

import pytest

from batch.job.file import read_job
from batch.job.stack import carried_settings, carried_text
from batch.main import main
from tests.stack.demo import demo_model, demo_report
from tests.stack.floors import FloorAuthor
from tests.stack.standing import Standing, report_of


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("stack")
    (folder / "report.json").write_text(json.dumps(demo_report()), encoding="utf-8")
    demo_model(folder)
    return folder


def run(folder: Path, capfdbinary: pytest.CaptureFixture[bytes], *words: str) -> tuple[int, Any]:
    code = main(["stack", str(folder / "report.json"), *words])
    out = capfdbinary.readouterr().out
    return code, json.loads(out) if "--json" in words else out.decode()


def test_tables_say_what_there_is(folder: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    code, shown = run(folder, capfdbinary, "--model", str(folder / "demo.ifc"))
    assert code == 11
    for text in ("KL1", "C-1 – C-2", "its own bars", "set it", "does not go on its bars", "2500 mm away"):
        assert text in shown


def test_json_and_page(folder: Path, tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    words = ("--model", str(folder / "demo.ifc"), "--html", "--out", str(tmp_path / "new"), "--language", "zh")
    _, document = run(folder, capfdbinary, *words, "--json")
    assert document["members"][0]["span_mm"]["value"] == pytest.approx(-8.5, abs=0.05)
    assert '<html lang="zh">' in (tmp_path / "new" / "stack.html").read_text(encoding="utf-8")


def test_settings_of_a_job(folder: Path, tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    job = tmp_path / "job.toml"
    text = 'schema = 1\n[model]\npath = "a.ifc"\n[stack]\nplumb_u_mm = 0.5\nheight_mm = 4000\n[[columns]]\nid = "A"\n'
    job.write_text(text + 'sleeves = "a.ply"\n', encoding="utf-8")
    _, document = run(folder, capfdbinary, "--json", "--job", str(job))
    first = document["columns"][0]
    assert first["height_mm"] == 4000.0
    assert first["top"]["u_mm"] == pytest.approx((0.5**2 + 1.0**2) ** 0.5, abs=0.05)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("plumb_u = 1", 'unknown key "plumb_u"'),
        ("plumb_u_mm = 0", "above zero"),
        ("level_u_mm = true", "must be a number"),
        ('braced = "yes"', "true or false"),
        ("height_mm = -3", "above zero"),
    ],
)
def test_a_wrong_table_names_its_line(
    tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes], line: str, said: str
) -> None:
    job = tmp_path / "job.toml"
    job.write_text(f'schema = 1\n[model]\npath = "a.ifc"\n[stack]\n{line}\n[[columns]]\nid = "A"\n', encoding="utf-8")
    assert main(["stack", "report.json", "--job", str(job)]) == 2
    assert main(["check", str(job)]) == 2
    error = capfdbinary.readouterr().err.decode()
    assert said in error
    assert "line 5" in error


def test_settings_go_through_a_report_unchanged(tmp_path: Path) -> None:
    job = tmp_path / "job.toml"
    text = 'schema = 1\n[model]\npath = "a.ifc"\n[stack]\nfit_u_mm = 0.25\nbraced = false\n[[columns]]\nid = "A"\n'
    job.write_text(text + 'sleeves = "a.ply"\n', encoding="utf-8")
    settings = read_job(job).stack
    assert settings.fit_u_mm == 0.25
    assert not settings.braced
    assert carried_settings({"stack": carried_text(settings)}) == settings
    assert carried_settings({}) is None


def test_two_storeys(tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    low = report_of(Standing("C-201", (0.0, 0.0, 0.0), ground=(3.0, 0.0, 0.0), storey="2F"), name="Floor 2")
    high = report_of(Standing("C-301", (0.0, 0.0, 3600.0), control_u_mm=None), name="Floor 3")
    for name, report in (("low", low), ("report", high)):
        (tmp_path / f"{name}.json").write_text(json.dumps(report), encoding="utf-8")
    _, alone = run(tmp_path, capfdbinary, "--json")
    assert alone["columns"][0]["against"] == "bars"
    _, both = run(tmp_path, capfdbinary, str(tmp_path / "low.json"), "--json")
    above = {column["id"]: column for column in both["columns"]}["C-301"]
    assert (above["against"], above["through"]) == ("storey_below", "C-201")
    assert above["set"]["dx_mm"] == pytest.approx(3.0, abs=0.05)


def test_a_repeated_check_counts_last(tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    for name, dx in (("report", 5.0), ("later", 1.0)):
        report = report_of(Standing("C-1", ground=(dx, 0.0, 0.0)))
        (tmp_path / f"{name}.json").write_text(json.dumps(report), encoding="utf-8")
    _, document = run(tmp_path, capfdbinary, str(tmp_path / "later.json"), "--json")
    (column,) = document["columns"]
    assert column["set"]["dx_mm"] == pytest.approx(1.0, abs=0.05)


def test_a_model_without_beams_and_one_of_other_columns(
    folder: Path, tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    author = FloorAuthor(tmp_path)
    author.standing("X-1", (0.0, 0.0, 0.0))
    _, document = run(folder, capfdbinary, "--json", "--model", str(author.write()))
    told = {one["about"]: one["reason"] for one in document["not_found"]}
    assert "not among the columns of the model" in told["C-1"]
    assert any("no beams" in reason for reason in told.values())


def test_what_is_no_model_is_an_error(folder: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    assert main(["stack", str(folder / "report.json"), "--model", str(folder / "report.json")]) == 2
    assert "report.json" in capfdbinary.readouterr().err.decode()
    assert main(["stack", str(folder / "demo.ifc")]) == 2
    assert main(["stack", str(folder / "none.json")]) == 2
    assert main(["stack", str(folder / "report.json"), "--tolerances", "moon"]) == 2
