"""Filters of several makers, by the names that stand in their manuals."""

from __future__ import annotations

import pytest

from aadm_workbench.camera.settings import warnings_of


@pytest.mark.parametrize(
    ("settings", "named"),
    [
        ({"PointCloudSurfaceSmoothing": "Strong", "PointCloudGapFilling": "Off"}, ["PointCloudSurfaceSmoothing"]),
        ({"PointCloudSurfaceSmoothing": "Off", "PointCloudEdgePreservation": "Smooth"}, []),
        ({"SurfaceSmoothness": "Sharp", "HoleFilling": True}, ["HoleFilling"]),
        ({"SurfaceSmoothness": "Normal"}, ["SurfaceSmoothness"]),
        ({"FilterSmoothingGaussianEnabled": False, "FilterSmoothingGaussianSigma": 1.5}, []),
        (
            {"FilterSmoothingGaussianEnabled": True, "FilterSmoothingGaussianSigma": 1.5},
            ["FilterSmoothingGaussianEnabled"],
        ),
        ({"MedianFilterSize": 5}, ["MedianFilterSize"]),
        ({"MedianFilterSize": 0, "SpatialFilter": "Disabled"}, []),
        ({"SpatialFilter": False, "TemporalFilterStrength": 3}, ["TemporalFilterStrength"]),
        ({"ExposureTime": 8000.0, "Gain": 2.0, "OutlierRemoval": "Strong"}, []),
        ({"FillMissingPoints": 1, "Scan3dDataInterpolationMode": "None"}, ["FillMissingPoints"]),
    ],
)
def test_smoothing_and_filling_are_warned_about_by_the_makers_name(settings: dict, named: list[str]) -> None:
    warnings = warnings_of(settings)
    assert [warning.split("(")[1].split(" = ")[0] for warning in warnings] == named
    for warning, name in zip(warnings, named, strict=True):
        assert str(settings[name]) in warning
