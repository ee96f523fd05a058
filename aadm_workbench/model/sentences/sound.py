"""What is said of bodies that are none."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "sound.body": Sentence("a body of it has no extent, or lies nowhere", "某实体没有范围，或不在任何位置"),
    "sound.far": Sentence("it lies beyond all maps", "位于任何地图之外"),
    "sound.left_out": Sentence(
        "{type} {called} was left out, wholly or in part: {why}",
        "{type} {called} 全部或部分未采用：{why}",
    ),
    "sound.more": Sentence("{count} more elements were left out", "另有 {count} 个构件未采用"),
    "sound.no_area": Sentence("its profile has no area", "其截面没有面积"),
    "sound.no_corner": Sentence(
        "a face of it names a corner that is not in its list of points",
        "某面所指的角点不在其点表中",
    ),
    "sound.no_depth": Sentence("its extrusion has no depth", "其拉伸没有深度"),
    "sound.no_faces": Sentence("it has no faces", "没有面"),
    "sound.no_line": Sentence("it is swept along a line without length", "沿没有长度的线扫掠"),
    "sound.placement": Sentence("its placement makes no sense", "其定位没有意义"),
    "sound.size": Sentence("its {what} is {size_mm:g} mm", "其 {what} 为 {size_mm:g} mm"),
    "sound.turned_no_area": Sentence("what it turns has no area", "所旋转的截面没有面积"),
}
