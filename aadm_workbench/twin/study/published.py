"""What the paper reports for the extraction of assembly points before hoisting: its Tables 2 and 11.

Source: Long et al., *Automated alignment deviation measurement for precast concrete assembly using point cloud-image
fusion*, sections 3.2.1 (laboratory model, 12 sleeves and 12 rebars) and 4.1 (field column, the same number). Errors
are against a caliper in the laboratory and a tape in the field.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from aadm_workbench.model import Vector2


@dataclass(frozen=True)
class PublishedRow:
    """One method of a table: mean absolute error and its standard deviation (mm), and the time of one scan.

    Diameters are those of single features, spacings those of adjacent ones. ``method`` is what this product calls the
    method that the row is about.
    """

    method: str
    title: str
    rebar_diameter_mm: Vector2
    rebar_spacing_mm: Vector2
    sleeve_diameter_mm: Vector2
    sleeve_spacing_mm: Vector2
    rebar_s: float
    sleeve_s: float


@dataclass(frozen=True)
class PublishedTable:
    """One table of the paper; ``slips`` says where its numbers contradict others of the same paper."""

    title: str
    rows: tuple[PublishedRow, ...]
    slips: str


TABLES: Mapping[str, PublishedTable] = MappingProxyType(
    {
        "lab": PublishedTable(
            "Table 2, laboratory model",
            (
                PublishedRow(
                    "pointcloud",
                    "point cloud [11]",
                    (0.38, 0.21),
                    (0.56, 0.41),
                    (0.26, 0.15),
                    (0.45, 0.35),
                    0.221,
                    1.516,
                ),
                PublishedRow(
                    "image", "image [2]", (0.39, 0.19), (0.58, 0.35), (0.28, 0.14), (0.47, 0.31), 0.175, 0.201
                ),
                PublishedRow("fusion", "fusion", (0.32, 0.17), (0.53, 0.31), (0.22, 0.14), (0.43, 0.29), 0.407, 1.660),
            ),
            "The paper's Table 1 gives its own method the means of the row of the point cloud method: 0.38, 0.56, 0.26 "
            "and 0.45.",
        ),
        "field": PublishedTable(
            "Table 11, field column",
            (
                PublishedRow(
                    "pointcloud",
                    "point cloud [11]",
                    (0.71, 0.52),
                    (1.05, 0.92),
                    (0.52, 0.40),
                    (0.94, 0.63),
                    0.610,
                    3.430,
                ),
                PublishedRow(
                    "image", "image [2]", (0.82, 0.69), (1.12, 1.05), (0.59, 0.48), (1.13, 0.78), 0.445, 0.463
                ),
                PublishedRow("fusion", "fusion", (0.65, 0.27), (0.83, 0.75), (0.49, 0.38), (0.73, 0.37), 0.850, 3.780),
            ),
            "For the rebar spacing of fusion the text gives a mean of 0.75 and a root mean square of 0.83, the "
            "interval of Table 10 belongs to a standard deviation of 0.35.",
        ),
    }
)
"""By the name of the setting."""
