"""Our extraction beside scripts that a user would write from well-known libraries, on the same scans.

    python -m benchmarks.peers [--scenes 5] [--seed 1] [--settings lab field] [--json FILE]

Each peer finds the plane of the face, or of the floor, by RANSAC (Open3D, 1 mm, all points), takes the holes in the
mask of the face, or the tops in the mask of what stands out, and fits an ellipse to each contour: OpenCV's contours and
ellipses, or scikit-image's. Contours lie on pixels, so their rays are cut with the plane before the ellipse is fitted:
better than ellipses in pixels, and what a careful user does. The methods of the literature stand beside them. Times are
processor seconds of all threads, medians over the scans; every package is loaded before. Peers that are not installed
are named and left out (Open3D: the extra ``published``; scikit-image: ``pip install scikit-image``).
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from importlib.util import find_spec
from pathlib import Path
from statistics import median
from time import process_time
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from aadm_workbench.extract.method import extract
from aadm_workbench.model import Array, Kind, Plane, Scan
from aadm_workbench.twin.scene import TrueScan
from aadm_workbench.twin.scenes import FIELD, LAB, Setting, random_bar_scan, random_sleeve_scan
from aadm_workbench.twin.study.methods import diameter_of

_RANSAC_MM, _RANSAC_ROUNDS = 1.0, 500
"""Of the plane: threshold, and trials; Open3D's own example takes a thousand."""

_ON_FACE_MM = 1.5
_TOP_BAND_MM = 12.0  # tops end within 3 mm of their level, sides are cut off below
_STANDS_MM = 60.0  # above the floor: bars stick out by 120 mm and more
_SIZES = (0.8, 1.25)
"""Diameters of ellipses over the nominal one, and of their axes over each other."""

_FEWEST = 20  # pixels of a contour
_OWN_RADII = 1.0  # a find this near to a true centre, in its radii, is of that one

Mask = npt.NDArray[np.uint8]
Ellipse = tuple[Array, float, float]
"""Centre (2,) mm in the plane, and both diameters."""

Find = Callable[[Scan, Kind, float], Array]
"""Centres (n, 3) mm, scan frame, of what a method finds in a scan, given the nominal diameter."""


@dataclass(frozen=True)
class Row:
    """One method on all scans of one setting and kind; errors in the plane, mm; ``times`` our processor time in its."""

    setting: str
    kind: str
    method: str
    expected: int
    found: int
    false: int
    mean_mm: float | None
    largest_mm: float | None
    cpu_s: float
    times: float | None = None


def contours_by(ellipses: Callable[[Mask, Callable[[Array], Array], bool], Iterator[Ellipse]]) -> Find:
    """A peer that fits ellipses to the contours of a mask in its own way."""

    def find(scan: Scan, kind: Kind, diameter_mm: float) -> Array:
        is_foot = kind is Kind.SLEEVE
        plane = _plane(scan)
        mask, plane = _mask(scan, plane, is_foot=is_foot)
        axes = _axes(plane)

        def on_plane(pixels: Array) -> Array:
            """Pixels (n, 2) as (x, y) on the plane, mm: their rays cut with it."""
            camera = scan.camera
            assert camera is not None
            rays = np.column_stack(
                [(pixels[:, 0] - camera.cx) / camera.fx, (pixels[:, 1] - camera.cy) / camera.fy, np.ones(len(pixels))]
            )
            points = rays * (plane.offset / (rays @ plane.normal))[:, None]
            return np.asarray(points @ axes[:2].T)

        centres = [
            centre @ axes[:2] + plane.offset * plane.normal
            for centre, *diameters in ellipses(mask, on_plane, is_foot)
            if all(_SIZES[0] < one / diameter_mm < _SIZES[1] for one in diameters)
        ]
        return np.array(centres).reshape(-1, 3)

    return find


