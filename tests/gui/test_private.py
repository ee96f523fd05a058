"""What the scripted session found of the private environment: FreeCAD is not touched, and the model neither."""

import json
from pathlib import Path
from typing import Any

import pytest

from batch.main import main
from tests.conftest import ROOT

pytestmark = pytest.mark.freecad

FLOOR = [f"C-30{number}" for number in range(1, 9)]


def test_freecads_interpreter_gets_nothing(session: dict[str, Any]) -> None:
    (packages, path), (packages_after, path_after) = session["own_packages"]
    assert packages_after == packages
    assert packages["numpy"], "numpy is FreeCAD's own"
    assert path_after == path
    assert not [entry for entry in path_after if "environments" in entry]


def test_columns_of_an_ifc_file_need_no_importer(session: dict[str, Any]) -> None:
    assert session["ifc_columns"] == FLOOR
    assert session["ifc_undo"] == ["Sample design"]


def test_panel_and_command_give_the_same_report(session: dict[str, Any], tmp_path: Path) -> None:
    assert session["said_by_sleeves"] == session["said_by_rebars"] == session["said_by_ifc_check"] == []
    main(["check", str(ROOT / "samples/floor/job.toml"), "--only", "C-302", "--out", str(tmp_path), "--quiet"])
    command = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    panel = session["panel_report"]
    # The command calls the scans as its job does, with their folder.
    shown = json.loads(json.dumps(command["columns"]).replace("scans/C-302", "C-302"))
    assert panel["columns"] == shown
    for key in ("schema", "tool", "model", "profile"):
        assert panel[key] == command[key], key
    same = {key: value for key, value in command["job"].items() if key not in {"name", "sha256"}}
    assert same.items() <= panel["job"].items()


def test_click_on_a_row_shows_what_the_row_is_about(session: dict[str, Any]) -> None:
    assert session["shown_by_choice"] == "minimax"
    assert session["shown_by_row"] == ["position", "position", "position"]


def test_results_are_written_beside_the_model(session: dict[str, Any]) -> None:
    assert session["ifc_is_known"].endswith("model/floor3.ifc")
    assert session["said_by_write_beside"] == []
    assert session["model_is_as_it_was"]
    assert session["written_beside"] == ["floor3-checked.ifc", "floor3-report", "floor3.ifc"]


def test_model_that_has_changed_since_the_check_is_refused(session: dict[str, Any]) -> None:
    assert "changed since" in session["said_for_changed_model"][0]
    assert session["written_for_changed_model"] is False


def test_model_is_changed_only_where_that_is_chosen_and_a_copy_is_kept(session: dict[str, Any]) -> None:
    assert session["said_by_write_in_place"] == []
    is_changed, names = session["written_in_place"]
    assert is_changed
    assert [name for name in names if name.startswith("floor3.ifc.") and name.endswith(".bak")]


@pytest.mark.parametrize("checks", [False, True])
def test_document_may_be_closed_under_a_panel(session: dict[str, Any], checks: bool) -> None:
    assert session[f"opened_{checks}"]
    assert session["ran_when_closed"]
    assert session[f"after_closing_{checks}"] == [True, False, []]
    assert session["left_running"] == 0
    assert session["job_after_closing"]


def test_panel_may_be_left_while_its_job_runs(session: dict[str, Any]) -> None:
    assert session["after_leaving"] == [True, 0, []]
    assert "Traceback" not in session["printed"]


def test_column_may_be_deleted_under_its_panel(session: dict[str, Any]) -> None:
    assert session["after_deleting"] == [True, False, []]


@pytest.mark.parametrize("what", ["sample", "check", "job", "report", "try"])
def test_what_needs_the_environment_offers_one_button(session: dict[str, Any], what: str) -> None:
    buttons, said = session["without"][what]
    assert sorted(buttons) == ["Close", "Install now"]
    assert "FreeCAD itself is not changed" in said[0]


def test_scan_alone_leads_to_a_model(session: dict[str, Any]) -> None:
    buttons, said = session["scan_alone"]
    assert sorted(buttons) == ["Close", "IFC file…"]
    assert "belongs to a column" in said[0]


def test_reports_open_without_the_environment(session: dict[str, Any]) -> None:
    assert [verdict for _, verdict in session["opened_without"]] == ["fail"]


def test_failed_installation_says_why_and_leaves_nothing(session: dict[str, Any]) -> None:
    problem, said = session["installing"]
    assert problem == "no-wheel"
    assert "folder of wheels" in said
    assert "No matching distribution" in session["copied"]
    assert session["left_of_installing"] == []


def test_try_it_is_one_click(session: dict[str, Any]) -> None:
    assert session["said_by_try"] == session["open_after_try"] == []
    assert sorted(session["tried"]) == FLOOR
    assert session["tried"]["C-301"] == "pass"
    assert session["tried_shows"] == ["C-307", "fail"]
    assert "Traceback" not in session["printed"]
