"""``aadm stack``: from report.json and a model to tables, JSON, a page and an exit code."""

import csv
import hashlib
import json
import re
from pathlib import Path
from typing import Any

import openpyxl
import pypdfium2
import pytest

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.errors import JobError
from aadm_workbench.inspection.measure import CheckSettings
from aadm_workbench.inspection.tasks import JobPlan, job_entry
from aadm_workbench.report.ifc.model import ids_path
from aadm_workbench.stack.plan import plan_stack
from batch.job.file import read_job
from batch.job.stack import carried_settings
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
    for text in ("KL1", "C-1 – C-2", "its own bars", "set it", "does not go on the bars", "2500 mm away"):
        assert text in shown


def test_tables_in_chinese(folder: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    """No English word is left but names, file names, keys and clauses."""
    _, shown = run(folder, capfdbinary, "--model", str(folder / "demo.ifc"), "--language", "zh")
    for text in ("柱顶", "搁置长度变化", "本柱钢筋", "就位时从预拼装位置", "不能就位到钢筋上", "未测得", "C-3："):
        assert text in shown
    kept = r"level_u_mm|\[stack\]|<script>alert\(1\)</script>|GB/T|table|mm|KL\d|C-\d|dx|dy|\bu\b"
    assert re.findall(r"[A-Za-z]{2,}|[:,] ?[一-鿿]|[一-鿿] ?[:,]", re.sub(kept, "", shown)) == []


def test_the_report_of_a_job_with_stack_shows_the_tower(folder: Path, tmp_path: Path) -> None:
    """Where the job asks for it, and there alone; the same plan that the page of the tower shows."""
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    with_stack = report | {"job": report["job"] | {"stack": "braced = true\n"}}
    (tmp_path / "report.json").write_text(json.dumps(with_stack), encoding="utf-8")
    words = ("--html", "--model", str(folder / "demo.ifc"), "--quiet")
    assert main(["report", str(tmp_path / "report.json"), *words]) == 0
    assert main(["report", str(folder / "report.json"), *words, "--out", str(tmp_path / "without")]) == 0
    assert main(["stack", str(tmp_path / "report.json"), *words]) == 11
    shown = (tmp_path / "report.html").read_text(encoding="utf-8")
    own = (tmp_path / "stack.html").read_text(encoding="utf-8")
    drawn = re.findall(r"<svg.*?</svg>", own)
    assert len(drawn) == 1
    assert drawn[0] in shown
    for text in ("set_pose = [-2.76, -0.42, 0.000]", "For the setting-out of the next storey", "2500 mm away"):
        assert text in shown
        assert text in own
    assert main(["report", str(tmp_path / "report.json"), "--pdf", *words[1:], "--language", "zh"]) == 0
    document = pypdfium2.PdfDocument(str(tmp_path / "report.pdf"))
    paper = "".join(page.get_textpage().get_text_range() for page in document)
    for text in ("怎么做", "set_pose = [-2.76, -0.42, 0.000]", "供上一层放线使用", "按就位建议"):
        assert text in paper
    without = (tmp_path / "without" / "report.html").read_text(encoding="utf-8")
    assert "setting-out" not in without
    assert drawn[0] not in without


def test_workbook_and_table_hold_the_tower(folder: Path, tmp_path: Path) -> None:
    """What ``aadm stack --json`` says of the next storey's bars stands in both, as numbers."""
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    report["job"]["stack"] = "braced = true\n"
    (tmp_path / "report.json").write_text(json.dumps(report), encoding="utf-8")
    words = (str(tmp_path / "report.json"), "--xlsx", "--csv", "--model", str(folder / "demo.ifc"), "--quiet")
    assert main(["report", *words]) == 0
    book = openpyxl.load_workbook(tmp_path / "report.xlsx")
    assert "set_pose = [-2.76, -0.42, 0.000]" in [cell.value for cell in book["Tower"]["D"]]
    sheet = [[cell.value for cell in row] for row in book["Setting out"].rows]
    with (tmp_path / "setting-out.csv").open(encoding="utf-8-sig", newline="") as stream:
        lines = list(csv.DictReader(stream))
    assert len(lines) == len(sheet) - 1 >= 2
    for line, row in zip(lines, sheet[1:], strict=True):
        numbers = [float(line[name]) for name in ("dx_mm", "dy_mm", "height_mm", "turn_deg", "u_mm")]
        assert [row[0], row[2]] == [line["column"], line["set_as"]]
        assert row[3:8] == pytest.approx(numbers)
    assert main(["report", str(folder / "report.json"), *words[1:], "--out", str(tmp_path / "without")]) == 0
    assert "Tower" not in openpyxl.load_workbook(tmp_path / "without" / "report.xlsx").sheetnames
    assert not (tmp_path / "without" / "setting-out.csv").exists()


def test_a_tower_is_planned_once_for_all_that_tells_of_it(
    folder: Path, repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plans = []

    def counted(*given: Any) -> Any:
        plans.append(plan_stack(*given))
        return plans[-1]

    monkeypatch.setattr("aadm_workbench.stack.plan.plan_stack", counted)
    lab = repository / "samples" / "lab"
    text = (lab / "job.toml").read_text("utf-8").replace('"scans/', f'"{(lab / "scans").as_posix()}/')
    job = tmp_path / "job.toml"
    job.write_text(f"{text}\n[stack]\nheight_mm = 3000.0\n", "utf-8")
    words = ("--html", "--csv", "--xlsx", "--quiet", "--out", str(tmp_path))
    assert main(["check", str(job), "--only", "L-1", *words]) == 0
    assert len(plans) == 1
    report = json.loads((tmp_path / "report.json").read_text("utf-8"))
    assert report["columns"][0]["setting"]
    assert '<section id="tower"' in (tmp_path / "report.html").read_text("utf-8")
    # What nothing has changed of is told from report.json, again once.
    assert main(["check", str(job), "--only", "L-1", "--resume", *words]) == 0
    assert len(plans) == 2
    assert main(["report", str(tmp_path / "report.json"), *words]) == 0
    assert len(plans) == 3


def test_a_model_that_cannot_be_read_costs_the_beams_alone(folder: Path, tmp_path: Path) -> None:
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    report["job"]["stack"] = "height_mm = 3000.0\n"
    (tmp_path / "report.json").write_text(json.dumps(report), encoding="utf-8")
    (tmp_path / "broken.ifc").write_text("ISO-10303-21;")
    assert main(["report", str(tmp_path / "report.json"), "--model", str(tmp_path / "broken.ifc"), "--quiet"]) == 0
    shown = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "broken.ifc" in shown
    assert "set it 2.8 mm towards the left" in shown


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
    assert carried_settings(job_entry(JobPlan(read_job(job), None, CheckSettings(load_profile("cn")), ()))) == settings
    assert carried_settings({}) is None
    with pytest.raises(JobError, match=r"job\.stack"):
        carried_settings({"stack": "fit_u_mm = ["})


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("[1.0, 2.0]", "3 numbers"),
        ('"x"', "3 numbers"),
        ("[0, 0, nan]", "a number"),
        ("[0.0, 200.0, 0.0]", "within ±20"),
    ],
)
def test_a_wrong_set_pose_names_its_line(tmp_path: Path, line: str, said: str) -> None:
    job = tmp_path / "job.toml"
    text = 'schema = 1\n[model]\npath = "a.ifc"\n[[columns]]\nid = "A"\nsleeves = "a.ply"\nset_pose = '
    job.write_text(f"{text}{line}\n", encoding="utf-8")
    with pytest.raises(JobError, match=f"line 7.*{said}"):
        read_job(job)


