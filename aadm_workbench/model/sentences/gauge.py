"""What is said of a gauge study: repeat captures of the same columns."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "gauge.few_parts": Sentence(
        "{quantity:word}: fewer than two were measured in every capture; a study wants ten",
        "{quantity:word}：每次采集都测得的不足两个；研究需要十个",
    ),
    "gauge.no_captures": Sentence(
        "a gauge study wants two captures of the same columns, or more; it was given {count}: name several jobs or "
        "reports, or a job whose columns list several scans",
        "量具研究需要对同一批柱至少采集两次，给出的是 {count} 次：请列出多个任务或报告，或其柱列有多个扫描的任务",
    ),
    "gauge.not_everywhere": Sentence(
        "not measured in every capture, so left out ({count}): {parts}",
        "并非每次采集都测得，故不计入（{count} 个）：{parts}",
    ),
    "gauge.one_capture": Sentence(
        "{quantity:word}: one capture alone by {operators}; nothing repeats it",
        "{quantity:word}：{operators} 只采集了一次，没有重复",
    ),
    "gauge.spare": Sentence(
        "captures beyond what every operator has, left out: {count}",
        "超出每位操作者共有次数、故不计入的采集：{count} 次",
    ),
    "gauge.u_believable": Sentence(
        "The stated uncertainty is believable on this camera: repeat captures scatter {ratio:.2f} times as much as it "
        "says (95 %: {low:.2f} to {high:.2f}).",
        "在这台相机上，所给不确定度可信：重复采集的离散是其所述的 {ratio:.2f} 倍（95 %：{low:.2f} 至 {high:.2f}）。",
    ),
    "gauge.u_covers": Sentence(
        "The stated uncertainty covers what repeats: captures scatter {ratio:.2f} times as much as it says (95 %: "
        "{low:.2f} to {high:.2f}); what all of them have in common, scale and edges, does not scatter, and may account "
        "for the rest.",
        "所给不确定度足以涵盖重复性：采集的离散是其所述的 {ratio:.2f} 倍（95 %：{low:.2f} 至 {high:.2f}）；"
        "各次采集共有的误差（尺度、边缘）不会离散，其余部分可能由此而来。",
    ),
    "gauge.u_not_stated": Sentence(
        "No uncertainty was stated, so none can be compared: the method that was used has none.",
        "未给出不确定度，无从比较：所用方法不提供不确定度。",
    ),
    "gauge.u_open": Sentence(
        "Not decided whether the stated uncertainty is believable: repeat captures scatter {ratio:.2f} times as much "
        "as it says (95 %: {low:.2f} to {high:.2f}); take more captures.",
        "尚不能判定所给不确定度是否可信：重复采集的离散是其所述的 {ratio:.2f} 倍（95 %：{low:.2f} 至 "
        "{high:.2f}）；请增加采集。",
    ),
    "gauge.u_too_small": Sentence(
        "The stated uncertainty is too small for this camera: repeat captures scatter {ratio:.2f} times as much as it "
        "says (95 %: {low:.2f} to {high:.2f}); look for what moves or is blurred, and do not trust verdicts "
        "near a limit.",
        "对这台相机而言所给不确定度偏小：重复采集的离散是其所述的 {ratio:.2f} 倍（95 %：{low:.2f} 至 {high:.2f}）；"
        "请查找松动或模糊之处，临近限值的判定不可信。",
    ),
}
