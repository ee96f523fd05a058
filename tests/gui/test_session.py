"""The scripted session in the real FreeCAD: the whole way from a model to written results, and what is seen of it."""

import itertools
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from aadm_workbench import __version__
from aadm_workbench.document.display.colours import VERDICTS, of_verdict
from aadm_workbench.document.display.label_layout import overlap
from aadm_workbench.report.read import read_report

pytestmark = pytest.mark.freecad

COMMANDS = [
    "AADM_About",
    "AADM_Camera",
    "AADM_CaptureScan",
    "AADM_CheckAll",
    "AADM_CheckColumn",
    "AADM_Hoisting",
    "AADM_ImportScan",
    "AADM_Report",
    "AADM_RunJob",
    "AADM_SampleDesign",
    "AADM_SavePicture",
    "AADM_Settings",
    "AADM_TryIt",
    "AADM_WriteResults",
]


def rgb(verdict: str) -> np.ndarray:
    return np.array(of_verdict(verdict)) * 255.0


def is_colour(seen: list[int], verdict: str) -> bool:
    return bool(np.abs(np.array(seen) - rgb(verdict)).max() < 12.0)


def share_of(picture: Path, verdict: str) -> float:
    """Share of a picture's pixels that have the colour of a verdict."""
    seen = cv2.imread(str(picture))[:, :, ::-1].astype(float)
    return float((np.abs(seen - rgb(verdict)).max(axis=2) < 12.0).mean())


def test_workbench_is_listed_and_loads_its_commands_late(session: dict[str, Any]) -> None:
    assert session["listed"]
    assert not session["loaded_early"], "commands are loaded when the workbench is first opened"
    assert session["name"] == "AADM"
    assert "precast" in session["tooltip"]
    assert session["commands"] == COMMANDS
    assert "AADM" in session["toolbars"]
    assert session["icon_is_drawn"]
    assert "Traceback" not in session["printed"]


@pytest.mark.parametrize("when", ["without_document", "in_empty_document", "with_wrong_selection"])
def test_every_command_says_what_it_needs(session: dict[str, Any], when: str) -> None:
    said = session[f"said_{when}"]
    assert len(said) == 6
    for name, sentences in said.items():
        assert len(sentences) == 1, name
        assert "This should not happen" not in sentences[0]
        assert len(sentences[0]) > 20


def test_a_live_camera_gives_a_column_its_scan(session: dict[str, Any]) -> None:
    assert session["capture_kept_in"] == "captures", "beside the document"
    assert "gige://IP" in session["said_without_camera_named"][0]
    assert "record" in session["said_without_folder"][0]
    assert "there is no such folder" in session["said_for_no_camera"][0]
    assert session["said_by_capture"] == []
    (name,) = session["captures"]
    kind, count, file = session["captured"]
    imported = next(scan for scan in session["scans"] if scan[0] == "sleeves")
    assert (kind, count, file) == ("sleeves", imported[1], name)
    assert session["capture_undo"] == "Capture"
    before, after = session["scans_after_capture_undone"]
    assert before == after


def test_a_step_file_and_folders_of_captures_lead_to_the_verdict(session: dict[str, Any]) -> None:
    assert len(session["step_columns"]) == 1
    assert session["said_by_folders"] == [[], []]
    assert session["said_by_step_check"] == []
    # That of the same column as FreeCAD's own document holds it, with the same scans as files.
    assert session["step_verdict"] == session["verdict"]


def test_without_a_document_one_command_leads_to_one(session: dict[str, Any]) -> None:
    assert session["active_without_document"] == ["AADM_SampleDesign"]
    assert session["objects_after_nonsense"] == []


def test_design_is_sampled_where_the_column_stands(session: dict[str, Any]) -> None:
    assert session["design_rows"] == 12
    expected = [[0, -1, 0, 7800], [1, 0, 0, 13200], [0, 0, 1, 7200], [0, 0, 0, 1]]
    np.testing.assert_allclose(session["column_place"], expected, atol=1e-6)


def test_pairing_is_swapped_and_undone_in_one_step(session: dict[str, Any]) -> None:
    first, second = session["swapped_back"]
    np.testing.assert_allclose(session["swapped"], [second, first])
    assert "sideways" in session["said_for_wrong_up"][0]
    assert session["undo_names"] == ["Sample design"]