def test_set_pose_of_a_job(tmp_path: Path) -> None:
    job = tmp_path / "job.toml"
    text = 'schema = 1\n[model]\npath = "a.ifc"\n[[columns]]\nid = "A"\nsleeves = "a.ply"\n'
    job.write_text(f"{text}set_pose = [1, -0.4, 0.05]\n", encoding="utf-8")
    assert read_job(job).columns[0].set_pose == (1.0, -0.4, 0.05)
    job.write_text(text, encoding="utf-8")
    assert read_job(job).columns[0].set_pose is None


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


def test_into_the_model_and_out_again(tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    """AADM_Setting on columns and beams, read by ifcopenshell; written twice the same, taken out byte for byte."""
    ifcopenshell = pytest.importorskip("ifcopenshell")
    from ifcopenshell.util.element import get_psets

    model = demo_model(tmp_path)
    report = demo_report()
    file = ifcopenshell.open(str(model))
    ids = {column.Name: column.GlobalId for column in file.by_type("IfcColumn")}
    report["model"] = {"source": "demo.ifc", "sha256": hashlib.sha256(model.read_bytes()).hexdigest()}
    for column in report["columns"]:
        column["global_id"] = ids[column["id"]]
    (tmp_path / "report.json").write_text(json.dumps(report), encoding="utf-8")
    words = ("--model", str(model), "--write-ifc", str(tmp_path / "set.ifc"), "--quiet")
    run(tmp_path, capfdbinary, *words)
    first = (tmp_path / "set.ifc").read_bytes()
    run(tmp_path, capfdbinary, *words)
    assert (tmp_path / "set.ifc").read_bytes() == first
    written = ifcopenshell.open(str(tmp_path / "set.ifc"))
    columns = {one.Name: get_psets(one)["AADM_Setting"] for one in written.by_type("IfcColumn")}
    assert columns["C-1"]["SetX"] == pytest.approx(6.5, abs=0.01)
    assert columns["C-1"]["TopVerdict"] == "inconclusive"
    assert columns["C-1"]["Against"] == "control_points"
    assert "SetX" not in columns["C-3"]
    assert "does not go on" in columns["C-3"]["Reasons"]
    assert columns["C-5"]["Against"] == "bars"
    assert "TopLimit" not in columns["C-5"]
    beams = {one.Name: get_psets(one)["AADM_Setting"] for one in written.by_type("IfcBeam")}
    assert beams["KL1"]["Span"] == pytest.approx(-8.5, abs=0.05)
    assert beams["KL1"]["SpanLimit"] == 10.0
    assert unfulfilled(tmp_path / "set.ifc") == set()
    text = (tmp_path / "set.ifc").read_text()
    for of, name, old, new in (
        ("says against what", "Against", "IFCLABEL('control_points')", "IFCLABEL('guess')"),
        ("where, with an uncertainty", "TopUncertainty", "", None),
        ("held to no limit", "Against", "IFCLABEL('control_points')", "IFCLABEL('bars')"),
        ("says on which, and its verdict", "SpanUncertainty", "IFCLENGTHMEASURE", "IFCREAL"),
        ("is no pass says why", "Reasons", "level_u_mm", None),
    ):
        spoilt = spoil(text, name, old, new)
        assert spoilt != text
        (tmp_path / "spoilt.ifc").write_text(spoilt)
        assert unfulfilled(tmp_path / "spoilt.ifc", of), (of, name)
    assert main(["writeback", str(tmp_path / "set.ifc"), "--remove", "--out", str(tmp_path / "back.ifc")]) == 0
    assert (tmp_path / "back.ifc").read_bytes() == model.read_bytes()


def spoil(text: str, name: str, old: str, new: str | None) -> str:
    """A model's text with one value of one property set of the tower changed; renamed where ``new`` is None."""
    lines = text.split("\n")
    own = set(re.findall(r"#\d+", " ".join(re.findall(r"'AADM_Setting',\$,\(([^)]*)\)", text))))
    for k, line in enumerate(lines):
        if line.split("=")[0].strip() in own and f"'{name}'" in line and old in line:
            lines[k] = line.replace(f"'{name}'", "'Other'") if new is None else line.replace(old, new)
            return "\n".join(lines)
    raise AssertionError(f"no {name} with {old}")


def unfulfilled(path: Path, named: str = "") -> set[str]:
    """Which specifications of the IDS of results, of those that are named so, a model does not fulfil, by ifctester."""
    import ifcopenshell

    ids = pytest.importorskip("ifctester.ids")
    checks = ids.open(str(ids_path()))
    checks.specifications = [one for one in checks.specifications if named in one.name]
    assert checks.specifications
    checks.validate(ifcopenshell.open(str(path)))
    return {check.name for check in checks.specifications if not check.status}


def test_a_model_is_written_for_one_report_alone(folder: Path, tmp_path: Path) -> None:
    report = str(folder / "report.json")
    assert main(["stack", report, "--write-ifc", str(tmp_path / "a.ifc")]) == 2
    assert main(["stack", report, report, "--model", str(folder / "demo.ifc"), "--write-ifc", "a.ifc"]) == 2


def test_diff_tells_what_comes_to_stand_elsewhere(tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    for name, dx in (("a", 1.0), ("b", 5.0)):
        report = report_of(Standing("C-1", ground=(dx, 0.0, 0.0)))
        (tmp_path / f"{name}.json").write_text(json.dumps(report), encoding="utf-8")
    paths = [str(tmp_path / "a.json"), str(tmp_path / "b.json")]
    assert main(["diff", *paths, "--json"]) in (10, 11)
    (change,) = json.loads(capfdbinary.readouterr().out)["set"]
    assert change["moved_mm"] == pytest.approx(4.0, abs=0.05)
    assert main(["diff", *paths]) in (10, 11)
    assert "4.00 mm" in capfdbinary.readouterr().out.decode()
    assert main(["diff", paths[0], paths[0]]) == 0
