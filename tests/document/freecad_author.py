"""Writes FreeCAD documents as people and importers make them, each with the truth; runs inside FreeCAD.

All draw the same: a square foot of 600 mm on a ring of twelve sleeves of 36 mm, twelve bars of 20 mm under it whose
tops are 160 mm above the foot, and what must be taken for neither. They differ in how it is drawn.
"""

import Arch
import Draft
import FreeCAD as App
import Part
from freecad_imports import imported, meshes, native
from freecad_shapes import (
    BAR,
    BAR_LENGTH,
    BORE,
    DEPTH,
    HEIGHT,
    OUTER,
    RING,
    SIZE,
    TOP,
    V,
    bar_shape,
    block,
    feature,
    moved,
    truth,
    tube_shape,
    turned,
)


def arch(doc):
    """Arch structures with subtractions, Arch rebars, storeys; turned, far from the origin."""
    at = [turned(5000.0, 2000.0, 7200.0), turned(12000.0, 2000.0, 7200.0, 30.0)]
    upper, lower = Arch.makeFloor([]), Arch.makeFloor([])
    upper.Label, lower.Label = "3F", "2F"
    upper.Placement.Base = V(0, 0, 7200.0)
    for number, place in enumerate(at):
        column = (_with_subtractions if number == 0 else _on_a_base)(doc, place)
        column.Label, column.IfcType, column.Tag = "预制柱", "Column", f"C-{301 + number}"
        upper.addObject(column)
        for k, (x, y) in enumerate(RING):
            if k % 4 == 0:
                sketch = doc.addObject("Sketcher::SketchObject", "BarPath")
                foot = place.multiply(turned(x, y, TOP - BAR_LENGTH))
                sketch.Placement = foot.multiply(App.Placement(V(0, 0, 0), App.Rotation(V(1, 0, 0), 90)))
                sketch.addGeometry(Part.LineSegment(V(0, 0, 0), V(0, BAR_LENGTH, 0)))
                base = sketch
            else:  # of an L, bent over below
                foot = place.multiply(turned(x, y, 0.0))
                ends = [V(200, 0, TOP - BAR_LENGTH), V(0, 0, TOP - BAR_LENGTH), V(0, 0, TOP)]
                base = Draft.make_wire([foot.multVec(end) for end in ends])
            doc.recompute()
            rebar = Arch.makeRebar(None, base, diameter=BAR, amount=1, name=f"连接钢筋 {k}")
            rebar.Rounding, rebar.OffsetStart, rebar.OffsetEnd = 2.0, 0.0, 0.0
            lower.addObject(rebar)
        tie = Draft.make_wire(
            [place.multVec(V(x, y, 100.0)) for x, y in ((-260, -260), (260, -260), (260, 260), (-260, 260))],
            closed=True,
        )
        doc.recompute()
        stirrup = Arch.makeRebar(None, tie, diameter=10.0, amount=1, name="箍筋 Stirrup")
        upper.addObject(stirrup)
    doc.recompute()
    return truth(*at)


def _with_subtractions(doc, place):
    column = Arch.makeStructure(length=SIZE, width=SIZE, height=HEIGHT)
    column.Placement = place
    tools = []
    for x, y in RING:
        tool = doc.addObject("Part::Cylinder", "Hole")
        tool.Radius, tool.Height = BORE / 2, DEPTH
        tool.Placement = place.multiply(turned(x, y, 0.0))
        tools.append(tool)
    doc.recompute()
    Arch.removeComponents(tools, column)
    return column


def _on_a_base(doc, place):
    """FreeCAD 0.20 subtracts from turned structures in the wrong place, so this one has its holes from its base."""
    base = feature(doc, "Base", block(), placement=place)
    doc.recompute()
    return Arch.makeStructure(base)


