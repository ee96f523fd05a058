"""What is drawn, measured by those that draw it: Chromium has the boxes of an SVG, PDFium those of a page."""

import ctypes
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
import pypdfium2
import pytest
from pypdfium2 import raw

from aadm_workbench.model import JobReport
from aadm_workbench.report.pages.crew_page import write_crew_pages
from aadm_workbench.report.pages.scan_card import scan_cards
from aadm_workbench.report.pages.scan_card_page import write_scan_cards
from aadm_workbench.report.pages.svg import svg_of, svg_styles
from aadm_workbench.twin.parts import ring
from tests.report import checked_floor
from tests.report.browser import chromium
from tests.report.checked_floor import Case, floor_report
from tests.report.drawing.test_layout import sketches
from tests.report.typed import typed

ROW = np.linspace(-350.0, 350.0, 10)
PATTERNS = {
    "4": (ring(240.0, 240.0, 2), [600.0, 600.0]),
    "8": (ring(240.0, 240.0, 3), [600.0, 600.0]),
    "12 near the edges": (ring(150.0, 150.0, 4), [350.0, 350.0]),
    "20 in two rings": (np.vstack([ring(240.0, 240.0, 4), ring(120.0, 120.0, 3)]), [600.0, 600.0]),
    "20 in two rows": (np.array([(x, y) for y in (120.0, -120.0) for x in ROW]), [800.0, 300.0]),
    "40 in one ring": (ring(400.0, 400.0, 11), [900.0, 900.0]),
    "48 in two rings": (np.vstack([ring(380.0, 380.0, 8), ring(270.0, 270.0, 6)]), [900.0, 900.0]),
}
CAPITALS = 0.70  # of the size: what letters of capitals and figures cover above their base line
COLLISIONS = """capitals => {
  const met = [];
  document.querySelectorAll("svg").forEach((svg, number) => {
    const texts = [...svg.querySelectorAll("text")].filter(text => text.textContent !== "?").map(text => {
      const box = text.getBBox(), size = parseFloat(getComputedStyle(text).fontSize), foot = +text.getAttribute("y");
      return {said: text.textContent, left: box.x, right: box.x + box.width, top: foot - capitals * size, foot};
    });
    texts.forEach((a, k) => texts.slice(k + 1).forEach(b => {
      if (a.left < b.right && b.left < a.right && a.top < b.foot && b.top < a.foot)
        met.push(`${number}: ${a.said} on ${b.said}`);
    }));
    svg.querySelectorAll("path, circle").forEach(shape => {
      for (let along = 0; along <= shape.getTotalLength(); along += 0.25) {
        const {x, y} = shape.getPointAtLength(along);
        const on = texts.find(t => t.left < x && x < t.right && t.top < y && y < t.foot);
        if (on) { met.push(`${number}: ${on.said} on a ${shape.tagName}`); break; }
      }
    });
  });
  return met;
}"""


@pytest.fixture(scope="module")
def browser_page() -> Iterator[Any]:
    with chromium() as browser:
        yield browser.new_page()


@pytest.fixture(scope="module", params=PATTERNS)
def report(request: pytest.FixtureRequest) -> JobReport:
    centres, size = PATTERNS[request.param]
    design = dict(checked_floor.DESIGN, centres=centres.tolist(), size=size)
    with mock.patch.multiple(checked_floor, CENTRES=centres, DESIGN=design):
        one = Case("C-1", "A/1", 0.0, {"R2": (7.5, 0.0)})
        two = Case("C-2", "A/2", 30.0, {"S3": None, "R4": (-9.0, 4.0)})
        three = Case("9" * 1000, None, 0.0, {"R1": (3.0, 3.0), "S2": (2.5, 0.0)})
        return typed(floor_report(one, two, three))


def test_no_text_of_a_sketch_lies_on_a_text_or_a_line(report: JobReport, browser_page: Any) -> None:
    drawn = "".join(svg_of(sketch, label="sketch") for sketch in sketches(report))
    style = f"svg{{width:600px}}svg g{{text-anchor:middle}}svg g[text-anchor=start]{{text-anchor:start}}{svg_styles()}"
    browser_page.set_content(f"<style>body{{font-family:sans-serif}}{style}</style>{drawn}")
    assert browser_page.evaluate(COLLISIONS, CAPITALS) == []


