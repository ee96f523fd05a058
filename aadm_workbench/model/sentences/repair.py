"""What is advised where a column does not go on."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "repair.advise": Sentence("subject to the engineer's release: {what}", "须经工程师批准：{what}"),
    "repair.advise.if_confirmed": Sentence(
        "subject to the engineer's release: rescan closer; if that confirms it, {what}",
        "须经工程师批准：靠近重新扫描；若结果相同，{what}",
    ),
    "repair.advise_plan": Sentence(
        "subject to the engineer's release: no bend can be advised; {plan}: {why:;}",
        "须经工程师批准：不能建议弯筋；{plan}：{why:;}",
    ),
    "repair.after": Sentence(
        "{what}. Then the largest distance is {max_mm:.2f} mm",
        "{what}。处理后最大中心距 {max_mm:.2f} mm",
    ),
    "repair.after.doubtful": Sentence(
        "{what}. Then the largest distance is {max_mm:.2f} mm, and the trial may stay inconclusive (a pose exists "
        "with {percent:.0f} %)",
        "{what}。处理后最大中心距 {max_mm:.2f} mm，预拼装可能仍不确定（可就位概率 {percent:.0f} %）",
    ),
    "repair.bend": Sentence("bend {rebar} by ({dx:+.1f}, {dy:+.1f}) mm", "将 {rebar} 弯移 ({dx:+.1f}, {dy:+.1f}) mm"),
    "repair.bend.upright": Sentence(
        "bend {rebar} by ({dx:+.1f}, {dy:+.1f}) mm and set it upright",
        "将 {rebar} 弯移 ({dx:+.1f}, {dy:+.1f}) mm，并扶直",
    ),
    "repair.best_found": Sentence(
        "{what} (the best that was found; fewer bars might do)",
        "{what}（已找到的最佳方案；或许更少的钢筋即可）",
    ),
    "repair.disposal_plan": Sentence(
        "a disposal plan (特殊处理方案) agreed with the designer is needed",
        "须与设计单位商定特殊处理方案",
    ),
    "repair.no_bars_found": Sentence(
        "no set of bars was found whose bending would let the column in: {plan}",
        "没有找到弯筋后可就位的方案：{plan}",
    ),
    "repair.no_bend_helps": Sentence(
        "no bend helps: {rebar} over its ribs and its lean takes more room than {sleeve} has",
        "弯筋无效：{rebar} 连同肋和倾斜所需空间大于 {sleeve} 的净空",
    ),
    "repair.not_in_advice": Sentence(
        "not measured, and not in this advice: {labels}",
        "未测得，不在本建议内：{labels}",
    ),
    "repair.reject": Sentence("reject the position of {sleeve}: {why}", "不接受 {sleeve} 的位置：{why}"),
    "repair.rescan": Sentence(
        "rescan closer: at the measured values the column goes in, no bar has to be bent",
        "靠近重新扫描：按实测值可以就位，无需弯筋",
    ),
    "repair.sleeve_off": Sentence(
        "{sleeve} is {off_mm:.2f} mm off the place that the other sleeves give it, {rebar} is not",
        "{sleeve} 偏离其余套筒给出的位置 {off_mm:.2f} mm，{rebar} 未偏离",
    ),
    "repair.still_beyond": Sentence(
        "{what}. Still beyond its own limit of position then: {labels}",
        "{what}。处理后仍超出自身位置限值：{labels}",
    ),
    "repair.still_beyond.several": Sentence(
        "{what}. Still beyond their own limit of position then: {labels}",
        "{what}。处理后仍超出自身位置限值：{labels}",
    ),
    "repair.then_from_design": Sentence(
        "{rebar} then is {after_mm:.2f} mm from design, {limit}",
        "处理后 {rebar} 偏离设计位置 {after_mm:.2f} mm，{limit}",
    ),
    "repair.too_far": Sentence("{rebar} would have to move {length_mm:.1f} mm", "{rebar} 须移动 {length_mm:.1f} mm"),
    "repair.too_far.no_rule": Sentence(
        "{rebar} would have to move {length_mm:.1f} mm, and the profile does not say how far a bar may be bent",
        "{rebar} 须移动 {length_mm:.1f} mm，而规范没有给出钢筋允许弯移多少",
    ),
}