def part(doc):
    """Part primitives and booleans, chamfered mouths, vents; bars as cylinders in a named group; everything unnamed."""
    at = turned(0.0, 0.0, 0.0, 0.0)
    box = doc.addObject("Part::Box", "Box")
    box.Length = box.Width = SIZE
    box.Height = HEIGHT
    box.Placement.Base = V(-SIZE / 2, -SIZE / 2, 0)
    tools = []
    for x, y in RING:
        hole = doc.addObject("Part::Cylinder", "Cylinder")
        hole.Radius, hole.Height, hole.Placement.Base = BORE / 2, DEPTH, V(x, y, 0)
        lead = doc.addObject("Part::Cone", "Cone")
        lead.Radius1, lead.Radius2, lead.Height, lead.Placement.Base = BORE / 2 + 3, BORE / 2, 3.0, V(x, y, 0)
        vent = doc.addObject("Part::Cylinder", "Vent")
        vent.Radius, vent.Height = 8.0, 400.0
        vent.Placement = App.Placement(V(x, y, 60.0), App.Rotation(V(0, 1, 0), 90 if x > 0 else -90))
        tools += [hole, lead, vent]
    fusion = doc.addObject("Part::MultiFuse", "Fusion")
    fusion.Shapes = tools
    cut = doc.addObject("Part::Cut", "Cut")
    cut.Base, cut.Tool = box, fusion
    group = doc.addObject("App::DocumentObjectGroup", "Group")
    group.Label = "Starter bars"
    for x, y in RING:
        bar = doc.addObject("Part::Cylinder", "Stab")
        bar.Radius, bar.Height, bar.Placement.Base = BAR / 2, BAR_LENGTH, V(x, y, TOP - BAR_LENGTH)
        group.addObject(bar)
    doc.recompute()
    return truth(at)


def part_design(doc):
    """Bodies with pad, pocket and pattern; each feature keeps a shape of its own; nested App::Part placements."""
    outer = doc.addObject("App::Part", "Storey")
    outer.Placement = turned(1000.0, 2000.0, 3000.0, 20.0)
    inner = doc.addObject("App::Part", "Unit")
    inner.Label = "C-301"
    inner.Placement = turned(300.0, -100.0, 0.0, 25.0)
    outer.addObject(inner)
    body = doc.addObject("PartDesign::Body", "Body")
    inner.addObject(body)
    sketch = body.newObject("Sketcher::SketchObject", "Sketch")
    corners = [V(-300, -300, 0), V(300, -300, 0), V(300, 300, 0), V(-300, 300, 0)]
    for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
        sketch.addGeometry(Part.LineSegment(start, end))
    pad = body.newObject("PartDesign::Pad", "Pad")
    pad.Profile, pad.Length = sketch, HEIGHT
    doc.recompute()
    circles = body.newObject("Sketcher::SketchObject", "Sketch001")
    for x, y in RING:
        circles.addGeometry(Part.Circle(V(x, y, 0), V(0, 0, 1), BORE / 2))
    pocket = body.newObject("PartDesign::Pocket", "Pocket")
    pocket.Profile, pocket.Length, pocket.Reversed = circles, DEPTH, True
    doc.recompute()
    for x, y in RING:
        bar = doc.addObject("PartDesign::Body", "BarBody")
        bar.Label = "Connecting rebar"
        inner.addObject(bar)
        disk = bar.newObject("Sketcher::SketchObject", "Disk")
        disk.addGeometry(Part.Circle(V(0, 0, 0), V(0, 0, 1), BAR / 2))
        rod = bar.newObject("PartDesign::Pad", "Rod")
        rod.Profile, rod.Length = disk, BAR_LENGTH
        bar.Placement = turned(x, y, TOP - BAR_LENGTH)
    doc.recompute()
    assert len(body.Shape.Faces) == 6 + 24, body.Shape.Faces
    return truth(outer.Placement.multiply(inner.Placement))


