"""What is said of the position in the building, by control points."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "survey.absolute_few_bars": Sentence(
        "absolute position: fewer than two bars were measured",
        "绝对位置：测得的钢筋不足两根",
    ),
    "survey.control_contradict": Sentence(
        "the control points contradict each other: {name} is {off_mm:.1f} mm off where the others put it; check "
        "names, order and unit",
        "控制点相互矛盾：{name} 偏离其余各点给出的位置 {off_mm:.1f} mm；请检查名称、顺序和单位",
    ),
    "survey.control_contradict.scale": Sentence(
        "the control points contradict each other: {name} is {off_mm:.1f} mm off where the others put it; they "
        "are {stretch:.3g} times as far apart as in the scan; check names, order and unit",
        "控制点相互矛盾：{name} 偏离其余各点给出的位置 {off_mm:.1f} mm；各点间距是扫描中的 {stretch:.3g} "
        "倍；请检查名称、顺序和单位",
    ),
    "survey.control_lean": Sentence(
        "by the control points the column would lean {lean_deg:.0f}° against the vertical of the scan: check "
        "their names and their order",
        "按控制点，柱相对扫描的竖直方向将倾斜 {lean_deg:.0f}°：请检查其名称和顺序",
    ),
    "survey.control_no_model": Sentence(
        "the design has no place in a model, so control points must be given in the column frame",
        "设计在模型中没有位置，控制点须按柱坐标系给出",
    ),
    "survey.control_no_turn": Sentence(
        "the control points do not show how the scan is turned: {why}",
        "控制点看不出扫描的转位：{why}",
    ),
    "survey.control_on_line": Sentence(
        "the control points lie on one line, and the scan does not show the vertical",
        "控制点在一条直线上，而扫描中看不出竖直方向",
    ),
    "survey.control_unmatched": Sentence(
        "the points in the first scan of the rebars, that of the control points, were not matched",
        "第一个钢筋扫描（即控制点所在的扫描）中的点未能对应",
    ),
    "survey.group_off": Sentence(
        "the bars as a group are {deviation_mm:.2f} mm off their place ({dx_mm:+.2f}, {dy_mm:+.2f})",
        "整组钢筋偏离应有位置 {deviation_mm:.2f} mm（{dx_mm:+.2f}, {dy_mm:+.2f}）",
    ),
    "survey.group_turned": Sentence(
        "absolute position: by the control points the bars are turned by {turn_deg:.0f}° against the declared up; "
        "one of the two is wrong",
        "绝对位置：按控制点，钢筋相对指定的 up 转了 {turn_deg:.0f}°；两者之一有误",
    ),
    "survey.off_in_building": Sentence(
        "{label} is {deviation_mm:.2f} mm from its place in the building",
        "{label} 偏离建筑中的应有位置 {deviation_mm:.2f} mm",
    ),
}
