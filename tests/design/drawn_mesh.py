"""A column and its bars as triangles, drawn where the truth is known: for meshes and for clouds of a design."""

import numpy as np
import trimesh

from aadm_workbench.model import Array, ColumnDesign

RING = [(x, y) for x in (-240, -80, 80, 240) for y in (-240, -80, 80, 240) if max(abs(x), abs(y)) == 240]
BORE_MM, BAR_MM, TOP_MM = 36.0, 20.0, 160.0


def placed(turn_deg: float = 20.0, at: tuple[float, float, float] = (1234.5, -876.5, 250.0)) -> Array:
    """Where the column's foot stands (4, 4)."""
    T: Array = trimesh.transformations.rotation_matrix(np.radians(turn_deg), [0, 0, 1])
    T[:3, 3] = at
    return T


def cylinder(x: float, y: float, low: float, high: float, diameter: float, sides: int = 48) -> trimesh.Trimesh:
    """Upright, its vertices on the circle."""
    part = trimesh.creation.cylinder(radius=diameter / 2.0, height=high - low, sections=sides)
    part.apply_translation([x, y, (low + high) / 2.0])
    return part


def cone(x: float, y: float, wide: float, narrow: float, high: float) -> trimesh.Trimesh:
    """The lead-in of a mouth."""
    outline = [[0.0, 0.0], [wide / 2.0, 0.0], [narrow / 2.0, high], [0.0, high]]
    part = trimesh.creation.revolve(outline, sections=48)
    part.apply_translation([x, y, 0.0])
    return part


def concrete(chamfer: float = 0.0) -> trimesh.Trimesh:
    """A block with sleeves' holes, grout inlets into them, and sockets in its head."""
    block = trimesh.creation.box(bounds=[[-300, -300, 0], [300, 300, 3000]])
    tools = [cylinder(x, y, -50.0, 310.0, BORE_MM) for x, y in RING]
    tools += [cylinder(x, 0.0, 2800.0, 3100.0, 40.0) for x in (-150.0, 150.0)]
    for x, y in RING:
        if abs(x) == 240:
            inlet = trimesh.creation.cylinder(radius=10.0, height=200.0, sections=24)
            inlet.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2.0, [0, 1, 0]))
            inlet.apply_translation([np.sign(x) * 340.0, y, 60.0])
            tools.append(inlet)
    if chamfer:
        tools += [cone(x, y, BORE_MM + 2.0 * chamfer, BORE_MM, chamfer) for x, y in RING]
    return trimesh.boolean.difference([block, *tools], engine="manifold")


def bars() -> list[trimesh.Trimesh]:
    """Twelve bars into the sleeves."""
    return [cylinder(x, y, TOP_MM - 560.0, TOP_MM, BAR_MM) for x, y in RING]


def worst_mm(column: ColumnDesign, T: Array, *, bars_too: bool = True) -> dict[str, float]:
    """Largest errors: of sleeves' and bars' centres in the plane and in height, and of their diameters, mm."""
    assert column.T_model_column is not None
    back = np.linalg.inv(T) @ column.T_model_column
    worst: dict[str, float] = {}
    kinds = [("sleeve", column.sleeves, 0.0, BORE_MM)]
    if bars_too:
        kinds.append(("bar", column.rebars, TOP_MM, BAR_MM))
    for kind, points, level, diameter_mm in kinds:
        found = np.array([(back @ [*point.centre, 1.0])[:3] for point in points])
        apart_mm = np.linalg.norm(found[:, np.newaxis, :2] - np.array(RING, dtype=float), axis=2)
        assert sorted(apart_mm.argmin(axis=1)) == list(range(12)), f"each {kind} once"
        worst[kind] = float(apart_mm.min(axis=1).max())
        worst[f"{kind} height"] = float(np.abs(found[:, 2] - level).max())
        worst[f"{kind} diameter"] = max(abs(point.diameter_mm - diameter_mm) for point in points)
    return worst