def test_bad_scans_get_a_sentence_each(session: dict[str, Any]) -> None:
    assert "breaks off" in session["said_for_broken_scan"][0]
    assert "intrinsics" in session["said_without_camera"][0]
    assert "no such file" in session["said_for_missing_file"][0]
    assert session["scans_after_errors"] == 0


def test_good_scans_are_shown_thinned(session: dict[str, Any]) -> None:
    assert session["said_for_good_scans"] == []
    assert [kind for kind, _, _ in session["scans"]] == ["sleeves", "rebars"]
    for _, count, shown in session["scans"]:
        assert count > 1_000_000
        assert 30_000 < shown <= 60_000


def test_check_can_be_cancelled_and_leaves_the_window_alive(session: dict[str, Any]) -> None:
    assert session["result_after_cancel"] is False
    assert session["rounds"] > 20, "rounds of the window's loop while the check ran"
    assert session["longest_gap_s"] < 4.0
    assert session["longest_gap_in_job_s"] < 4.0


def test_verdict_is_that_of_the_sample(session: dict[str, Any]) -> None:
    verdict, goes_on, reasons = session["verdict"]
    assert (verdict, goes_on) == ("fail", "pass")
    assert "R5" in reasons[0]
    assert session["said_by_check"] == []


def test_table_begins_with_the_worst(session: dict[str, Any]) -> None:
    assert session["rows"][0] == ["R5", "position", "fail"]
    assert session["first_shown"] == "R5"
    assert session["failing_rows"] == sum(verdict == "fail" for _, _, verdict in session["rows"])
    assert 400.0 < session["zoomed_height_mm"] < 600.0


def test_scan_is_laid_on_the_foot(session: dict[str, Any]) -> None:
    foot, bars = (np.array(place) for place in session["scan_places"])
    # The camera stood 1.3 m below the foot and looked up, and as far above the bars and looked down.
    assert foot[2, 2] > 0.99
    assert bars[2, 2] < -0.99
    assert 5700 < foot[2, 3] < 6100
    assert 8500 < bars[2, 3] < 8900


def test_colours_stand_where_the_points_are(session: dict[str, Any]) -> None:
    arrow, sleeve, nowhere = session["colours"]
    assert is_colour(arrow, "fail"), "the magnified arrow of R5"
    assert is_colour(sleeve, "pass"), "the edge of S8 at true size"
    assert nowhere == [255, 255, 255], "nothing beside the foot"
    assert not is_colour(session["colours_minimax"][0], "fail"), "at the best position R5 is within its limit"
    assert session["factor"] == 30.0


@pytest.mark.parametrize("boxes", ["boxes", "floor_boxes"])
def test_labels_do_not_overlap(session: dict[str, Any], boxes: str) -> None:
    shown = session[boxes]
    assert len(shown) >= 3
    assert not [pair for pair in itertools.combinations(map(tuple, shown), 2) if overlap(*pair)]


def test_pictures_show_what_they_should(session: dict[str, Any]) -> None:
    folder = session["folder"]
    assert share_of(folder / "foot.png", "fail") > 0.005
    assert share_of(folder / "foot.png", "pass") > 0.005
    assert share_of(folder / "column.png", "fail") > 0.001
    for verdict in ("pass", "fail", "inconclusive", "error", "not_measured"):
        assert share_of(folder / "floor.png", verdict) > 0.0005, verdict
    colours = cv2.imread(str(folder / "cloud.png")).reshape(-1, 3)
    assert len(np.unique(colours, axis=0)) > 100, "points in the colours of their distances"


def test_column_follows_its_model(session: dict[str, Any]) -> None:
    assert session["followed_mm"] == pytest.approx([13700.0, 13700.0])


def test_lengths_follow_the_unit(session: dict[str, Any]) -> None:
    millimetres, inches = session["lengths"]
    assert millimetres == "2.54 mm"
    assert inches.startswith("0.1000")


