"""Shapes and objects that the scenes of freecad_author are made of; runs inside FreeCAD."""

import math

import FreeCAD as App
import Part

V = App.Vector
SIZE, HEIGHT, BORE, DEPTH, OUTER = 600.0, 3000.0, 36.0, 310.0, 48.0
BAR, BAR_LENGTH, TOP = 20.0, 560.0, 160.0
RING = [
    (x, y) for x in (-240.0, -80.0, 80.0, 240.0) for y in (-240.0, -80.0, 80.0, 240.0) if max(abs(x), abs(y)) == 240.0
]


def turned(x=0.0, y=0.0, z=0.0, degrees=0.0):
    return App.Placement(V(x, y, z), App.Rotation(V(0, 0, 1), degrees))


def matrix(placement):
    m = placement.toMatrix()
    return [[getattr(m, f"A{r}{c}") for c in range(1, 5)] for r in range(1, 5)]


def truth(*placements, bars=True, bore=BORE, bar=BAR):
    """Foot frames of the columns, and what stands where in them."""
    return {
        "columns": [matrix(p) for p in placements],
        "ring": RING,
        "bore_mm": bore,
        "bar_mm": bar if bars else None,
        "top_mm": TOP,
    }


def block(holes=True, chamfer=0.0):
    """The concrete: a box with sleeves' holes, vents across them, and lifting sockets in its head."""
    shape = Part.makeBox(SIZE, SIZE, HEIGHT, V(-SIZE / 2, -SIZE / 2, 0))
    if not holes:
        return shape
    tools = [Part.makeCylinder(BORE / 2, DEPTH, V(x, y, 0)) for x, y in RING]
    for x, y in RING:  # grout inlet and outlet, from the nearest side into the sleeve
        out = V(math.copysign(1, x), 0, 0) if abs(x) == 240.0 else V(0, math.copysign(1, y), 0)
        tools += [Part.makeCylinder(10.0, 200.0, V(x, y, z), out) for z in (40.0, 280.0)]
    tools += [Part.makeCylinder(20.0, 200.0, V(x, 0, HEIGHT - 200.0)) for x in (-150.0, 150.0)]
    if chamfer:
        tools += [Part.makeCone(BORE / 2 + chamfer, BORE / 2, chamfer, V(x, y, 0)) for x, y in RING]
    return shape.cut(tools)


def bar_shape(x=0.0, y=0.0, top=TOP):
    return Part.makeCylinder(BAR / 2, BAR_LENGTH, V(x, y, top - BAR_LENGTH))


def tube_shape():
    return Part.makeCylinder(OUTER / 2, DEPTH).cut(Part.makeCylinder(BORE / 2, DEPTH))


def feature(doc, name, shape, label=None, placement=None, parent=None):
    obj = doc.addObject("Part::Feature", name)
    obj.Shape = shape
    obj.Label = label or name
    if placement is not None:
        obj.Placement = placement
    if parent is not None:
        parent.addObject(obj)
    return obj


def moved(shape, placement):
    """A copy whose coordinates are changed, without a placement, as importers leave it."""
    copy = shape.copy()
    copy.transformShape(placement.toMatrix(), True)
    return copy.copy()


def halved_tube():
    """A tube of two halves of its walls."""
    faces = []
    for radius in (OUTER / 2, BORE / 2):
        arcs = [Part.Arc(V(radius, 0, 0), V(0, s * radius, 0), V(-radius, 0, 0)).toShape() for s in (1, -1)]
        faces.append(Part.Face(Part.Wire(arcs)))
    return faces[0].cut(faces[1]).extrude(V(0, 0, DEPTH))


def told(obj, ifc_type, **properties):
    obj.addProperty("App::PropertyString", "IfcType")
    obj.IfcType = ifc_type
    for name, value in properties.items():
        text(obj, name, value)


def text(obj, name, value):
    obj.addProperty("App::PropertyString", name)
    setattr(obj, name, value)


def group_object(doc, name, label, ifc_class, parent=None):
    obj = doc.addObject("Part::FeaturePython", name)
    obj.addProperty("App::PropertyLinkList", "Group")
    obj.Label = label
    text(obj, "IfcClass", ifc_class)
    if parent is not None:
        parent.Group = [*parent.Group, obj]
    return obj
