"""The crew's page: what it says is done to the points, and then they are measured again."""

import copy
import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pypdf
import pytest

from aadm_workbench.assembly.pose.minimax import fit_minimax
from aadm_workbench.model import Array
from aadm_workbench.report.column_view import advice_notes
from aadm_workbench.report.pages.crew import CrewAdvice, crew_advice, in_steps
from aadm_workbench.report.pages.crew_page import write_crew_pages
from tests.report.checked_floor import CASES, CENTRES, HOSTILE, Case, far_apart, floor_report
from tests.report.test_directions import told_vector
from tests.report.typed import of_column, typed

LIGHTS = {
    "C-1": "green",
    "C-2": "red",
    "C-3": "red",
    "C-4": "amber",
    "C-5": "amber",
    "C-6": "amber",
    "C-7": "amber",
    HOSTILE: "green",
}


def advice_for(report: dict[str, Any], name: str) -> tuple[dict[str, Any], CrewAdvice]:
    column = next(column for column in report["columns"] if column["id"] == name)
    return column, crew_advice(typed(report), of_column(column))


def pages_of(path: Path) -> dict[str, str]:
    """Text of each page, white space closed up, by the column's name."""
    texts = [re.sub(r"\s+", "", page.extract_text()) for page in pypdf.PdfReader(path).pages]
    return dict(zip((text.partition("PCZ-1")[0][:40] for text in texts), texts, strict=True))


def squeezed(text: str) -> str:
    return re.sub(r"\s+", "", text)


def test_every_column_has_a_page_with_both_languages(floor: dict[str, Any], tmp_path: Path) -> None:
    write_crew_pages(typed(floor), tmp_path / "crew.pdf")
    reader = pypdf.PdfReader(tmp_path / "crew.pdf")
    assert len(reader.pages) == len(floor["columns"])
    texts = [squeezed(page.extract_text()) for page in reader.pages]
    assert {(round(page.mediabox.width), round(page.mediabox.height)) for page in reader.pages} == {(595, 842)}
    for name, light in LIGHTS.items():
        column, advice = advice_for(floor, name)
        assert advice.light == light
        page = next(text for text in texts if text.startswith(squeezed(name)) or squeezed(name) in text[:60])
        for part in (advice.headline, *(step.text for step in advice.steps)):
            assert squeezed(part.en) in page
            assert squeezed(part.zh) in page
        released = "须经工程师批准后" in page
        assert released == any(step.release for step in advice.steps)
        assert column["verdict"] != "pass" or light != "red"


def test_the_sketch_says_whether_it_shows_bars_or_sleeves(floor: dict[str, Any], tmp_path: Path) -> None:
    whole = next(column for column in floor["columns"] if column["verdict"] == "pass" and column["rebars"])
    foot = whole | {"id": "foot alone", "rebars": None, "trial_assembly": None, "goes_on": "not_assessed"}
    for column, shown in ((whole, "Barsseenfromabove"), (foot, "Sleevesinthefoot")):
        write_crew_pages(typed(floor | {"columns": [column]}), tmp_path / "crew.pdf")
        (page,) = pypdf.PdfReader(tmp_path / "crew.pdf").pages
        assert shown in squeezed(page.extract_text())


def test_same_bytes(floor: dict[str, Any], tmp_path: Path) -> None:
    for name in ("a.pdf", "b.pdf"):
        write_crew_pages(typed(floor), tmp_path / name)
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()


BEND = re.compile(r"Bend bar (R\d+): (.*)\.$")


