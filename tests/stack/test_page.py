"""stack.html and the plan's other faces: what stands in them, in both languages, and what never does."""

import html
import json
import re
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.design.ifc.floor import read_floor
from aadm_workbench.model import StackSettings
from aadm_workbench.stack.document import stack_document
from aadm_workbench.stack.drawing import stack_drawings, top_in_plan
from aadm_workbench.stack.measured import measured_floor
from aadm_workbench.stack.page import stack_page, write_stack_page
from aadm_workbench.stack.plan import plan_stack
from aadm_workbench.stack.result import StackPlan
from aadm_workbench.stack.shown import tower_shown
from tests.report.browser import chromium
from tests.report.typed import typed
from tests.stack.demo import HOSTILE, demo_model, demo_report

PROFILE = load_profile("cn-gbt51231-2016")
OFF_GRID = re.compile(r"off (the )?grid|from the grid|偏离轴网")


@pytest.fixture(scope="module")
def report() -> dict[str, Any]:
    return demo_report()


@pytest.fixture(scope="module")
def plan(report: dict[str, Any], tmp_path_factory: pytest.TempPathFactory) -> StackPlan:
    floor = read_floor(demo_model(tmp_path_factory.mktemp("demo")))
    return plan_stack([measured_floor(typed(report))], StackSettings(), PROFILE, floor)


@pytest.fixture(scope="module")
def untied(report: dict[str, Any]) -> StackPlan:
    """The same without control points and without a model."""
    columns = [c | {"rebars": c["rebars"] and c["rebars"] | {"absolute": None}} for c in report["columns"]]
    return plan_stack([measured_floor(typed(report | {"columns": columns}))], StackSettings(height_mm=3000.0), PROFILE)


def test_the_document_has_its_keys(plan: StackPlan) -> None:
    document = stack_document(plan)
    json.dumps(document, allow_nan=False)
    assert document["schema"] == 1
    first = document["columns"][0]
    assert set(first) >= {"id", "set", "top", "play", "set_pose"}
    assert set(first["set"]) == {"dx_mm", "dy_mm", "dz_mm", "rx_deg", "ry_deg", "yaw_deg", "cov"}
    assert [len(row) for row in first["set"]["cov"]] == [6] * 6
    assert len(first["set_pose"]) == 3
    assert set(first["top"]) >= {"offset_mm", "u_mm", "limit", "clause", "verdict"}
    beam = document["members"][0]
    assert beam["ends"] == ["C-1", "C-2"]
    for judged in (beam["span_mm"], *beam["seat_mm"], beam["skew_deg"], beam["level_mm"]):
        assert set(judged) >= {"value", "u", "limit", "clause", "verdict"}
    assert {one["about"] for one in document["not_found"]} == {"KL5"}


def test_what_is_not_predicted_is_null(plan: StackPlan) -> None:
    columns = {column["id"]: column for column in stack_document(plan)["columns"]}
    for name in ("C-3", HOSTILE):
        assert columns[name]["set"] is columns[name]["top"] is columns[name]["set_pose"] is None
        assert columns[name]["reasons"]


def test_degrees_are_degrees(plan: StackPlan) -> None:
    first = stack_document(plan)["columns"][0]["set"]
    assert first["yaw_deg"] == pytest.approx(0.1, abs=1e-4)
    assert first["cov"][5][5] == pytest.approx((1.0 / 284.72 * 57.29578) ** 2, rel=0.05)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_never_off_grid_without_control_points(untied: StackPlan, language: Any) -> None:
    page = stack_page(untied, language)
    assert not OFF_GRID.search(page)
    assert "against their own bars" in page
    assert "只相对于本柱钢筋" in page
    assert "vs-pass" not in page
    assert all(column.advice is None for column in untied.columns)
    document = json.dumps(stack_document(untied))
    assert not OFF_GRID.search(document)
    assert {column["against"] for column in stack_document(untied)["columns"]} == {"bars"}


def test_without_a_model_beams_are_said_to_be_unknown(untied: StackPlan) -> None:
    assert "no IFC model was named" in stack_page(untied)


def test_names_are_escaped_and_nothing_runs(plan: StackPlan) -> None:
    page = stack_page(plan)
    assert HOSTILE not in page
    assert "<script" not in page
    assert "script-src" not in page
    assert "default-src 'none'" in html.unescape(page)


def test_the_same_plan_gives_the_same_page(plan: StackPlan) -> None:
    assert stack_page(plan, "zh") == stack_page(plan, "zh")


def test_drawings_hold_all_columns_and_their_beams(plan: StackPlan) -> None:
    (drawing,) = stack_drawings(plan)
    texts = [shape.text for shape in drawing.sketch.shapes if hasattr(shape, "text")]
    for name in ("C-1", "C-2", "C-3", "C-4", "C-5", "KL1", "KL2", "KL3", "KL4", "KL5"):
        assert any(name in text for text in texts), name
    longest = max(float((top**2).sum()) ** 0.5 for one in plan.columns if (top := top_in_plan(one)) is not None)
    assert 9.0 < longest < 9.5
    for shape in drawing.sketch.shapes:
        for x, y in getattr(shape, "points", ()):
            assert 0.0 <= x <= drawing.sketch.width
            assert 0.0 <= y <= drawing.sketch.height


def test_a_browser_shows_one_language_at_a_time(plan: StackPlan, tmp_path: Path) -> None:
    path = tmp_path / "stack.html"
    write_stack_page(plan, path)
    with chromium() as browser:
        page = browser.new_page()
        wrong: list[str] = []
        page.on("console", lambda message: wrong.append(message.text))
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.goto(path.as_uri())
        shown = page.inner_text("main")
        assert "set it" in shown.lower()
        assert "就位建议" not in shown
        assert "For the setting-out of the next storey" in shown
        page.click(".switch label.en")
        shown = page.inner_text("main")
        assert "就位建议" in shown
        assert "Set it" not in shown
        assert "供上一层放线使用" in shown
        assert wrong == []


def test_nothing_judged_is_no_good_news(untied: StackPlan) -> None:
    """Where nothing could be held against a limit, nobody is told that all keep theirs."""
    page = stack_page(untied)
    assert "could be held against its limit yet" in page
    assert "Nothing is beyond a limit" not in page
    assert "which says nothing of the grid" in page


def test_a_column_that_must_not_be_hoisted_is_not_sent_on_its_way(plan: StackPlan) -> None:
    """C-2 goes on its bars, but these stand beyond their limit: whoever reads its line alone must not lift it."""
    said = {one.names: one.said for one in tower_shown(plan).to_do if one.set_pose}
    assert set(said) == {"C-1", "C-2", "C-4"}
    assert "once the engineer has released it, set it" in said["C-2"].en
    assert "放行后" in said["C-2"].zh
    assert "released" not in said["C-1"].en + said["C-4"].en