def _plane(scan: Scan) -> Plane:
    """The largest plane: that of the face, or of the floor."""
    import open3d

    points = scan.points.reshape(-1, 3)
    points = points[np.isfinite(points[:, 2])]
    points = points.astype(np.float64)
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    model, inliers = cloud.segment_plane(_RANSAC_MM, 3, _RANSAC_ROUNDS)
    chosen = points[inliers]
    middle = chosen.mean(axis=0)
    normal = np.linalg.eigh((chosen - middle).T @ (chosen - middle))[1][:, 0]
    normal = normal if normal @ np.asarray(model[:3]) > 0 else -normal
    return Plane(normal, float(normal @ middle))


def _mask(scan: Scan, plane: Plane, *, is_foot: bool) -> tuple[Mask, Plane]:
    """The face, or the tops of bars, as 255 in a picture, and the plane that they lie in."""
    with np.errstate(invalid="ignore"):
        height = scan.points @ plane.normal - plane.offset
        if is_foot:
            return np.where(np.abs(height) < _ON_FACE_MM, 255, 0).astype(np.uint8), plane
        # The camera stands at the origin, on the side that bars stick out to.
        height = height if plane.offset < 0 else -height
        level = float(np.percentile(height[height > _STANDS_MM], 90))
        mask = np.where(np.abs(height - level) < _TOP_BAND_MM, 255, 0).astype(np.uint8)
    up = level if plane.offset < 0 else -level
    return mask, Plane(plane.normal, plane.offset + up)


def _axes(plane: Plane) -> Array:
    helper = np.eye(3)[int(np.abs(plane.normal).argmin())]
    first = np.cross(helper, plane.normal)
    first /= np.linalg.norm(first)
    return np.vstack([first, np.cross(plane.normal, first), plane.normal])


def opencv_ellipses(mask: Mask, on_plane: Callable[[Array], Array], is_foot: bool) -> Iterator[Ellipse]:
    """Contours of holes, or outer ones of tops, by OpenCV, and its ellipses through them."""
    found, tree = cv2.findContours(mask, cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)
    for contour, place in zip(found, [] if tree is None else tree[0], strict=True):
        is_hole = bool(place[3] >= 0)
        if is_hole is is_foot and len(contour) >= _FEWEST:
            flat = on_plane(contour[:, 0].astype(np.float64))
            middle = flat.mean(axis=0)
            centre, diameters, _ = cv2.fitEllipse((flat - middle).astype(np.float32))
            yield middle + np.array(centre), *diameters


def skimage_ellipses(mask: Mask, on_plane: Callable[[Array], Array], is_foot: bool) -> Iterator[Ellipse]:
    """Contours between pixels and ellipses by scikit-image; which of them are holes the way around tells."""
    from skimage.measure import EllipseModel, find_contours

    for contour in find_contours(mask, 127.5):
        rows, columns = contour.T
        turns = float(np.sum(columns * np.roll(rows, -1) - np.roll(columns, -1) * rows))
        if (turns < 0) is is_foot and len(contour) >= _FEWEST:
            flat = on_plane(contour[:, ::-1])
            middle = flat.mean(axis=0)
            model = EllipseModel.from_estimate(flat - middle)  # from scikit-image 0.26 on; false where there is none
            if model:
                yield middle + np.array(model.center), *(2.0 * np.array(model.axis_lengths)).tolist()


def own(method: str) -> Find:
    """An extraction method of this project: ``refined``, or one of the literature."""

    def find(scan: Scan, kind: Kind, diameter_mm: float) -> Array:
        found = extract(scan, kind, diameter_mm, method, np.random.default_rng(0))
        return np.array([point.centre for point in found.points]).reshape(-1, 3)

    return find


METHODS: dict[str, tuple[Find, tuple[str, ...]]] = {
    "refined": (own("refined"), ()),
    "Open3D + OpenCV": (contours_by(opencv_ellipses), ("open3d",)),
    "Open3D + scikit-image": (contours_by(skimage_ellipses), ("open3d", "skimage")),
    "fusion (as published)": (own("fusion"), ("open3d",)),
    "pointcloud": (own("pointcloud"), ("open3d",)),
    "image": (own("image"), ("open3d",)),
}
"""By its name: how it finds, and the packages that it needs."""


