"""Meshes: STL, OBJ, PLY; whole or torn, chamfered, in any unit that is declared."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from aadm_workbench.design.read import read_model
from aadm_workbench.errors import DesignError
from tests.design.drawn_mesh import BORE_MM, bars, concrete, cylinder, placed, worst_mm

EXACT_MM = 0.001
STL_MM = 0.002
"""STL keeps 24 bits: a step of 0.0002 mm at 3 m."""


@pytest.fixture(scope="module")
def parts() -> list[trimesh.Trimesh]:
    """Concrete with chamfered mouths, and its bars, in their places."""
    found = [concrete(chamfer=2.0), *bars()]
    for part in found:
        part.apply_transform(placed())
    return found


def save(path: Path, parts: list[trimesh.Trimesh], scale: float = 1.0) -> Path:
    whole = trimesh.util.concatenate(parts)
    whole.apply_scale(scale)
    whole.export(path)
    return path


@pytest.mark.parametrize("name", ["a.stl", "a.ply", "a.obj", "A.STL"])
def test_every_format_gives_the_truth(tmp_path: Path, parts: list[trimesh.Trimesh], name: str) -> None:
    model = read_model(save(tmp_path / name, parts))
    (column,) = model.columns
    worst = worst_mm(column, placed())
    assert max(worst.values()) < STL_MM, worst
    assert column.size_mm == pytest.approx((600.0, 600.0), abs=0.01)
    assert len(column.rebars) == 12
    assert not model.loose_rebars


def test_names_of_an_obj_file_are_known(tmp_path: Path, parts: list[trimesh.Trimesh]) -> None:
    path = tmp_path / "a.obj"
    lines, passed = [], 0
    for name, part in zip(["C-301_柱", *[f"连接钢筋_{k}" for k in range(12)]], parts, strict=True):
        lines += [f"o {name}", *(f"v {x!r} {y!r} {z!r}" for x, y, z in part.vertices.tolist())]
        lines += [f"f {a} {b} {c}" for a, b, c in (part.faces + passed + 1).tolist()]
        passed += len(part.vertices)
    path.write_text("\n".join(lines), encoding="utf-8")
    (column,) = read_model(path).columns
    assert column.id == "C-301_柱"
    assert "连接钢筋" in column.rebars[0].why
    assert max(worst_mm(column, placed()).values()) < EXACT_MM


def test_a_torn_mesh_gives_the_same(tmp_path: Path, parts: list[trimesh.Trimesh]) -> None:
    whole = trimesh.util.concatenate(parts)
    kept = np.arange(len(whole.faces)) % 29 != 0
    torn = trimesh.Trimesh(whole.vertices, whole.faces[kept], process=False)
    assert not torn.is_watertight
    torn.export(tmp_path / "a.ply")
    (column,) = read_model(tmp_path / "a.ply").columns
    worst = worst_mm(column, placed(), bars_too=False)
    assert max(worst.values()) < STL_MM, worst


def test_a_mesh_turned_inside_out_gives_the_same(tmp_path: Path, parts: list[trimesh.Trimesh]) -> None:
    whole = trimesh.util.concatenate(parts)
    trimesh.Trimesh(whole.vertices, whole.faces[:, ::-1], process=False).export(tmp_path / "a.ply")
    (column,) = read_model(tmp_path / "a.ply").columns
    assert max(worst_mm(column, placed()).values()) < STL_MM


def test_a_leaning_sleeve_meets_the_foot_where_its_axis_does(tmp_path: Path) -> None:
    block = trimesh.creation.box(bounds=[[-300, -300, 0], [300, 300, 3000]])
    tools = []
    for x, y in [(-200, -200), (200, -200), (200, 200), (-200, 200)]:
        tool = trimesh.creation.cylinder(radius=BORE_MM / 2.0, height=700.0, sections=64)
        tool.apply_transform(trimesh.transformations.rotation_matrix(np.radians(1.5), [1, 0, 0]))
        tool.apply_translation([x, y, 0.0])
        tools.append(tool)
    trimesh.boolean.difference([block, *tools], engine="manifold").export(tmp_path / "a.ply")
    (column,) = read_model(tmp_path / "a.ply").columns
    assert column.T_model_column is not None
    for sleeve in column.sleeves:
        at = (column.T_model_column @ [*sleeve.centre, 1.0])[:3]
        assert np.abs(at) == pytest.approx([200.0, 200.0, 0.0], abs=0.01)
        assert np.degrees(np.arccos(sleeve.axis[2])) == pytest.approx(1.5, abs=0.01)
        assert sleeve.diameter_mm == pytest.approx(BORE_MM, abs=0.01)


@pytest.mark.parametrize(("units", "mm"), [("m", 1000.0), ("inch", 25.4), ("cm", 10.0)])
def test_units_are_declared(tmp_path: Path, parts: list[trimesh.Trimesh], units: str, mm: float) -> None:
    path = save(tmp_path / "a.ply", [part.copy() for part in parts], 1.0 / mm)
    with pytest.raises(
        DesignError, match=rf"declared in mm, so it measures .* in {units} it holds one with 12 sleeves"
    ):
        read_model(path)
    (column,) = read_model(path, units=units).columns
    assert max(worst_mm(column, placed()).values()) < 0.01


def test_a_mesh_of_no_columns_size_is_refused(tmp_path: Path) -> None:
    trimesh.creation.box(extents=[5.0, 2.5, 1.4]).export(tmp_path / "a.stl")
    with pytest.raises(DesignError, match=r"measures 5 x 2\.5 x 1\.4 mm: no column has that size"):
        read_model(tmp_path / "a.stl")


def test_a_unit_that_is_none_is_said(tmp_path: Path) -> None:
    trimesh.creation.box(extents=[500.0, 500.0, 500.0]).export(tmp_path / "a.stl")
    with pytest.raises(DesignError, match="the unit of models is 'yard'"):
        read_model(tmp_path / "a.stl", units="yard")


def test_a_block_without_holes_has_no_column(tmp_path: Path) -> None:
    trimesh.creation.box(extents=[600.0, 600.0, 3000.0]).export(tmp_path / "a.stl")
    model = read_model(tmp_path / "a.stl")
    assert not model.columns
    assert not model.loose_sleeves


def test_bars_alone_are_loose(tmp_path: Path) -> None:
    model = read_model(save(tmp_path / "a.stl", bars()))
    assert not model.columns
    assert len(model.loose_rebars) == 12
    tops = np.array([point.centre for point in model.loose_rebars])
    assert tops[:, 2] == pytest.approx(np.full(12, 160.0), abs=STL_MM)


def test_lying_tubes_are_no_bars(tmp_path: Path) -> None:
    rod = cylinder(0.0, 0.0, -300.0, 300.0, 20.0)
    rod.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2.0, [0, 1, 0]))
    model = read_model(save(tmp_path / "a.stl", [rod]))
    assert not model.loose_rebars


BROKEN = {
    "a.stl": b"\0" * 80 + (10**9).to_bytes(4, "little") + b"\0" * 50,
    "b.stl": b"solid x\n facet normal 0 0 1\n",
    "c.ply": b"ply\nformat binary_little_endian 1.0\nelement vertex 99999999\nproperty float x\nend_header\n",
    "d.ply": b"not a ply",
    "e.obj": b"v 0 0 0\nv 1 0 0\nf 1 2 99\n",
    "f.obj": b"v 0 0 0\n",
    "g.stl": b"PK\x03\x04",
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_files_are_refused_by_name(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_bytes(BROKEN[name])
    with pytest.raises(DesignError, match=name.replace(".", r"\.")):
        read_model(tmp_path / name)