@pytest.mark.parametrize(("turned_deg", "reach_mm"), [(0.0, 2.9), (90.0, 3.2), (180.0, 2.9), (-90.0, 3.2)])
def test_bars_bent_as_told_let_the_column_in(turned_deg: float, reach_mm: float) -> None:
    """The words are turned into millimetres in the building, done to the bars, and the column is checked again."""
    bad = Case("C-3", "B/2", turned_deg, far_apart(reach_mm=reach_mm))
    report = floor_report(bad, *CASES[:1], Case("C-9", "A/2"), Case("C-8", "B/3"))
    column, advice = advice_for(report, "C-3")
    assert column["goes_on"] == "fail"
    bends = [BEND.match(step.text.en) for step in advice.steps]
    assert any(bends)
    off = {name: np.array(vector) for name, vector in bad.off.items()}
    T = np.array(column["T_model_column"])[:2, :2]
    for bend in filter(None, bends):
        place = next(p["design_mm"][:2] for p in column["rebars"]["points"] if p["label"] == bend[1])
        number = int(np.argmin(np.linalg.norm(CENTRES - place, axis=1))) + 1
        off[f"R{number}"] = off[f"R{number}"] + T.T @ told_vector(bend[2], "B/2")
    repaired = floor_report(replace(bad, off={name: (v[0], v[1]) for name, v in off.items()}))
    assert repaired["columns"][0]["goes_on"] == "pass"
    # The other way round it must not go in: a sign that is lost would be found here.
    wrong = {name: np.array(bad.off[name]) - (vector - bad.off[name]) for name, vector in off.items()}
    spoilt = floor_report(replace(bad, off={name: (v[0], v[1]) for name, v in wrong.items()}))
    assert spoilt["columns"][0]["goes_on"] == "fail"


TURN = re.compile(r"Turn the column ([\d.]+)° (counter-clockwise|clockwise), seen from above")


def hanging(column: dict[str, Any], sleeves: Array, verdict: str = "fail") -> dict[str, Any]:
    """A frame of a column that hangs over its bars, which stand at their design places."""
    fit = fit_minimax(sleeves, CENTRES, np.ones(len(CENTRES)))
    offsets = CENTRES - sleeves
    pairs = [
        {
            "sleeve": f"S{k}",
            "rebar": f"R{k}",
            "sleeve_scan_mm": None,
            "rebar_scan_mm": None,
            "offset_mm": offset.tolist(),
            "distance_mm": float(np.linalg.norm(offset)),
            "u_mm": 0.05,
            "seen": True,
            "reason": "",
        }
        for k, offset in enumerate(offsets, start=1)
    ]
    # The turn is about the column's own axis, where it hangs.
    own = sleeves.mean(axis=0)
    shift = fit.shift + turned(own, fit.yaw) - own
    move = {"dx_mm": float(shift[0]), "dy_mm": float(shift[1]), "yaw_deg": math.degrees(fit.yaw)}
    frame = {"source": "hoist.tiff", "keys": ["S1"], "mean_mm": 1.0, "max_mm": 2.0, "column_tilt_deg": 0.0}
    return column | {"hoisting": [frame | {"verdict": verdict, "pairs": pairs, "correction": move}]}


def turned(points: Array, yaw: float) -> Array:
    cosine, sine = math.cos(yaw), math.sin(yaw)
    return points @ np.array([[cosine, sine], [-sine, cosine]])


