"""What the scripted session found of many columns at once: by their scans' names, by a job, and back into one."""

import json
from pathlib import Path
from typing import Any

import pytest

from batch.job.file import read_job
from tests.conftest import ROOT

pytestmark = pytest.mark.freecad

FLOOR = ROOT / "samples" / "floor" / "job.toml"


def rows_of(job: Path) -> list[list[Any]]:
    """What the command reads in a job: names of scans, degrees of the side that is up."""
    return [
        [
            one.id,
            [Path(file).name for file in one.sleeves],
            [Path(file).name for file in one.rebars],
            one.sleeves_up_deg,
        ]
        for one in read_job(job).columns
    ]


def test_opened_job_shows_its_columns_and_their_scans(session: dict[str, Any]) -> None:
    shown = [[sleeves, rebars] for sleeves, rebars, _, _ in session["job_rows"]]
    assert shown == [[sleeves, rebars] for _, sleeves, rebars, _ in rows_of(FLOOR)]
    assert [up for *_, up, _ in session["job_rows"]] == ["+y"] * 4 + ["-x"] + ["+y"] * 3
    assert all(wanted for *_, wanted in session["job_rows"])
    assert session["job_camera"], "a job holds the camera, too"


def test_scans_are_found_by_their_names_in_a_folder(session: dict[str, Any]) -> None:
    shown = [[sleeves, rebars] for sleeves, rebars, _, _ in session["folder_rows"]]
    assert shown == [[sleeves, rebars] for _, sleeves, rebars, _ in rows_of(FLOOR)]
    assert session["folder_camera"] == "job.toml"
    assert session["folder_job"] == "/scans/aadm-job.toml"


def test_error_in_one_column_stops_no_other(session: dict[str, Any]) -> None:
    assert session["said_by_two"] == []
    assert session["two"] == {
        "C-301": ["pass", ["C-301-foot.tiff", "C-301-bars.tiff"]],
        "C-306": ["error", ["C-306-foot.tiff", "C-306-bars.tiff"]],
    }
    assert session["two_undo"] == ["Check all", "Scans of columns", "Sample design"]
    assert 4_000.0 < session["two_seen_mm"] < 20_000.0, "the view goes to the two columns, which stand 6 m apart"


def test_scans_of_many_are_shown_where_somebody_looks_into_them(session: dict[str, Any]) -> None:
    assert session["scans_to_show"]
    assert session["shown_scans"] == [[True, True, True]] * 2


def test_bodies_of_an_ifc_file_are_kept_for_the_eye(session: dict[str, Any]) -> None:
    assert session["bodies"] == [6] * 8, "the sides of a square prism"


def test_check_of_many_can_be_cancelled(session: dict[str, Any]) -> None:
    assert session["said_by_cancelled_all"] == [[], "cancelled"]
    assert "have scans" not in session["said_without_wanted"][0]
    assert "folder" in session["said_without_wanted"][0]


def test_document_remembers_scans_and_job(session: dict[str, Any]) -> None:
    assert session["remembered"] == ["two.toml", [["C-301-foot.tiff"], ["C-301-bars.tiff"]]]
    assert session["remembered_after_opening"] == session["remembered"]


def test_job_that_says_the_same_stays_as_it_was_written(session: dict[str, Any]) -> None:
    assert session["job_is_as_it_was"], "comments and all"


def test_job_written_anew_differs_in_what_was_changed_alone(session: dict[str, Any]) -> None:
    project = Path(session["project"])
    first = rows_of(FLOOR)
    assert rows_of(project / "job.toml") == [[*first[0][:3], 180.0], *first[1:]]
    assert session["anew"]["capture"]["operator"] == "virtual camera", "the panel does not show it, the job keeps it"
    anew, before = read_job(project / "job.toml"), read_job(FLOOR)
    assert (anew.camera, anew.depth_scale_mm, anew.name) == (before.camera, before.depth_scale_mm, before.name)
    assert rows_of(project / "elsewhere.toml") == rows_of(project / "job.toml")
    assert read_job(project / "elsewhere.toml").model == before.model, "the model itself, not a copy of its designs"


def test_columns_that_the_document_lacks_are_named(session: dict[str, Any]) -> None:
    assert "C-999" in session["said_for_strangers"][0]


def test_native_document_is_sampled_from_its_file(session: dict[str, Any]) -> None:
    assert session["native_columns"] == [f"C-30{number}" for number in range(1, 9)]


def test_scan_alone_comes_back_to_its_column(session: dict[str, Any]) -> None:
    assert session["back_with_scan"] == ["C-305-bars.tiff", "AADM C-305", "rebars"]


def test_verdicts_of_the_panel_are_those_of_the_command(session: dict[str, Any]) -> None:
    report = json.loads((Path(session["project"]) / "two-report" / "report.json").read_text(encoding="utf-8"))
    assert {one["id"]: one["verdict"] for one in report["columns"]} == {"C-301": "pass", "C-306": "error"}
    assert [one.id for one in read_job(Path(session["project"]) / "two.toml").columns] == ["C-301", "C-306"]
