"""snapshot.png: the foot as designed, seen from above, with arrows to what was measured, drawn without a screen."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np

from aadm_workbench.model import Array
from aadm_workbench.report.bcf.findings import Document, Finding, groups, pair_of
from aadm_workbench.report.words.labels import COLOUR, SIGN

_SIZE_PX = 900  # of the square that the foot is drawn in: viewers show it at half of that
_HEAD_PX = 110  # three lines over it
_LEGEND_PX = 60  # two lines under it
_MARGIN_PX = 70  # about the foot: labels of its outermost points
_LONGEST_ARROW_PX = 75.0  # half of what lies between neighbours of a ring of twelve
_SLEEVE_LABEL_PX = 22.0  # beyond the rim of a sleeve
_BAR_LABEL_PX = 84.0  # beyond the longest arrow
_MAGNIFICATIONS = (500, 200, 100, 50, 20, 10, 5, 2, 1)  # factors that a person can divide by
_INK = (60, 50, 40)  # BGR
_FAINT = (215, 210, 205)  # BGR
_FONT = cv2.FONT_HERSHEY_SIMPLEX
_SUBPIXEL_BITS = 4  # OpenCV draws at sixteenths of a pixel
_ASCII_SIGN = {"pass": "v", "fail": "X", "not_measured": "-", "not_assessed": "o"}


def foot_picture(finding: Finding) -> bytes:
    """The PNG of one topic, the same bytes for the same report.

    Circles are the sleeves as designed, arrows (magnified, the factor is printed) run from the designed centre towards
    the measured one, thick where the topic is about them. x of the column frame points right, y up.
    """
    image = np.full((_SIZE_PX + _HEAD_PX + _LEGEND_PX, _SIZE_PX, 3), 255, np.uint8)
    view = _View(finding.column)
    _outline(image, view)
    for group in groups(finding.column):
        for point in group["points"]:
            _point(image, point, view, blamed=int(point["label"][1:]) in finding.numbers)
    _captions(image, finding, view)
    written, content = cv2.imencode(".png", image, [cv2.IMWRITE_PNG_COMPRESSION, 6])
    assert written, "OpenCV always writes an 8-bit image as PNG"
    return bytes(content)


class _View:
    """Where a point of the column frame (mm) lands in the picture, and how far arrows are magnified."""

    def __init__(self, column: Document) -> None:
        points = [point for group in groups(column) for point in group["points"]]
        designed = np.array([point["design_mm"][:2] for point in points] or [[0.0, 0.0]])
        self.half_mm = np.array(column["size_mm"] or (0.0, 0.0)) / 2.0
        reach_mm = max(100.0, *self.half_mm, float(np.abs(designed).max()) + 40.0)
        self.px_per_mm = (_SIZE_PX / 2.0 - _MARGIN_PX) / reach_mm
        longest_mm = max([1e-3, *(abs(part) for point in points for part in point["offset_mm"] or ())])
        fits = (k for k in _MAGNIFICATIONS if k * longest_mm * self.px_per_mm <= _LONGEST_ARROW_PX)
        self.magnified = next(fits, 1)

    def at(self, xy_mm: Array) -> tuple[int, int]:
        """Pixels, in steps of 1/16."""
        x, y = np.asarray(xy_mm, dtype=float)[:2] * self.px_per_mm * (1.0, -1.0) + _SIZE_PX / 2.0
        return self.fixed(x), self.fixed(y + _HEAD_PX)

    def fixed(self, value_px: float) -> int:
        """A length in pixels as OpenCV takes it, in steps of 1/16."""
        return round(float(value_px) * (1 << _SUBPIXEL_BITS))


def _outline(image: Any, view: _View) -> None:
    """The foot's edge, and the column frame's axes in a corner."""
    if view.half_mm.all():
        low, high = view.at(-view.half_mm), view.at(view.half_mm)
        cv2.rectangle(image, low, high, _INK, 2, cv2.LINE_AA, _SUBPIXEL_BITS)
    corner = (32, _SIZE_PX + _HEAD_PX - 26)
    for tip, name in (((corner[0] + 46, corner[1]), "x"), ((corner[0], corner[1] - 46), "y")):
        cv2.arrowedLine(image, corner, tip, _INK, 2, cv2.LINE_AA)
        _write(image, name, (tip[0] + 6, tip[1] + 4), 0.5)


def _point(image: Any, point: Document, view: _View, *, blamed: bool) -> None:
    """A sleeve as a circle or a bar as a disk, its arrow, and its label outside of the ring."""
    designed = np.array(point["design_mm"][:2])
    is_sleeve = point["label"].startswith("S")
    colour = _bgr(point["verdict"])
    radius_px = max(6.0, 0.5 * (point["diameter_mm"] or (36.0 if is_sleeve else 20.0)) * view.px_per_mm)
    rim = cv2.LINE_AA, _SUBPIXEL_BITS
    if is_sleeve:
        cv2.circle(image, view.at(designed), view.fixed(radius_px), colour, 3 if blamed else 2, *rim)
    else:
        cv2.circle(image, view.at(designed), view.fixed(radius_px), _FAINT, -1, *rim)
        cv2.circle(image, view.at(designed), view.fixed(radius_px), colour, 2 if blamed else 1, *rim)
    if point["offset_mm"] is not None:
        tip = designed + view.magnified * np.array(point["offset_mm"])
        thickness = (4 if blamed else 2) if is_sleeve else (3 if blamed else 1)
        cv2.arrowedLine(
            image, view.at(designed), view.at(tip), colour, thickness, cv2.LINE_AA, _SUBPIXEL_BITS, tipLength=0.3
        )
    _label(image, point, designed, view, radius_px, blamed=blamed)


def _label(image: Any, point: Document, designed: Array, view: _View, radius_px: float, *, blamed: bool) -> None:
    """Towards the middle of the foot, where there is room: bars beyond sleeves, with the deviation where it matters."""
    is_sleeve = point["label"].startswith("S")
    inwards = -designed / (float(np.linalg.norm(designed)) or 1.0)
    away_px = (_SLEEVE_LABEL_PX if is_sleeve else _BAR_LABEL_PX) + (radius_px if is_sleeve else 0.0)
    x, y = (value >> _SUBPIXEL_BITS for value in view.at(designed))
    place = (round(x + inwards[0] * away_px) - 14, round(y - inwards[1] * away_px) + 5)
    text = point["label"]
    if blamed and point["deviation_mm"] is not None:
        text += f" {point['deviation_mm']:.2f}"
    _write(image, text, place, 0.5, (255, 255, 255), 6)
    _write(image, text, place, 0.5, _bgr(point["verdict"]), 2 if blamed else 1)


def _captions(image: Any, finding: Finding, view: _View) -> None:
    """What it is above, how to read it below."""
    colour = _bgr(finding.verdict.value)
    sign = _ASCII_SIGN.get(finding.verdict.value, SIGN[finding.verdict])
    cv2.rectangle(image, (0, 0), (_SIZE_PX, 12), colour, -1)
    _write(image, f"{sign} {finding.name}: {finding.verdict.value.replace('_', ' ')}", (24, 52), 0.95, colour, 2)
    said = finding.reasons[0] if finding.reasons else ""
    _write(image, said if len(said) < 96 else f"{said[:93]}...", (24, 86), 0.5)
    pairs = [pair for number in finding.numbers if (pair := pair_of(finding.column, number))]
    worst_pair = max(pairs, key=lambda pair: float(pair["distance_mm"]), default=None)
    legend = f"Seen from above. O sleeves, o bars as designed; arrows: measured minus design, x {view.magnified}."
    if not groups(finding.column):
        legend = "Nothing was measured on this foot."
    foot = _SIZE_PX + _HEAD_PX
    _write(image, legend, (24, foot + 16), 0.5)
    if worst_pair is not None:
        names = f"{worst_pair['sleeve']}/{worst_pair['rebar']}"
        _write(image, f"Trial assembly: {names} are {worst_pair['distance_mm']:.2f} mm apart.", (24, foot + 42), 0.5)


def _write(
    image: Any, text: str, place: tuple[int, int], scale: float, colour: tuple[int, int, int] = _INK, weight: int = 1
) -> None:
    """OpenCV's font has no other letters than ASCII; the topic's title holds the name as it is."""
    shown = "".join(letter if " " <= letter <= "~" else "?" for letter in text)
    cv2.putText(image, shown, place, _FONT, scale, colour, weight, cv2.LINE_AA)


def _bgr(verdict: str) -> tuple[int, int, int]:
    red, green, blue = bytes.fromhex(COLOUR[verdict].removeprefix("#"))
    return blue, green, red