@pytest.mark.parametrize("language", ["en", "zh"])
def test_no_text_of_a_page_lies_on_a_text_or_a_line(report: JobReport, language: Any, tmp_path: Path) -> None:
    write_crew_pages(report, tmp_path / "crew.pdf", language)
    write_scan_cards(scan_cards(report), tmp_path / "card.pdf", language)
    for name in ("crew.pdf", "card.pdf"):
        with pypdfium2.PdfDocument(tmp_path / name) as document:
            assert len(document) == 3
            for page in document:
                boxes = letters(page)
                assert not list(texts_on_texts(boxes)), name
                assert not list(lines_on_texts(page, boxes)), name


def letters(page: Any) -> np.ndarray:
    """Boxes (n, 4) of the ink of the letters: left, low, right, high, pt."""
    text = page.get_textpage()
    return np.array([text.get_charbox(k) for k in range(text.count_chars()) if text.get_text_range(k, 1).strip()])


def texts_on_texts(boxes: np.ndarray) -> Iterator[tuple[int, int]]:
    """Letters that share more than a tenth of the smaller one; a thing that touches the next of its word does not."""
    low = np.maximum(boxes[:, None, :2], boxes[None, :, :2])
    high = np.minimum(boxes[:, None, 2:], boxes[None, :, 2:])
    shared = np.prod(np.clip(high - low, 0.0, None), axis=2)
    own = np.prod(boxes[:, 2:] - boxes[:, :2], axis=1)
    for a, b in np.argwhere(np.triu(shared > 0.1 * np.minimum(own[:, None], own[None, :]) + 0.05, 1)):
        yield int(a), int(b)


def lines_on_texts(page: Any, boxes: np.ndarray) -> Iterator[tuple[float, float]]:
    """Points of thin lines that lie on letters."""
    for points in strokes(page):
        x, y = points[:, :1], points[:, 1:]
        within = (boxes[:, 0] + 0.1 < x) & (x < boxes[:, 2] - 0.1) & (boxes[:, 1] + 0.1 < y) & (y < boxes[:, 3] - 0.1)
        yield from ((float(a), float(b)) for a, b in points[within.any(axis=1)])


def strokes(page: Any) -> Iterator[np.ndarray]:
    """Every line that is drawn, as points (n, 2), pt; what is filled with a letter's ground under it is none."""
    for thing in page.get_objects(filter=[raw.FPDF_PAGEOBJ_PATH]):
        mode, stroked = ctypes.c_int(), ctypes.c_int()
        raw.FPDFPath_GetDrawMode(thing.raw, mode, stroked)
        if not stroked.value:
            continue
        a, b, c, d, e, f = thing.get_matrix().get()
        places = np.array(list(walked(thing.raw)))
        yield places @ np.array([[a, b], [c, d]]) + [e, f]


def walked(path: Any) -> Iterator[tuple[float, float]]:
    """A path in steps: lines in forty, curves of four points in forty, too."""
    x, y = ctypes.c_float(), ctypes.c_float()
    last, curve = np.zeros(2), []
    for k in range(raw.FPDFPath_CountSegments(path)):
        segment = raw.FPDFPath_GetPathSegment(path, k)
        raw.FPDFPathSegment_GetPoint(segment, x, y)
        here, kind = np.array([x.value, y.value]), raw.FPDFPathSegment_GetType(segment)
        t = np.linspace(0.0, 1.0, 40)[:, None]
        if kind == raw.FPDF_SEGMENT_LINETO:
            yield from (last + t * (here - last)).tolist()
        elif kind == raw.FPDF_SEGMENT_BEZIERTO:
            curve.append(here)
            if len(curve) < 3:
                continue
            p1, p2, p3 = curve
            yield from ((1 - t) ** 3 * last + 3 * (1 - t) ** 2 * t * p1 + 3 * (1 - t) * t**2 * p2 + t**3 * p3).tolist()
            curve = []
        else:
            yield (float(here[0]), float(here[1]))
        last = here