def links(doc):
    """One column and one bar drawn once, all else links: to a part, mirrored, arrays of both kinds, clones."""
    library = doc.addObject("App::Part", "Library")
    library.Label = "PCZ-1"
    library.Placement = turned(-50000.0, 0.0, 0.0, 10.0)
    feature(doc, "Concrete", block(holes=False), "预制柱", parent=library)
    sleeve = feature(doc, "Sleeve", tube_shape(), "灌浆套筒 GTQ4Z-20")
    sleeve.Visibility = False
    ring = doc.addObject("App::Link", "Sleeves")
    ring.LinkedObject, ring.ElementCount, ring.ShowElement = sleeve, 12, False
    ring.PlacementList = [turned(x, y, 0.0, 15.0) for x, y in RING]
    library.addObject(ring)
    library.Visibility = False
    bar = feature(doc, "Bar", Part.makeCylinder(BAR / 2, BAR_LENGTH, V(0, 0, -BAR_LENGTH)), "连接钢筋")
    bar.Placement = turned(7.0, 8.0, 9.0, 33.0)
    bar.Visibility = False
    at = [turned(0.0, 0.0, 4000.0), turned(6000.0, 0.0, 4000.0, 90.0), turned(12000.0, 0.0, 4000.0, 40.0)]
    for number, place in enumerate(at):
        link = doc.addObject("App::Link", "Column")
        link.Label = f"C-{401 + number}"
        link.LinkedObject, link.Placement = library, place
    mirrored = doc.addObject("App::Link", "Column")
    mirrored.Label = "C-404"
    mirrored.LinkedObject, mirrored.Placement, mirrored.ScaleVector = library, turned(18000.0, 0.0, 4000.0), V(-1, 1, 1)
    at.append(mirrored.Placement)
    tops = [turned(x, y, TOP) for x, y in RING]
    hidden = doc.addObject("App::Link", "BarsHiddenElements")
    hidden.LinkedObject, hidden.ElementCount, hidden.ShowElement = bar, 12, False
    hidden.Placement, hidden.PlacementList = at[0], tops
    shown = doc.addObject("App::Link", "BarsShownElements")
    shown.LinkedObject, shown.ElementCount, shown.ShowElement = bar, 12, True
    doc.recompute()
    shown.Placement = at[1]
    for element, top in zip(shown.ElementList, tops, strict=True):
        element.Placement = top
    group = doc.addObject("App::DocumentObjectGroup", "Clones")
    for top in tops:
        clone = Draft.make_clone(bar)
        clone.Placement = at[2].multiply(top)
        group.addObject(clone)
    single = [doc.addObject("App::Link", "OneBar") for _ in tops]
    for link, top in zip(single, tops, strict=True):
        link.LinkedObject, link.Placement = bar, at[3].multiply(top)
    again = doc.addObject("App::Link", "TheSameBarsAgain")
    again.LinkedObject, again.Placement = group, turned()
    doc.recompute()
    return truth(*at)


def arrays(doc):
    """Draft arrays of bars with links and without, a mirrored half, and a compound of all sleeves."""
    at = turned(0.0, 0.0, 0.0)
    feature(doc, "Column", block(holes=False), "Column 7")
    tubes = []
    for x, y in RING:
        tubes.append(feature(doc, "Tube", tube_shape(), "Tube", turned(x, y, 0.0)))
    compound = doc.addObject("Part::Compound", "Compound")
    compound.Links, compound.Label = tubes, "Grouting sleeves"
    row = feature(doc, "RowBar", bar_shape(-240.0, -240.0), "Dowel")
    Draft.make_ortho_array(row, v_x=V(160, 0, 0), v_y=V(0, 480, 0), v_z=V(0, 0, 0), n_x=4, n_y=2, n_z=1, use_link=True)
    side = feature(doc, "SideBar", bar_shape(-240.0, -80.0), "Dowel of the side")
    pair = Draft.make_ortho_array(
        side, v_x=V(0, 0, 0), v_y=V(0, 160, 0), v_z=V(0, 0, 0), n_x=1, n_y=2, n_z=1, use_link=False
    )
    mirror = doc.addObject("Part::Mirroring", "Mirror")
    mirror.Source, mirror.Normal, mirror.Base = pair, V(1, 0, 0), V(0, 0, 0)
    mirror.Label = "Dowels mirrored"
    doc.recompute()
    return truth(at)