@pytest.mark.parametrize("name", ["C-1", "C-6"])
@pytest.mark.parametrize("seed", range(5))
def test_column_moved_as_told_hangs_over_its_bars(floor: dict[str, Any], name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    column = next(column for column in floor["columns"] if column["id"] == name)
    sleeves = turned(CENTRES, rng.uniform(-0.02, 0.02)) + rng.uniform(-30.0, 30.0, 2)
    column |= hanging(column, sleeves)
    advice = crew_advice(typed(floor), of_column(column))
    assert advice.light == "amber"
    text = " ".join(step.text.en for step in advice.steps)
    turn = TURN.search(text)
    assert turn is not None
    yaw = math.radians(float(turn[1])) * (1.0 if turn[2] == "counter-clockwise" else -1.0)
    T = np.array(column["T_model_column"])[:2, :2]
    move = next(step.text.en for step in advice.steps if step.text.en.startswith("Move"))
    own = sleeves.mean(axis=0)
    told = own + turned(sleeves - own, yaw) + T.T @ told_vector(move, column["grid"])
    # 0.005 degrees and 0.05 mm twice are lost in rounding.
    assert np.linalg.norm(told - CENTRES, axis=1).max() < 0.2
    assert advice.turn_deg * yaw > 0.0


def test_same_move_beside_the_camera(floor: dict[str, Any]) -> None:
    """It is no step of its own: nobody may move the column twice."""
    column = floor["columns"][0]
    column |= hanging(column, CENTRES + np.array([3.0, -1.0]))
    before = crew_advice(typed(floor), of_column(column)).steps
    column["hoisting"][0]["correction"]["camera"] = {"right_mm": -1.2, "away_mm": 2.9, "yaw_deg": 0.0}
    after = crew_advice(typed(floor), of_column(column)).steps
    assert len(after) == len(before)
    told = "(The same move, seen from the camera: 1.2 mm to the left, 2.9 mm away from the camera.)"
    assert any(step.text.en.endswith(told) for step in after)


def test_column_that_hangs_right_is_lowered(floor: dict[str, Any]) -> None:
    column = floor["columns"][0]
    column |= hanging(column, CENTRES + 0.01, "pass")
    advice = crew_advice(typed(floor), of_column(column))
    assert advice.light == "green"
    assert [step.text.en for step in advice.steps] == ["It hangs right: lower it."]


def test_a_column_that_fails_is_not_moved_but_stopped(floor: dict[str, Any]) -> None:
    column = floor["columns"][2]
    column |= hanging(column, CENTRES + 5.0)
    assert crew_advice(typed(floor), of_column(column)).light == "red"


def test_room_holds_whichever_way_the_column_goes() -> None:
    """Shifted by the room that its page names, every bar stays within its limit and touches nothing."""
    report = floor_report(Case("C-1", "A/1", off={"S3": (0.7, -0.3), "R5": (0.3, 0.9), "R9": (-0.8, 0.0)}))
    column = report["columns"][0]
    said = in_steps(crew_advice(typed(report), of_column(column))).en
    room_mm = float(re.findall(r"it has ([\d.]+) mm of room in every direction", said)[0])
    pairs = column["trial_assembly"]["minimax"]["pairs"]
    offsets = np.array([pair["offset_mm"] for pair in pairs])
    ways = [(math.cos(angle), math.sin(angle)) for angle in np.linspace(0.0, 2.0 * math.pi, 90)]
    worst = max(float(np.linalg.norm(offsets - room_mm * np.array(way), axis=1).max()) for way in ways)
    assert 2.8 < worst <= 3.0
    assert all(room_mm <= pair["clearance_mm"] for pair in pairs)


def test_bends_wait_for_the_engineer(floor: dict[str, Any]) -> None:
    for column in floor["columns"]:
        for step in crew_advice(typed(floor), of_column(column)).steps:
            assert step.release == ("Bend" in step.text.en)


def test_plugged_sleeves_are_cleaned_together(floor: dict[str, Any]) -> None:
    column = copy.deepcopy(floor["columns"][3])
    points = column["sleeves"]["points"]
    for point in points[:2]:
        point |= {"verdict": "not_measured", "reason": "S1 not measured: no opening: the mouth is plugged or covered"}
    said = [step.text.en for step in crew_advice(typed(floor), of_column(column)).steps]
    assert said == [
        "Open and clean sleeve S1, S2, then scan the foot again.",
        "Scan S8 again, closer and straight.",
    ]


def test_an_open_trial_names_the_points_that_are_to_be_scanned_again(floor: dict[str, Any]) -> None:
    column = copy.deepcopy(next(one for one in floor["columns"] if one.get("repair")))
    column["verdict"], column["repair"]["action"] = "inconclusive", "rescan"
    column["trial_assembly"]["rescan"] = ["S7", "S2"]
    told = " ".join(step.text.en for step in crew_advice(typed(floor), of_column(column)).steps)
    assert "S7, S2" in told


def test_what_a_bend_leaves_is_told(floor: dict[str, Any]) -> None:
    """A bar goes in once it is bent, and still stands beyond its own limit: "bend" alone would mislead a crew."""
    column = copy.deepcopy(next(one for one in floor["columns"] if (one.get("repair") or {}).get("steps")))
    repair = column["repair"]
    step = repair["steps"][0]
    step |= {"position_after_mm": 2.3, "position_limit_mm": 2.0}
    repair["still_fails"] = [step["rebar"], "R99"]
    steps = crew_advice(typed(floor), of_column(column)).steps
    said = [step.text for step in steps]
    (left,) = (step.left for step in steps if step.left is not None and step.text.en.startswith("Bend"))
    assert "still stands" in left.en
    assert all(f"{step['rebar']}" in text and "2.3 mm" in text and "2 mm" in text for text in (left.en, left.zh))
    (others,) = (text for text in said if "R99" in text.en)
    assert "R99" in others.zh
    repair["still_fails"] = []
    assert "still" not in in_steps(crew_advice(typed(floor), of_column(column))).en


def test_a_bend_that_a_scan_has_to_confirm_waits_for_that_scan(floor: dict[str, Any]) -> None:
    """The column fails by a sleeve's place, but whether its bars go in is open: nobody bends before it is scanned."""
    column = copy.deepcopy(next(one for one in floor["columns"] if (one.get("repair") or {}).get("steps")))
    repair, trial = column["repair"], column["trial_assembly"]
    repair["advice"] = repair["advice"].replace("release: ", "release: rescan closer; if that confirms it, ")
    repair["still_fails"], trial["rescan"], trial["verdict"] = [], ["R6", "R9"], "inconclusive"
    steps = crew_advice(typed(floor), of_column(column)).steps
    first = next(number for number, step in enumerate(steps) if step.release)
    before = steps[first - 1]
    assert "R6, R9" in before.text.en
    assert before.left is not None
    assert ("only if" in before.left.en, "才" in before.left.zh) == (True, True)


def test_a_sleeve_that_no_bend_puts_right_is_named(floor: dict[str, Any]) -> None:
    column = copy.deepcopy(next(one for one in floor["columns"] if (one.get("repair") or {}).get("steps")))
    column["repair"]["still_fails"] = []
    for point in column["sleeves"]["points"]:
        point["verdict"] = "pass"
    blamed = {step["sleeve"] for step in column["repair"]["steps"]}
    other = next(point for point in column["sleeves"]["points"] if point["label"] not in blamed)
    assert "Out of tolerance" not in in_steps(crew_advice(typed(floor), of_column(column))).en
    other["verdict"] = "fail"
    said = in_steps(crew_advice(typed(floor), of_column(column)))
    assert f"Out of tolerance then, too: {other['label']}. The engineer decides." in said.en
    assert f"处理后仍超差：{other['label']}" in said.zh


def test_whether_a_clause_says_how_far_to_bend_is_no_matter_of_its_words(floor: dict[str, Any]) -> None:
    column = copy.deepcopy(next(one for one in floor["columns"] if (one.get("repair") or {}).get("steps")))
    for own, clause in ((True, "what we always do"), (False, "no clause is as clear as 8.1")):
        column["repair"] |= {"adjustment_limit_mm": 5.0, "clause": clause, "working_figure": own}
        said = " ".join(note.en for note in advice_notes(of_column(column)))
        assert ("working figure" in said) == own
        assert (clause in said) == (not own)


def test_what_is_left_open_is_named_to_be_scanned_again(floor: dict[str, Any]) -> None:
    """R3 and R4 stand nearly too far from each other: two bars to look at, not a column."""
    column = next(column for column in typed(floor).columns if column.id == "C-7")
    opened = [spacing.between for spacing in column.rebars.spacing if spacing.verdict == "inconclusive"]
    (step,) = crew_advice(typed(floor), column).steps
    assert [set(re.findall(r"R\d+", step.text.en))] == [set(labels) for labels in opened]
    for point in floor["columns"][6]["rebars"]["points"]:
        point["verdict"] = "inconclusive"
    (step,) = crew_advice(typed(floor), typed(floor).columns[6]).steps
    assert step.text.en == "Scan again, closer and straight."
