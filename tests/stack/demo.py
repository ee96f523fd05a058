"""A floor with everything that a page of the tower has to say: six columns in two rows, five beams, one free."""

from pathlib import Path
from typing import Any

from aadm_workbench.model import Kind
from tests.stack.floors import HEIGHT_MM, FloorAuthor
from tests.stack.standing import Standing, report_of

HOSTILE = "<script>alert(1)</script>"
PLACES = {
    "C-1": (0.0, 0.0, 0.0),
    "C-2": (6000.0, 0.0, 0.0),
    "C-3": (12000.0, 0.0, 0.0),
    "C-4": (0.0, 7200.0, 0.0),
    "C-5": (6000.0, 7200.0, 0.0),
    HOSTILE: (12000.0, 7200.0, 0.0),
}


def demo_report() -> dict[str, Any]:
    """Tied to the grid but for C-5; C-3 does not go on, the last one has no bars yet."""
    return report_of(
        Standing("C-1", PLACES["C-1"], 0.0, (6.5, 1.0, 0.1)),
        Standing("C-2", PLACES["C-2"], 90.0, (-9.0, 2.0, 0.0)),
        Standing("C-3", PLACES["C-3"], off={"R1": (-3.6, -3.0), "R7": (3.6, 3.0)}),
        Standing("C-4", PLACES["C-4"], 0.0, (0.5, -1.0, 0.0)),
        Standing("C-5", PLACES["C-5"], 0.0, (3.0, 0.0, 0.0), {"R2": (1.0, 0.5)}, control_u_mm=None),
        Standing(HOSTILE, PLACES[HOSTILE], kinds=(Kind.SLEEVE,)),
        name="Floor 3, axes A to B",
    )


def demo_model(folder: Path) -> Path:
    """Beams between the columns, one that ends in the air, and none on the last column."""
    author = FloorAuthor(folder)
    for name, place in PLACES.items():
        author.standing(name, place)
    x, y, z = 250.0, 250.0, HEIGHT_MM
    author.beam("KL1", (x, 0.0, z), (6000.0 - x, 0.0, z))
    author.beam("KL2", (6000.0 + x, 0.0, z), (12000.0 - x, 0.0, z))
    author.beam("KL3", (0.0, y, z), (0.0, 7200.0 - y, z))
    author.beam("KL4", (x, 7200.0, z), (6000.0 - x, 7200.0, z))
    author.beam("KL5", (6000.0, 7200.0 + y, z), (6000.0, 10000.0, z))
    return author.write("demo.ifc")
