"""Documents as importers leave them: shapes with classes as properties, native IFC, meshes; runs inside FreeCAD."""

import Mesh
import Part
from freecad_shapes import (
    BORE,
    DEPTH,
    HEIGHT,
    RING,
    V,
    bar_shape,
    block,
    feature,
    group_object,
    halved_tube,
    moved,
    text,
    told,
    truth,
    tube_shape,
    turned,
)


def imported(doc):
    """As FreeCAD imports IFC: plain shapes with IfcType, one compound per product, also halves and splines."""
    at = turned(-4000.0, 1000.0, 0.0, 0.0)
    column = feature(doc, "Column", block(chamfer=1.0).copy(), "C-501")
    column.Shape = moved(column.Shape, at)
    told(column, "Column", GlobalId="2O2Fr$t4X7Zf8NOew3FLOH", Tag="C-501")
    for number, (x, y) in enumerate(RING):
        sleeve = feature(doc, "Sleeve", moved(halved_tube(), at.multiply(turned(x, y, 0.0))), "GTQ4Z-20")
        told(sleeve, "Discrete Accessory", GlobalId=f"{number:022d}")
        shape = bar_shape(x, y)
        if number % 3 == 0:
            shape = shape.toNurbs()
        elif number % 3 == 1:
            shape = Part.Compound([shape])
        told(feature(doc, "Bar", moved(shape, at), "B"), "Reinforcing Bar", GlobalId=f"B{number:021d}")
    lifting = feature(doc, "Socket", moved(tube_shape(), at.multiply(turned(0.0, 0.0, HEIGHT - DEPTH))), "吊装套筒")
    told(lifting, "Discrete Accessory")
    pipe = feature(doc, "Pipe", moved(tube_shape(), at.multiply(turned(0.0, 0.0, 0.0))), "防水套管 DN40")
    told(pipe, "Discrete Accessory")
    beam = feature(doc, "Beam", moved(block(), turned(9000.0, 0.0, 3000.0)), "Beam with holes")
    told(beam, "Beam")
    doc.recompute()
    return truth(at)


def native(doc):
    """Native IFC objects whose proxy is missing: classes in IfcClass, groups that repeat what they hold."""
    at = turned(300.0, 400.0, 500.0, 0.0)
    project = group_object(doc, "IfcProject", "Project", "IfcProject")
    storey = group_object(doc, "IfcStorey", "Level 3", "IfcBuildingStorey", project)
    column = group_object(doc, "IfcColumn", "Column", "IfcColumn", storey)
    column.Shape = moved(block(), at)
    text(column, "Tag", "C-601")
    text(column, "PieceMark", "PCZ-9")
    shapes = [column.Shape]
    for number, (x, y) in enumerate(RING):
        bar = group_object(doc, "IfcBar", "bar", "IfcReinforcingBar", storey)
        bar.Shape = moved(bar_shape(x, y), at)
        text(bar, "GlobalId", f"N{number:021d}")
        shapes.append(bar.Shape)
        opening = group_object(doc, "IfcOpening", "Opening", "IfcOpeningElement", column)
        opening.Shape = moved(Part.makeCylinder(BORE / 2, DEPTH, V(x, y, 0)), at)
    storey.Shape = Part.Compound(shapes)
    project.Shape = Part.Compound(shapes)
    doc.recompute()
    return truth(at)


def meshes(doc):
    """Mesh objects, as imported from STL, of which nothing is known but their triangles."""
    at = turned(100.0, 0.0, 0.0)

    def mesh(shape, label):
        obj = doc.addObject("Mesh::Feature", "Mesh")
        obj.Mesh = Mesh.Mesh(shape.tessellate(0.05))
        obj.Label = label
        return obj

    mesh(moved(block(), at), "Column mesh").Placement = turned()
    for x, y in RING:
        mesh(bar_shape(), "bar").Placement = at.multiply(turned(x, y, 0.0))
    return truth(at)
