"""Draws pictures of the pages: python docs/figures.py build/demo-report/report.json C-303.

From a report the one of the README; without a report the signs of the hoisting state (docs/live.md), in no language.
Needs matplotlib, which the tests install.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

MAGNIFIED = 20
COLOURS = {"pass": "#0072B2", "fail": "#D55E00", "inconclusive": "#E69F00"}  # apart for colour-blind eyes, too


def draw_pose(axes: Any, column: dict[str, Any], name: str, title: str) -> None:
    """The foot seen from above, with every bar's distance from its sleeve magnified."""
    pose = column["trial_assembly"][name]
    width, depth = column["size_mm"]
    axes.add_patch(Rectangle((-width / 2, -depth / 2), width, depth, fill=False, color="0.6"))
    places = {point["label"]: point["aligned_mm"] for point in column["sleeves"]["points"]}
    for pair in pose["pairs"]:
        x, y = places[pair["sleeve"]][:2]
        dx, dy = pair["offset_mm"]
        colour = COLOURS.get(pair["verdict"], "0.4")
        axes.add_patch(Circle((x, y), 3.0 * MAGNIFIED, fill=False, linestyle=":", color="0.6"))
        axes.plot(x, y, "+", color="0.3", markersize=9)
        axes.annotate(
            "",
            (x + dx * MAGNIFIED, y + dy * MAGNIFIED),
            (x, y),
            arrowprops={"arrowstyle": "->", "color": colour, "lw": 2, "shrinkA": 0, "shrinkB": 0},
        )
        axes.text(x, y - 88, f"{pair['sleeve']}  {pair['distance_mm']:.2f} mm", ha="center", fontsize=8, color=colour)
    axes.set_title(f"{title}: largest distance {pose['max_mm']:.2f} mm", fontsize=11)
    axes.set_xlim(-width / 2 - 40, width / 2 + 40)
    axes.set_ylim(-depth / 2 - 60, depth / 2 + 40)
    axes.set_aspect("equal")
    axes.axis("off")


def main(report: Path, column_id: str, picture: Path) -> None:
    """Draw least squares beside minimax for one column."""
    columns = json.loads(report.read_text(encoding="utf-8"))["columns"]
    column = next(entry for entry in columns if entry["id"] == column_id)
    figure = Figure(figsize=(11, 5.6))
    left, right = figure.subplots(1, 2)
    draw_pose(left, column, "least_squares", "Least squares")
    draw_pose(right, column, "minimax", "Minimax")
    figure.suptitle(
        f"Column {column_id}, foot seen from above. Arrows: bar against sleeve, {MAGNIFIED} times magnified; "
        "dotted: the limit of 3 mm. Synthetic scans.",
        fontsize=9,
    )
    figure.tight_layout()
    figure.savefig(picture, dpi=110, metadata={"Software": None})


def draw_signs(picture: Path) -> None:
    """The foot C beside its bars B from above, and the move that brings it there: signs and frame of the state."""
    move, side = np.array([120.0, 50.0]), 400.0
    yaw = np.radians(12.0)  # what is drawn is larger than life
    turn = np.array([[np.cos(yaw), np.sin(yaw)], [-np.sin(yaw), np.cos(yaw)]])  # still to be turned: clockwise off
    ring = np.array([[x, y] for x in (-1.0, 0.0, 1.0) for y in (-1.0, 0.0, 1.0) if x or y]) * 0.38 * side
    corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * side / 2.0
    figure = Figure(figsize=(6.4, 5.2))
    axes = figure.subplots()
    for place in ring:
        axes.add_patch(Circle(place, 11.0, color=COLOURS["pass"]))
        axes.add_patch(Circle(place @ turn.T - move, 18.0, fill=False, color=COLOURS["fail"], lw=1.5))
    axes.add_patch(Polygon(corners @ turn.T - move, fill=False, color=COLOURS["fail"], lw=2))
    plain = {"arrowstyle": "-|>", "color": "0.2", "lw": 1.4, "shrinkA": 0, "shrinkB": 0}
    bold = {**plain, "color": COLOURS["inconclusive"], "lw": 3}
    for end, name in (((330.0, 0.0), "x"), ((0.0, 300.0), "y")):
        axes.annotate("", end, (0.0, 0.0), arrowprops=plain)
        axes.text(end[0] + 12, end[1] + 4, name, fontsize=13)
    axes.annotate("", (0.0, -move[1]), -move, arrowprops=bold)
    axes.annotate("", (0.0, 0.0), (0.0, -move[1]), arrowprops=bold)
    axes.text(-move[0] / 2, -move[1] - 14, "+Dx_mm", ha="center", va="top", fontsize=11)
    axes.text(10, -move[1] / 2, "+Dy_mm", va="center", fontsize=11)
    bow = {**bold, "connectionstyle": "arc3,rad=0.25"}
    begin, end = (np.array([np.cos(a), np.sin(a)]) * 310.0 - move for a in np.radians([-34.0, -6.0]))
    axes.annotate("", end, begin, arrowprops=bow)
    axes.annotate("+Yaw_deg", end, xytext=(10, -10), textcoords="offset points", fontsize=11)
    for place, name, colour in ((ring[-1], "B", "pass"), (corners[3] @ turn.T - move, "C", "fail")):
        beside = {"xytext": (-24 if name == "C" else 14, 8), "textcoords": "offset points", "weight": "bold"}
        axes.annotate(name, place, color=COLOURS[colour], fontsize=14, **beside)
    axes.set(xlim=(-400, 380), ylim=(-330, 330), aspect="equal")
    axes.axis("off")
    figure.tight_layout()
    figure.savefig(picture, dpi=100, metadata={"Software": None})


if __name__ == "__main__":
    images = Path(__file__).parent / "images"
    if sys.argv[1:]:
        main(Path(sys.argv[1]), sys.argv[2], images / "trial-assembly.png")
    else:
        draw_signs(images / "signs.png")
