"""A small model as a BIM author would draw it in FreeCAD: text that the tests run inside it."""

MODEL = '''
import FreeCAD, Part
from FreeCAD import Placement, Rotation, Vector

RING = [(x, y) for x in (-240, -80, 80, 240) for y in (-240, -80, 80, 240) if max(abs(x), abs(y)) == 240]

def make_model(document, base, yaw_deg=90.0, height=900.0):
    """A column of 600 mm with twelve sleeves of 36 mm, over twelve bars of 20 mm, in its place in the building."""
    place = Placement(Vector(*base), Rotation(Vector(0, 0, 1), yaw_deg))
    body = Part.makeBox(600, 600, height, Vector(-300, -300, 0))
    holes = [Part.makeCylinder(18, 160, Vector(x, y, 0)) for x, y in RING]
    column = document.addObject("Part::Feature", "Column")
    column.Label = "C-302"
    column.Shape = body.cut(Part.makeCompound(holes))
    column.Placement = place
    bars = []
    for number, (x, y) in enumerate(RING, start=1):
        bar = document.addObject("Part::Feature", f"Rebar{number:03d}")
        bar.Label = f"Rebar {number}"
        bar.Shape = Part.makeCylinder(10, 560, Vector(x, y, -400))
        bar.Placement = place
        bars.append(bar)
    document.recompute()
    return column, bars
'''