def errors_mm(truth: TrueScan, found: Array, radius_mm: float) -> tuple[list[float], int]:
    """Errors in the plane of the centres that were found, each true one once, and how many finds are of none."""
    up = truth.T_column_scan[:3, :3].T @ np.array([0.0, 0.0, 1.0])
    apart = truth.points_scan()[:, None] - found[None]
    flat = np.linalg.norm(apart - (apart @ up)[..., None] * up, axis=2)
    if not flat.size:
        return [], len(found)
    nearest = flat.argmin(axis=0)
    near = flat.min(axis=0) < _OWN_RADII * radius_mm
    best = [float(flat[k, (nearest == k) & near].min()) for k in range(len(flat)) if ((nearest == k) & near).any()]
    return best, len(found) - len(best)


def compare(settings: Sequence[Setting], scenes: int, seed: int, methods: Sequence[str]) -> list[Row]:
    """All methods on the same scans, one scan after the other, so that the machine's mood is the same for all."""
    rows = []
    for setting in settings:
        for kind, render in ((Kind.SLEEVE, random_sleeve_scan), (Kind.REBAR, random_bar_scan)):
            diameter_mm = diameter_of(setting, kind)
            seconds: dict[str, list[float]] = {method: [] for method in methods}
            errors: dict[str, list[float]] = {method: [] for method in methods}
            false = dict.fromkeys(methods, 0)
            expected = 0
            for scene in range(scenes):
                truth = render(setting, np.random.default_rng([seed, *setting.name.encode(), scene]))
                scan = truth.scan()
                expected += len(truth.points)
                for method in methods:
                    find = METHODS[method][0]
                    if scene == 0:
                        find(scan, kind, diameter_mm)
                    began = process_time()
                    found = find(scan, kind, diameter_mm)
                    seconds[method].append(process_time() - began)
                    near, wrong = errors_mm(truth, found, diameter_mm / 2.0)
                    errors[method] += near
                    false[method] += wrong
            for method in methods:
                off = errors[method]
                ratios = [ours / its for ours, its in zip(seconds[methods[0]], seconds[method], strict=True)]
                rows.append(
                    Row(
                        setting.name,
                        kind.plural,
                        method,
                        expected,
                        len(off),
                        false[method],
                        float(np.mean(off)) if off else None,
                        max(off, default=None),
                        median(seconds[method]),
                        None if method == methods[0] else median(ratios),
                    )
                )
                print(_line(rows[-1]), flush=True)
    return rows


def _line(row: Row) -> str:
    mean = "-" if row.mean_mm is None else f"{row.mean_mm:.3f} ({row.largest_mm:.2f})"
    times = "" if row.times is None else f"{row.times:.2f}"
    found = f"{row.found} of {row.expected}, {row.false} false"
    return f"{row.setting:6} {row.kind:8} {row.method:24} {found:24} {mean:16} {row.cpu_s:8.3f} {times:>6}"


def main() -> None:
    """Compare what is installed, and say what is not."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--settings", nargs="+", choices=("lab", "field"), default=["lab", "field"])
    parser.add_argument("--methods", nargs="+", choices=list(METHODS), default=list(METHODS))
    parser.add_argument("--json", type=Path, help="write the rows into a file too")
    options = parser.parse_args()
    lacking = {name: [one for one in METHODS[name][1] if find_spec(one) is None] for name in options.methods}
    methods = ["refined", *(name for name in options.methods if name != "refined" and not lacking[name])]
    for name, packages in lacking.items():
        if packages:
            print(f"{name}: not there ({', '.join(packages)} is not installed)")
    print("setting kind     method                   found                    mean (largest)  CPU s   ours / its")
    chosen = [setting for setting in (LAB, FIELD) if setting.name in options.settings]
    rows: list[dict[str, Any]] = [asdict(row) for row in compare(chosen, options.scenes, options.seed, methods)]
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
