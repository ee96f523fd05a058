"""Models of floors with beams, as several programs would draw them."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tests.design.authoring import Author

HEIGHT_MM, SIDE_MM = 3600.0, 600.0
BEAM_MM = (300.0, 600.0)


class FloorAuthor(Author):
    """Writes columns of 3,600 mm and beams that lie on their heads."""

    def standing(self, name: str, place: Sequence[float], height_mm: float = HEIGHT_MM, **attributes: Any) -> Any:
        profile = self.profile("IfcRectangleProfileDef", XDim=SIDE_MM, YDim=SIDE_MM)
        return self.element(
            "IfcColumn", [self.extrusion(profile, height_mm)], self.placement(None, place), Name=name, **attributes
        )

    def beam(
        self,
        name: str,
        start: Sequence[float],
        end: Sequence[float],
        ifc_class: str = "IfcBeam",
        faceted: bool = False,
        **attributes: Any,
    ) -> Any:
        """From start to end, the middles of the lower edges of its end faces."""
        way = np.subtract(end, start)
        length_mm = float(np.linalg.norm(way))
        along = way / length_mm
        width, depth = BEAM_MM
        across = np.cross([0.0, 0.0, 1.0], along)
        across /= np.linalg.norm(across)
        if faceted:
            # A body without a placement, as meshes are exported.
            up = np.cross(along, across)
            corners = [
                np.array(point) + side * width / 2.0 * across + rise * up
                for point in (start, end)
                for side, rise in ((-1, 0.0), (1, 0.0), (1, depth), (-1, depth))
            ]
            return self.element(ifc_class, [self._brick(corners)], self.placement(None), Name=name, **attributes)
        profile = self.profile("IfcRectangleProfileDef", XDim=width, YDim=depth)
        solid = self.extrusion(profile, length_mm, self.axes((0.0, depth / 2.0, 0.0)))
        return self.element(ifc_class, [solid], self.placement(None, start, along, across), Name=name, **attributes)

    def _brick(self, corners: Sequence[Any]) -> Any:
        points = self.new("IfcCartesianPointList3D", [[self.length(float(v)) for v in corner] for corner in corners])
        quads = [(1, 2, 3, 4), (8, 7, 6, 5), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 8, 4), (4, 8, 5, 1)]
        triangles = [[a, b, c] for a, b, c, _ in quads] + [[a, c, d] for a, _, c, d in quads]
        return self.new("IfcTriangulatedFaceSet", Coordinates=points, Closed=True, CoordIndex=triangles)

    def connect(self, first: Any, second: Any, ifc_class: str = "IfcRelConnectsElements", **attributes: Any) -> None:
        self.rooted(ifc_class, RelatingElement=first, RelatedElement=second, **attributes)


def two_columns(folder: Path, turned: bool = False) -> Path:
    """A at (0, 0), B at (6000, 0), or along the diagonal; one beam from face to face, 50 mm onto each."""
    author = FloorAuthor(folder)
    reach = np.array([0.6, 0.8, 0.0]) if turned else np.array([1.0, 0.0, 0.0])
    author.standing("A", (0.0, 0.0, 0.0))
    author.standing("B", 6000.0 * reach)
    top = np.array([0.0, 0.0, HEIGHT_MM])
    author.beam("KL1", top + 250.0 * reach, top + 5750.0 * reach)
    return author.write()
