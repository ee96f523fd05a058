"""What a finding tells to change is called what the camera's software, or the job, calls it, in both languages.

Names are those of the makers: of the parameters of Mech-Eye API (``PointCloudSurfaceSmoothing``, ``GapFilling``),
PhoXi API (``SurfaceSmoothness``, ``HoleFilling``, ``CameraMatrix``), Zivid SDK (``Filters.Smoothing.Gaussian``,
``Filters.Hole.Repair``, ``Sampling``, ``CameraIntrinsics``) and librealsense (``spatial filter``, ``hole filling
filter``, ``depth units``).
"""

from __future__ import annotations

import pytest

from aadm_workbench.model.sentences.finding import SENTENCES

SMOOTHING = ("Mech-Eye: Surface Smoothing", "Photoneo: Surface Smoothness", "Zivid: Smoothing > Gaussian")
FILLING = ("Mech-Eye: Gap Filling", "Photoneo: Hole Filling", "Zivid: Hole > Repair", "RealSense: Hole Filling Filter")
INTRINSICS = ("Mech-Eye", "Zivid: Camera Intrinsics", "Photoneo: Camera Matrix", "RealSense: Intrinsics")
OF_CAMERA: dict[str, tuple[str, ...]] = {
    "smoothed": (*SMOOTHING, "RealSense: Spatial Filter"),
    "gaps_filled": FILLING,
    "edges_fattened": FILLING,
    "common_lean.camera": (*INTRINSICS, "cx", "cy"),
    "common_lean.rebar": (*INTRINSICS, "cx", "cy"),
    "common_lean.sleeve": (*INTRINSICS, "cx", "cy"),
    "scale_differs.bores": (*INTRINSICS, "fx", "fy"),
    "scale_differs.camera": (*INTRINSICS, "fx", "fy"),
    "scale_differs.group": (*INTRINSICS, "fx", "fy"),
    "scale_differs.column": INTRINSICS,
    "scale_differs.focal": (*INTRINSICS, "fx", "fy", "Zivid: Sampling", "Photoneo: Resolution"),
    "scale_differs.unit": ("depth_scale_mm", "Mech-Eye: Unit", "RealSense: Depth Units"),
    "mirrored": ("flip", "mirror"),
    "profile_differs": ("[camera]",),
    "profile_of_other_laws": ("[camera]",),
}
"""By finding, what has to be named of the camera's settings, or of those that the job tells of it."""

OF_JOB: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "turn_contradicted": (("up in the job",), ("up",)),
    "turn_contradicted.worse": (("up in the job",), ("up",)),
    "turn_doubtful": (("correct up",), ("改正 up",)),
    "hoisting_turn_doubtful": (("correct near",), ("改正 near",)),
    "hoisting_frames_contradict": (("Correct near",), ("改正从另一角拍摄的那一帧的 near",)),
    "hoisting_frames_contradict.pairs": (("Correct near",), ("改正从另一角拍摄的那一帧的 near",)),
    "swapped": (("Exchange the two files in the job",), ("对调这两个文件",)),
    "swapped.one": (("another file is meant",), ("应为另一个文件",)),
    "other_column": (("the file of this column in the job",), ("指定本柱的文件",)),
    "same_scan_twice.column": (("one of its scans is missing",), ("缺少一个扫描",)),
    "same_scan_twice.columns": (("was not scanned",), ("没有扫描",)),
    "sleeves_by_design": (("use refined",), ("使用 refined",)),
    "duplicate_global_id": (("export the model",), ("重新导出模型",)),
}
"""By finding, what has to be named of the job, or of its files, in English and in Chinese."""

OF_SITE = (
    "camera_bends",
    "diameter_differs.other_sleeves",
    "diameter_differs.others",
    "diameter_differs.rebar",
    "diameter_differs.sleeve",
    "edge_chipped",
    "exposed_length_differs.long",
    "exposed_length_differs.short",
    "face_not_flat",
    "pattern_off_section",
    "section_size_differs",
)
"""What no setting mends: concrete, steel, a lens."""


def test_each_finding_tells_a_setting_or_has_none() -> None:
    assert {f"finding.{name}" for name in (*OF_CAMERA, *OF_JOB, *OF_SITE)} == set(SENTENCES)
    assert len(OF_CAMERA) + len(OF_JOB) + len(OF_SITE) == len(SENTENCES)


@pytest.mark.parametrize("name", OF_CAMERA)
def test_settings_of_a_camera_have_their_makers_names(name: str) -> None:
    english, chinese = SENTENCES[f"finding.{name}"]
    told = chinese.replace("：关闭 ", "：").replace("：", ": ")
    assert [word for word in OF_CAMERA[name] if word not in english] == []
    assert [word for word in OF_CAMERA[name] if word not in told] == []


@pytest.mark.parametrize("name", OF_JOB)
def test_what_is_to_be_changed_in_a_job_is_told(name: str) -> None:
    english, chinese = SENTENCES[f"finding.{name}"]
    of_english, of_chinese = OF_JOB[name]
    assert [word for word in of_english if word not in english] == []
    assert [word for word in of_chinese if word not in chinese] == []
