"""Every panel and window can be read, light and dark, in both languages: measured on the real screen."""

from typing import Any

import cv2
import pytest

pytestmark = pytest.mark.freecad

PANELS = ("design", "import", "capture", "check", "check_all", "job", "report", "write", "about", "install", "hoisting")


@pytest.mark.parametrize(
    "look", [f"{panel}-{dress}" for panel in PANELS for dress in ("light-en", "light-zh", "dark-zh")]
)
def test_nothing_is_cut_covered_or_pale(session: dict[str, Any], look: str) -> None:
    assert session["looks"][look] == []


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_icons_stand_out_from_the_toolbar(session: dict[str, Any], theme: str) -> None:
    assert session["looks"][f"toolbar-{theme}"] == []


def test_dark_is_dark(session: dict[str, Any]) -> None:
    light, dark = (cv2.imread(str(session["folder"] / f"look-report-{one}-zh.png")) for one in ("light", "dark"))
    assert dark[300:600, 40:250].mean() < 100 < 180 < light[300:600, 40:250].mean()


def test_what_cannot_be_read_is_found(session: dict[str, Any]) -> None:
    pale, cut, covered = session["bad_looks"]
    assert "pale" in pale
    assert cut.endswith("is cut")
    assert "covers" in covered
