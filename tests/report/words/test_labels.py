"""Two languages: every text has both, and the sentences of a check are told in Chinese without losing a number."""

import re
import struct
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.group_notes import AXES_NOT_TOLD
from aadm_workbench.errors import CameraError, ScanError
from aadm_workbench.model import Reason, Scan
from aadm_workbench.report.pages.fonts import FONT_FILE
from aadm_workbench.report.words.labels import all_words
from aadm_workbench.report.words.reasons import in_both_languages
from aadm_workbench.scan.depth_picture import depth_picture
from aadm_workbench.scan.file import ScanFile
from aadm_workbench.scan.formats.e57 import NO_ROTATION
from aadm_workbench.scan.intrinsics import Intrinsics, checked_camera
from aadm_workbench.scan.plausible import refuse_ray_distances

CHINESE = re.compile(r"[\u4e00-\u9fff]")
SAME = {"ui.global_id", "ui.hash", "ui.offset_x", "ui.offset_y", "ui.u", "ui.p_value", "ui.colon", "ui.cp", "ui.cpk"}


@pytest.mark.parametrize("name", all_words())
def test_both_languages(name: str) -> None:
    english, chinese = all_words()[name]
    assert english.strip()
    assert name in SAME or name == "ui.language" or CHINESE.search(chinese), "no Chinese"
    assert sorted(re.findall(r"{\w+}", english)) == sorted(re.findall(r"{\w+}", chinese))


def test_font_has_every_character_of_the_words() -> None:
    ttlib = pytest.importorskip("fontTools.ttLib")
    known = ttlib.TTFont(FONT_FILE).getBestCmap()
    used = {sign for text in all_words().values() for sign in text.zh + text.en}
    assert not {sign for sign in used if ord(sign) not in known} - {"✗", "▾"}
    assert all(ord(sign) in known for sign in "柱套筒灌浆连接钢筋預製±≤°²σ龘" if sign != "龘")
    assert FONT_FILE.stat().st_size < 2_500_000


def test_reasons_of_a_real_check_are_told_in_chinese(floor: dict[str, Any]) -> None:
    reasons = [reason for column in floor["columns"] for reason in column["reasons"]]
    assert len(reasons) > 10
    for reason in reasons:
        told = in_both_languages(reason)
        assert told.en == reason
        assert CHINESE.search(told.zh), reason
        assert sorted(re.findall(r"\d+\.\d+|[SR]\d+", told.zh)) == sorted(re.findall(r"\d+\.\d+|[SR]\d+", reason))


def test_unknown_sentence_stays() -> None:
    assert in_both_languages("the moon is full").zh == "the moon is full"


def notes_of_scans() -> list[str]:
    """What is said of files, as the readers themselves say it."""
    with pytest.raises(ScanError) as coloured:
        depth_picture(ScanFile("a.png", b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sIIBB", 13, b"IHDR", 8, 6, 8, 2), ""))
    with pytest.raises(CameraError) as bent:
        checked_camera(Intrinsics("", 900.0, 900.0, 4.0, 3.0, 8, 6, distortion=(0.5, 0.0)))
    rays = np.stack([*np.meshgrid(np.linspace(-0.2, 0.2, 40), np.linspace(-0.2, 0.2, 40)), np.ones((40, 40))], axis=-1)
    bowl = (rays * 800.0 * np.linalg.norm(rays, axis=-1, keepdims=True)).reshape(-1, 3)
    with pytest.raises(ScanError) as hollow:
        refuse_ray_distances(Scan(bowl, "a.tiff", viewpoint=np.zeros(3)), bowl)
    errors = [str(caught.value) for caught in (coloured, bent, hollow)]
    return [*errors, Reason("scan.opengl_axes"), AXES_NOT_TOLD, NO_ROTATION]


@pytest.mark.parametrize("number", range(6))
def test_what_is_said_of_files_is_told_in_chinese_as_a_whole(number: int) -> None:
    sentence = notes_of_scans()[number]
    chinese = in_both_languages(sentence).zh
    left = set(re.findall(r"[A-Za-z]{3,}", chinese)) - {
        "OpenGL",
        "axes",
        "camera",
        "opengl",
        "TIFF",
        "PNG",
        "png",
        "ply",
        "tiff",
    }
    assert not left, chinese
