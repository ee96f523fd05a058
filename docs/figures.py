"""Draws the pictures of the README from a report: python docs/figures.py build/demo-report/report.json C-303.

Needs matplotlib, which the tests install.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

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


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2], Path(__file__).parent / "images" / "trial-assembly.png")
