"""Pictures as scanners' programs save them: tags of orientation, several pages, other packings, colours, X Y Z.

tifffile writes them, so that another program's idea of the format is what is read.
"""

import contextlib
import importlib
import io
import struct
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tifffile

from aadm_workbench.errors import AadmError, MissingDependencyError, ScanError
from aadm_workbench.model import Array, Camera, FloatArray
from aadm_workbench.scan.file import load
from aadm_workbench.scan.formats import packed_tiff
from aadm_workbench.scan.picture import grey_of
from aadm_workbench.scan.read import read_scan

STEP_MM = 0.02


@pytest.fixture
def steps(depth_mm: Array) -> Array:
    return np.rint(np.nan_to_num(depth_mm) / STEP_MM).astype(np.uint16)


def points_of(path: Path, camera: Camera, **declared: Any) -> FloatArray:
    return read_scan(path, camera=camera, depth_scale_mm=STEP_MM, **declared).points


@pytest.mark.parametrize("orientation", range(1, 9))
@pytest.mark.parametrize("form", [{}, {"bigtiff": True}, {"byteorder": ">"}, {"compression": "zstd"}])
def test_pixels_stay_where_they_are_stored_whatever_the_orientation(
    tmp_path: Path, camera: Camera, steps: Array, orientation: int, form: dict[str, Any]
) -> None:
    path = tmp_path / "scan.tiff"
    tifffile.imwrite(path, steps, **form)
    plain = points_of(path, camera)
    tifffile.imwrite(path, steps, extratags=[(274, "H", 1, orientation, True)], **form)
    scan = read_scan(path, camera=camera, depth_scale_mm=STEP_MM)
    np.testing.assert_array_equal(scan.points, plain)
    assert (orientation != 1) == any(f"orientation ({orientation})" in note for note in scan.notes)


@pytest.mark.parametrize("orientation", range(2, 9))
def test_grey_pictures_stay_as_they_are_stored(tmp_path: Path, orientation: int) -> None:
    grey = np.arange(48 * 64, dtype=np.uint8).reshape(48, 64)
    tifffile.imwrite(tmp_path / "a.tif", grey, extratags=[(274, "H", 1, orientation, True)])
    np.testing.assert_array_equal(grey_of(load(tmp_path / "a.tif", "a")), grey)


