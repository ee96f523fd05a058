"""Where a set column comes to stand, in the words of the window: from the setting that report.json holds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import FreeCAD

from aadm_workbench.document.words import in_words, length_text
from aadm_workbench.report.sheets.numbers import pose_text

translate = FreeCAD.Qt.translate


class SettingSaid(NamedTuple):
    """Texts of a setting, empty where nothing is known; ``lines`` are sentences for a panel."""

    top: str = ""
    verdict: str = ""
    set_pose: str = ""
    lines: tuple[str, ...] = ()


def setting_said(setting: Mapping[str, Any] | None) -> SettingSaid:
    """What a column's ``setting`` in report.json says; nothing without one."""
    if not setting:
        return SettingSaid()
    said = SettingSaid(verdict=str(setting["top_verdict"]))
    if not setting.get("top_mm"):
        return said._replace(lines=(translate("AADM", "The top of the set column is not predicted: see the report"),))
    top = translate("AADM", "{off} ± {u}, {against}").format(
        off=length_text(math.hypot(*setting["top_mm"])),
        u=length_text(setting["top_u_mm"]),
        against=_against(str(setting["against"])),
    )
    line = translate("AADM", "Top of the set column: {top} – {verdict}").format(top=top, verdict=in_words(said.verdict))
    said = said._replace(top=top, lines=(line,))
    if setting.get("set_pose"):
        pose = f"set_pose = {pose_text(setting['set_pose'])}"
        after = length_text(setting["set_pose_top_mm"])
        line = translate("AADM", "→ {pose} in the job: the top comes to {after}").format(pose=pose, after=after)
        said = said._replace(set_pose=pose, lines=(*said.lines, line))
    return said


def _against(basis: str) -> str:
    words = {
        "control_points": translate("AADM", "against the grid"),
        "storey_below": translate("AADM", "against the grid, through the column below"),
        "bars": translate("AADM", "against its own bars alone"),
    }
    return words.get(basis, basis)