def features(doc):
    """Ribbed and tapered sleeves, fillets at mouths and bar ends, chamfered bars; groups in parts, parts in groups."""
    building = Arch.makeFloor([])
    building.Label = "5F"
    unit = doc.addObject("App::Part", "Unit")
    unit.Label, unit.Placement = "C-701", turned(800.0, -700.0, 900.0, -25.0)
    building.addObject(unit)
    inner = doc.addObject("App::DocumentObjectGroup", "Embedded")
    inner.Label = "Grout sleeves"
    unit.addObject(inner)
    solid = block(holes=False)
    holes = [Part.makeCylinder(OUTER / 2, DEPTH, V(x, y, 0)) for x, y in RING]
    feature(doc, "Body", solid.cut(holes), "Concrete", parent=unit)
    outline = [V(24, 0, 0), V(18, 0, 0), V(18, 0, 100), V(16, 0, 102), V(16, 0, 110), V(18, 0, 112), V(18, 0, 200)]
    outline += [V(13, 0, 300), V(13, 0, DEPTH), V(24, 0, DEPTH), V(24, 0, 0)]
    ribbed = Part.Face(Part.makePolygon(outline)).revolve(V(0, 0, 0), V(0, 0, 1), 360)
    tube = tube_shape()
    rims = [e for e in tube.Edges if hasattr(e.Curve, "Radius") and abs(e.Curve.Radius - BORE / 2) < 1e-6]
    filleted = tube.makeFillet(2.0, [e for e in rims if e.BoundBox.ZMax < 1.0])
    for number, (x, y) in enumerate(RING):
        shape = filleted if number % 2 else ribbed
        inner.addObject(feature(doc, "Tube", shape, placement=turned(x, y, 0.0, 10.0 * number)))
    bars = doc.addObject("App::Part", "Starters")
    bars.Label, bars.Placement = "Starter bars", unit.Placement
    shelf = doc.addObject("App::DocumentObjectGroup", "Shelf")
    shelf.addObject(bars)
    for number, (x, y) in enumerate(RING):
        plain = bar_shape(x, y)
        top = [e for e in plain.Edges if hasattr(e.Curve, "Radius") and e.BoundBox.ZMin > TOP - 1.0]
        shape = (plain.makeChamfer(2.0, top), plain.makeFillet(3.0, top), plain)[number % 3]
        feature(doc, "Bar", shape, parent=bars)
    doc.recompute()
    return truth(unit.Placement)


def hidden(doc):
    """Everything hidden, as after saving what was opened without a screen."""
    found = part(doc)
    for obj in doc.Objects:
        obj.Visibility = False
    return found


def tilted(doc):
    """Baked into its coordinates: a turned column without a placement, lying sleeves' names, far from the origin."""
    at = turned(123456.789, -98765.432, 45678.9, 17.0)
    feature(doc, "Solid", moved(block(), at), "Solid")
    for x, y in RING:
        feature(doc, "Rod", moved(bar_shape(x, y), at), "Rod")
    return truth(at)


SCENES = {
    made.__name__: made
    for made in (arch, part, part_design, links, arrays, imported, native, meshes, features, hidden, tilted)
}


def can_draw(name):
    """FreeCAD 1.0 makes no Arch rebars where there is no window."""
    return name != "arch" or App.GuiUp or App.Version()[:2] != ["1", "0"]


def write(name, folder):
    """Save one scene; returns its path and the truth."""
    doc = App.newDocument(name)
    known = SCENES[name](doc)
    doc.recompute()
    path = str(folder / f"{name}.FCStd")
    doc.saveAs(path)
    App.closeDocument(doc.Name)
    return path, known