def test_results_are_written(session: dict[str, Any]) -> None:
    assert session["said_by_write"] == []
    verdict, largest_mm = session["on_model"]
    assert verdict == "fail"
    assert largest_mm == pytest.approx(3.47, abs=0.3)
    assert "IFC" in session["said_without_ifc"][0]
    assert session["said_by_report"] == []
    assert session["report"] == "fail"
    assert session["picture_of_report"]
    assert read_report(session["folder"] / "report" / "report.json").summary()["fail"] == 1


def test_document_comes_back(session: dict[str, Any]) -> None:
    reopened = session["reopened"]
    assert reopened["visible"]
    assert reopened["view"] == "ResultView"
    assert reopened["children"] == ["AADM_Scan", "AADM_Scan001", "AADM_Result"]
    assert reopened["icon"] == "column-fail.svg"
    assert reopened["labels"] >= 2


def test_column_is_deleted_whole_and_comes_back_whole(session: dict[str, Any]) -> None:
    assert session["left_after_delete"] == []
    assert session["back_after_undo"] == ["AADM_Column", "AADM_Result", "AADM_Scan", "AADM_Scan001"]
    assert session["labels_after_undo"] >= 2


def test_job_runs_beside_the_window(session: dict[str, Any]) -> None:
    assert "job file" in session["said_without_job"][0]
    assert "nonsense" in session["said_for_broken_job"][0]
    assert session["said_by_cancelled_job"] == []
    assert session["shown_by_cancelled_job"] == 0
    assert session["said_by_job"] == []
    assert session["job_columns"] == [["L-1", "pass"], ["L-2", "pass"]]
    assert any(line.startswith("L-1: pass") for line in session["job_lines"])


def test_thirty_columns_stay_fluid(session: dict[str, Any]) -> None:
    assert session["thirty"] == 30
    assert session["thirty_s"] < 5.0
    assert session["slowest_turn_s"] < 1.0
    assert session["thirty_after_undo"] == 0, "one undo step"
    assert session["thirty_after_odd_reports"] == 0


def test_document_that_a_batch_wrote_opens_visible_and_complete(session: dict[str, Any]) -> None:
    assert session["annotate"] == [0, True], session["annotate_said"]
    annotated = session["annotated"]
    assert annotated["visible"] == annotated["objects"]
    assert len(annotated["objects"]) == 16, "a column, twelve bars, a group, a column object and its result"
    assert annotated["colour"] == [0.1, 0.2, 0.3], "what the model's author had set"
    assert annotated["model"] == "Column"
    assert annotated["view"] == "ResultView"
    assert annotated["labels"] >= 2
    assert share_of(session["folder"] / "annotated.png", "fail") > 0.001


def test_far_from_the_origin(session: dict[str, Any]) -> None:
    assert session["far_place"] == [4.0e8, 0.0, 3600.0]
    assert session["far_boxes"] >= 2
    assert share_of(session["folder"] / "far.png", "fail") > 0.001


def test_hoisting_says_which_way(session: dict[str, Any]) -> None:
    assert session["hoisting"] == pytest.approx([8.0, -5.0])
    # Red; green; and never green when no new frame comes, or while the column moves.
    assert session["lights"] == ["push", "go", "hold", "hold"]
    assert share_of(session["folder"] / "stale.png", "pass") < 0.001
    assert "Waiting" in session["text_for_broken_state"]
    assert share_of(session["folder"] / "hoisting.png", "fail") > 0.005


def test_about_and_doctor(session: dict[str, Any]) -> None:
    assert session["about"].startswith(f"AADM {__version__}\nFreeCAD ")
    assert "FreeCAD itself is not changed" in session["about_state"]
    assert session["about_buttons"][0] == "Try it on a sample floor"
    assert session["about_buttons"][1:4] == ["Repair", "From a folder of wheels…", "Remove"]


def test_language_switches(session: dict[str, Any]) -> None:
    assert session["words"] == ["Check column", "检测柱", "Check column"]
    assert session["menu"][0] == "提取设计点"
    assert "设计" in session["sentence"]


def test_colours_of_verdicts_differ_in_lightness_too() -> None:
    shown = [np.array(VERDICTS[name]) @ [0.2126, 0.7152, 0.0722] for name in ("pass", "fail", "inconclusive", "error")]
    assert len({round(float(value), 2) for value in shown}) == 4
