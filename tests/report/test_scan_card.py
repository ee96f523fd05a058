"""Scan cards: what they draw is what the camera of the samples sees, and they say where S1 is and how far away."""

import copy
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pypdf
import pytest

from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.model import Camera, Kind
from aadm_workbench.report.drawing.sketch import Label
from aadm_workbench.report.pages.scan_card import CardDesign, ScanCard, corner_of, design_cards, scan_cards, top_side
from aadm_workbench.report.pages.scan_card_page import picture_sketch, write_scan_cards
from batch.commands.report import job_cards
from batch.job.file import read_job
from tests.report.checked_floor import DESIGN, HOSTILE
from tests.report.typed import typed

SAMPLE = Path(__file__).resolve().parents[2] / "samples" / "floor"


@pytest.fixture(scope="module")
def sample_cards() -> dict[str, ScanCard]:
    """The cards of the sample floor, from its job and model alone."""
    return {card.id: card for card in job_cards(read_job(SAMPLE / "job.toml"))}


@pytest.mark.parametrize("name", ["C-301", "C-305"])
@pytest.mark.parametrize("part", [0, 1])
def test_card_shows_what_the_virtual_camera_saw(sample_cards: dict[str, ScanCard], name: str, part: int) -> None:
    """Against the truth of the scans, x to the right and y downwards; C-305 lies turned by 90 degrees."""
    card = sample_cards[name]
    drawn = {
        shape.text: shape.at for shape in picture_sketch(card, card.parts[part]).shapes if isinstance(shape, Label)
    }
    truth = json.loads((SAMPLE / "truth.json").read_text())["columns"][name][card.parts[part].part.plural]
    seen = {point["label"]: np.array([point["scan_mm"][0], -point["scan_mm"][1]]) for point in truth}
    places = np.array([drawn[label] for label in seen])
    expected = np.array(list(seen.values()))
    places, expected = places - places.mean(axis=0), expected - expected.mean(axis=0)
    # Labels stand beside their points, towards the middle; the camera is a little off and turned.
    scale = float((places * expected).sum() / (expected**2).sum())
    assert np.abs(places - scale * expected).max() < 0.2 * np.abs(scale * expected).max()
    assert scale > 0.0


def test_foot_is_the_mirror_of_the_bars(sample_cards: dict[str, ScanCard]) -> None:
    foot, bars = sample_cards["C-301"].parts
    assert corner_of(foot, "S1").en == "bottom right"
    assert corner_of(bars, "R1").en == "bottom left"
    assert top_side(sample_cards["C-301"], foot).en == "the side from S7 to S10"


def test_distance_fills_the_picture() -> None:
    design = inline_design("C-1", DESIGN)
    near = Camera(1200.0, 1200.0, 960.0, 600.0, 1920, 1200)
    (default,) = design_cards([CardDesign("C-1", design)])
    (close,) = design_cards([CardDesign("C-1", design)], near)
    assert default.parts[0].distance_m == pytest.approx(1.35)
    seen_mm = 1000.0 * close.parts[0].distance_m * near.height / near.fy
    assert 600.0 < seen_mm < 700.0


def test_card_from_a_report_keeps_the_way_of_the_last_scan(floor: dict[str, Any]) -> None:
    cards = {card.id: card for card in scan_cards(typed(floor))}
    assert [part.up_deg for part in cards["C-1"].parts] == [90.0, 90.0]
    assert cards["C-1"].parts[0].last_distance_m == pytest.approx(1.3, abs=0.2)
    assert [part.part for part in cards["C-6"].parts] == [Kind.SLEEVE]
    assert cards["C-5"].parts == ()


def test_card_from_a_report_on_a_cloud_in_the_axes_of_opengl(floor: dict[str, Any]) -> None:
    turned = copy.deepcopy(floor)
    column = next(column for column in turned["columns"] if column["id"] == "C-1")
    for group in (column["sleeves"], column["rebars"]):
        group["quality"]["axes"] = "opengl"
        for point in group["points"]:
            x, y, z = point["scan_mm"]
            point["scan_mm"] = [x, -y, -z]
        for row in group["fit"]["T_design_scan"]:
            row[1:3] = [-row[1], -row[2]]
    parts = {card.id: card for card in scan_cards(typed(turned))}["C-1"].parts
    assert [part.up_deg for part in parts] == [90.0, 90.0]
    assert parts[0].last_distance_m == pytest.approx(1.3, abs=0.2)


def test_pages(floor: dict[str, Any], tmp_path: Path) -> None:
    write_scan_cards(scan_cards(typed(floor)), tmp_path / "cards.pdf", title="Floor 3")
    pages = [re.sub(r"\s+", "", page.extract_text()) for page in pypdf.PdfReader(tmp_path / "cards.pdf").pages]
    assert len(pages) == len(floor["columns"])
    page = next(text for text in pages if text.startswith("C-1"))
    for said in ("S1在画面右下", "S1isbottomright", "R1在画面左下", "R1isbottomleft", "1.35m", 'up="+y"', "smoothing"):
        assert said in page
    assert any(re.sub(r"\s+", "", HOSTILE) in text for text in pages)
    assert "没有该柱的设计" in next(text for text in pages if text.startswith("C-5"))