@pytest.mark.parametrize(
    "form",
    [
        {"compression": name, "predictor": predictor}
        for name in ("zstd", "lzma", "deflate", "lzw")
        for predictor in (False, True)
    ]
    + [{"compression": "lerc"}, {"compression": "packbits"}, {"compression": "zstd", "tile": (16, 32)}],
)
@pytest.mark.parametrize("dtype", [np.uint16, np.float32])
def test_packings(
    tmp_path: Path, camera: Camera, steps: Array, form: dict[str, Any], dtype: Any, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "scan.tiff"
    values = steps if dtype is np.uint16 else (steps * STEP_MM).astype(dtype)
    tifffile.imwrite(path, values, **form)
    np.testing.assert_allclose(np.nan_to_num(points_of(path, camera)[..., 2]), steps * STEP_MM, atol=1e-3)
    assert capfd.readouterr().err == ""


def test_half_floats(tmp_path: Path, camera: Camera, steps: Array, capfd: pytest.CaptureFixture[str]) -> None:
    half = (steps * (STEP_MM / 1000.0)).astype(np.float16)
    for form in ({}, {"compression": "deflate", "predictor": True}, {"compression": "zstd"}):
        tifffile.imwrite(tmp_path / "scan.tiff", half, **form)
        z = points_of(tmp_path / "scan.tiff", camera, units="m")[..., 2]
        np.testing.assert_allclose(np.nan_to_num(z), half.astype(np.float64) * 1000.0, rtol=1e-6)
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize(
    ("form", "missing", "message"),
    [
        ({"compression": "zstd"}, "imagecodecs", "is compressed with ZSTD: save it uncompressed or with deflate"),
        ({"compression": "lzma"}, "tifffile", "is compressed with LZMA: save it uncompressed or with deflate"),
        ({"compression": "lerc"}, "tifffile", "is compressed with LERC"),
        ({"dtype": np.float16}, "tifffile", "holds 16-bit floats: save it as 32-bit floats"),
        ({"photometric": "rgb"}, "tifffile", "is a map of X, Y and Z: save it as .ply"),
    ],
)
def test_what_to_do_without_the_packages(
    tmp_path: Path, camera: Camera, monkeypatch: pytest.MonkeyPatch, form: dict[str, Any], missing: str, message: str
) -> None:
    def without(name: str) -> Any:
        if name == missing:
            raise ImportError(name)
        return importlib.import_module(name)

    monkeypatch.setattr(packed_tiff, "import_module", without)
    shape = (48, 64, 3) if "photometric" in form else (48, 64)
    values = np.full(shape, 0.8, form.get("dtype", np.float32))
    tifffile.imwrite(tmp_path / "scan.tiff", values, **{key: form[key] for key in form if key != "dtype"})
    with pytest.raises(MissingDependencyError, match=rf"scan\.tiff: {message}.*needs the package {missing}.*formats"):
        points_of(tmp_path / "scan.tiff", camera)


def texture_of(shape: tuple[int, int], dtype: Any = np.uint8) -> Array:
    return np.random.default_rng(3).integers(0, 255, shape).astype(dtype)


def test_the_page_that_can_be_a_depth_map(
    tmp_path: Path, camera: Camera, steps: Array, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "scan.tiff"
    tifffile.imwrite(path, steps)
    expected = points_of(path, camera)
    texture = texture_of(steps.shape)
    colours = np.dstack([texture] * 3)
    small = np.zeros((12, 16), np.uint16)
    for number, pages in enumerate([(texture, steps, texture), (steps, texture), (colours, texture, steps)]):
        with tifffile.TiffWriter(path, bigtiff=number == 1) as file:
            for page in pages:
                file.write(page, contiguous=False)
            file.write(small, subfiletype=1)
        scan = read_scan(path, camera=camera, depth_scale_mm=STEP_MM)
        np.testing.assert_array_equal(scan.points, expected)
        place = next(k for k, page in enumerate(pages, start=1) if page is steps)
        assert any(f"of which number {place} was taken" in note for note in scan.notes)
    assert capfd.readouterr().err == ""


def test_pages_that_are_called_by_what_they_hold(tmp_path: Path, camera: Camera, depth_mm: Array) -> None:
    path = tmp_path / "scan.tiff"
    depth = depth_mm.astype(np.float32)
    for name in ("Texture", "Depth map"):
        tifffile.imwrite(path, depth)
        expected = points_of(path, camera)
        with tifffile.TiffWriter(path) as file:
            for called, page in (("Texture", depth * 0.1), (name, depth), ("Confidence", depth * 0.2)):
                file.write(page, contiguous=False, description=called, metadata=None)
        if name == "Depth map":
            np.testing.assert_array_equal(points_of(path, camera), expected)
        else:
            with pytest.raises(
                ScanError, match=r"holds 3 pictures \(64 x 48 pixels of 32 bits floating, .*save it alone"
            ):
                points_of(path, camera)


def test_a_file_whose_pages_go_round_in_circles(tmp_path: Path, camera: Camera, steps: Array) -> None:
    stream = io.BytesIO()
    with tifffile.TiffWriter(stream) as file:
        file.write(texture_of(steps.shape), contiguous=False)
        file.write(steps, contiguous=False)
    content = bytearray(stream.getvalue())
    first = struct.unpack_from("<I", content, 4)[0]
    second_at = first + 2 + 12 * struct.unpack_from("<H", content, first)[0]
    second = struct.unpack_from("<I", content, second_at)[0]
    struct.pack_into("<I", content, second + 2 + 12 * struct.unpack_from("<H", content, second)[0], first)
    (tmp_path / "scan.tiff").write_bytes(content)
    assert points_of(tmp_path / "scan.tiff", camera).shape == (48, 64, 3)


@pytest.mark.parametrize("units", ["mm", "m"])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize(
    "form",
    [
        {"photometric": "rgb"},
        {"photometric": "rgb", "planarconfig": "separate"},
        {"photometric": "minisblack", "planarconfig": "contig"},
        {"photometric": "minisblack"},
        {"photometric": "rgb", "compression": "deflate", "predictor": True},
        {"photometric": "rgb", "compression": "zstd"},
    ],
)
def test_maps_of_x_y_and_z(
    tmp_path: Path, grid: FloatArray, camera: Camera, units: str, dtype: Any, form: dict[str, Any]
) -> None:
    values = (grid / (1000.0 if units == "m" else 1.0)).astype(dtype)
    values[0, :3] = 0.0
    if form.get("planarconfig") == "separate":
        tifffile.imwrite(tmp_path / "xyz.tiff", np.moveaxis(values, -1, 0), **form)
    else:
        tifffile.imwrite(tmp_path / "xyz.tiff", values, **form)
    for declared in (None, camera):
        scan = read_scan(tmp_path / "xyz.tiff", units=units, camera=declared)
        assert scan.dropped == 43
        np.testing.assert_allclose(scan.points[1:], grid[1:], rtol=1e-6)
        assert scan.viewpoint is not None


def test_colours_that_show_depths(tmp_path: Path, grid: FloatArray, steps: Array) -> None:
    coloured = cv2.applyColorMap((steps / 256).astype(np.uint8), cv2.COLORMAP_JET)
    message = (
        r"shot_Depth\.png: has 3 channels: it is a picture in colour, not a depth map.*16-bit PNG, or the cloud as .ply"
    )
    cv2.imwrite(str(tmp_path / "shot_Depth.png"), coloured)
    cv2.imwrite(str(tmp_path / "shot_Color.png"), coloured)
    (tmp_path / "shot_Depth_metadata.csv").write_text(
        "Stream,Depth\nIntrinsic:,\nFx,80\nFy,81\nPPx,30.5\nPPy,25.25\nDistorsion,Brown Conrady\n"
        "Resolution x,64\nResolution y,48\n"
    )
    for path in (tmp_path, tmp_path / "shot_Depth.png"):
        with pytest.raises(ScanError, match=message):
            read_scan(path)
    # The cloud or the raw map beside it is what is meant.
    np.savez(tmp_path / "raw_depth.npz", depth=steps)
    scan = read_scan(tmp_path, depth_scale_mm=STEP_MM)
    assert scan.camera == Camera(80.0, 81.0, 30.5, 25.25, 64, 48)
    np.testing.assert_allclose(scan.points, grid, atol=STEP_MM)


def damaged(content: bytes, number: int, rng: np.random.Generator) -> bytes:
    """The bytes of a file, cut off or with eight of them changed."""
    if number % 2:
        return content[: rng.integers(1, len(content))]
    changed = bytearray(content)
    for position in rng.integers(8, len(content), 8):
        changed[position] = rng.integers(0, 256)
    return bytes(changed)


@pytest.mark.parametrize(
    "form", [{"compression": "zstd"}, {"compression": "lzma"}, {"photometric": "rgb"}, {}, {"png": True}]
)
def test_damaged_pictures_say_so_in_our_words_alone(
    tmp_path: Path,
    camera: Camera,
    steps: Array,
    grid: FloatArray,
    form: dict[str, Any],
    capfd: pytest.CaptureFixture[str],
) -> None:
    path = tmp_path / ("scan.png" if "png" in form else "scan.tiff")
    if "png" in form:
        cv2.imwrite(str(path), steps)
    else:
        tifffile.imwrite(path, grid if "photometric" in form else steps, **form)
    content = path.read_bytes()
    rng = np.random.default_rng(6)
    read = 0
    for number in range(40):
        path.write_bytes(damaged(content, number, rng))
        with contextlib.suppress(AadmError):
            points_of(path, camera)
            read += 1
    assert read < 30
    assert capfd.readouterr().err == ""
