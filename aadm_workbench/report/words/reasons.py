"""The sentences of a check in Chinese.

report.json says in English why something is no pass. Each fragment that a sentence is made of has its Chinese; what is
not known stays as it is, so that nothing is lost.
"""

from __future__ import annotations

import re

from aadm_workbench.report.words.findings import finding_in_chinese
from aadm_workbench.report.words.labels import Phrase
from aadm_workbench.report.words.scans import FRAGMENTS as FRAGMENTS_OF_SCANS

_NUMBER = r"[-+±]?[\d.]+"
_LABEL = r"[SR]\d+"

_WHICH = "各套筒的编号未定:请给出 near,即离相机最近的钢筋角"

# Longer fragments stand before those that they contain.
_FRAGMENTS: tuple[tuple[str, str], ...] = (
    (rf"({_LABEL}) is ({_NUMBER}) mm from the centre of ({_LABEL})", r"\1 距 \3 中心 \2 mm"),
    (rf"({_LABEL}) is ({_NUMBER}) mm from its place in the building", r"\1 偏离建筑中的应有位置 \2 mm"),
    (rf"({_LABEL}) is ({_NUMBER}) mm from design", r"\1 偏离设计位置 \2 mm"),
    (rf"({_LABEL}) then is ({_NUMBER}) mm from design", r"处理后 \1 偏离设计位置 \2 mm"),
    (rf"({_LABEL})–({_LABEL}) are spaced ({_NUMBER}) mm from design", r"\1–\2 间距与设计相差 \3 mm"),
    (rf"({_LABEL}) sticks out ({_NUMBER}) mm, ({_NUMBER}) mm from design", r"\1 外露 \2 mm,与设计相差 \3 mm"),
    (
        rf"({_LABEL}) collides with ({_LABEL}): ({_NUMBER}) mm of room are missing over the ribs",
        r"\1 与 \2 碰撞:肋外净空差 \3 mm",
    ),
    (
        rf"({_LABEL}) is ({_NUMBER}) mm off the place that the other sleeves give it, ({_LABEL}) is not",
        r"\1 偏离其余套筒给出的位置 \2 mm,\3 未偏离",
    ),
    (
        rf"({_LABEL}) is in the way: it stands ({_NUMBER}) mm off the place that the other bars give it",
        r"\1 挡住就位:偏离其余钢筋给出的位置 \2 mm",
    ),
    (
        rf"({_LABEL}) is in the way: it stands ({_NUMBER}) mm off the place that the other sleeves give it",
        r"\1 挡住就位:偏离其余套筒给出的位置 \2 mm",
    ),
    (rf"all bars lean alike by ({_NUMBER})°", r"全部钢筋同向倾斜 \1°"),
    (rf"all sleeves lean alike by ({_NUMBER})°", r"全部套筒同向倾斜 \1°"),
    (
        r": they may do so, or the vertical of their scan is off by as much",
        ":可能确实如此,也可能是扫描的竖直方向偏了同样的角度",
    ),
    (
        r"; as measured the trial comes to (\w+), without that to (\w+)",
        r";按实测预拼装结论为 \1,扣除后为 \2",
    ),
    (rf"({_LABEL}) is in the way: ", r"\1 挡住就位:"),
    (rf"its lean alone takes more room than ({_LABEL}) has", r"仅其倾斜就超出 \1 的净空"),
    (
        rf"over its ribs and its lean it takes more room than ({_LABEL}) has",
        r"连同肋和倾斜所需空间大于 \1 的净空",
    ),
    (
        rf"({_LABEL}) stands ({_NUMBER}) mm off the place that the other bars give it",
        r"\1 偏离其余钢筋给出的位置 \2 mm",
    ),
    (
        rf"({_LABEL}) stands ({_NUMBER}) mm off the place that the other sleeves give it",
        r"\1 偏离其余套筒给出的位置 \2 mm",
    ),
    (
        rf"({_LABEL}) has ({_NUMBER}) mm of room left in ({_LABEL}) over the ribs: too little for its uncertainty",
        r"\1 在 \3 中肋外净空只剩 \2 mm:小于其不确定度所需",
    ),
    (rf"; no room over the ribs in ((?:{_LABEL}(?:, )?)+)", r";\1 中没有肋外净空"),
    (
        rf": rescan closer, above all ({_LABEL}) \(u = ({_NUMBER}) mm\) and ({_LABEL}) \(u = ({_NUMBER}) mm\)",
        r":请靠近重新扫描,首先是 \1(u = \2 mm)和 \3(u = \4 mm)",
    ),
    (
        rf": rescan closer, above all ({_LABEL}) \(u = ({_NUMBER}) mm\)",
        r":请靠近重新扫描,首先是 \1(u = \2 mm)",
    ),
    (r", but what was hardly seen does not pass", ",但未看清的点不能判为合格"),
    (r", too close to the limit for the uncertainty", ",不确定度下过于接近限值"),
    (
        r"\. Still beyond (?:its|their) own limit of position then: ((?:R\d+(?:, )?)+)",
        r"。处理后仍超出自身位置限值:\1",
    ),
    (
        rf": too close to it for an uncertainty of ({_NUMBER}) mm, rescan closer",
        r":不确定度 \1 mm,过于接近限值,请靠近重新扫描",
    ),
    (rf": too close to it for an uncertainty of ({_NUMBER}) mm", r":不确定度 \1 mm,过于接近限值"),
    (r": rescan closer$", ":请靠近重新扫描"),
    (rf"the probability that a pose exists is ({_NUMBER}) %", r"可就位概率 \1 %"),
    (r"no pose brings every rebar into its sleeve", "不存在使全部钢筋进入套筒的位置"),
    (rf"largest distance ({_NUMBER}) mm", r"最大中心距 \1 mm"),
    (rf", limit ({_NUMBER}) mm", r",限值 \1 mm"),
    (rf", limit ({_NUMBER} … {_NUMBER}) mm", r",限值 \1 mm"),
    (
        r"not seen: what is only inferred does not pass, look from another corner",
        "未见到:仅靠推断不能判为合格,请从另一角拍摄",
    ),
    (r"not seen: where it was measured before hoisting", "未见到:取吊装前的测量位置"),
    (r"not seen: inferred from the others", "未见到:由其余各点推断"),
    (r"it is open which sleeve is which: say near, the corner of the bars nearest to the camera", _WHICH),
    (rf"({_LABEL}) moved ({_NUMBER}) mm", r"\1 移动了 \2 mm"),
    (r" since the scan from before hoisting", "(与吊装前的扫描相比)"),
    (rf"; look at ((?:{_LABEL}(?:, )?)+), which the frame does not show", r";请查看画面未见到的 \1"),
    (
        r"only (\d+) sleeves can be measured: their mouths are covered, hidden, too far away or seen too flat",
        r"只能测量 \1 个套筒:套筒口被遮盖、被遮挡、太远或视角太平",
    ),
    (r"recorded, not live", "记录,并非实时"),
    (r"when the frame was captured is not known: take a new one", "不知该帧的拍摄时间:请重新拍摄"),
    (r"the frame's time lies (\d+) s ahead: set the clocks alike", r"该帧的时间超前 \1 s:请校准时钟"),
    (r"captured (\d+) s ago: take a new frame", r"拍摄于 \1 s 前:请重新拍摄"),
    (
        r"moving: wait for three frames that tell where it comes to rest",
        "正在移动:请等待三帧以判断其静止位置",
    ),
    (r"seen in fewer than three frames: whether it moves is not known", "不足三帧:尚不知是否在移动"),
    (
        rf"swings by ({_NUMBER}) mm, ({_NUMBER}) mm off at rest",
        r"摆动 \1 mm,静止位置偏差 \2 mm",
    ),
    (r": let it come to rest", ":请等其静止"),
    (r"only (\d+) pairs are seen: three decide where the column goes", r"只见到 \1 对:至少三对才能决定移动"),
    (rf"({_LABEL}) decides where the column goes, and is not seen", r"\1 决定移动而未见到"),
    (r"the tilt of the column is not known", "不知柱的倾斜"),
    (
        rf"tilted by ({_NUMBER})°: on its way down that moves the foot by ({_NUMBER}) mm",
        r"倾斜 \1°:下放时柱底会偏移 \2 mm",
    ),
    (r"no limit is given", "未给出限值"),
    (r"the frame does not pass", "该帧不合格"),
    (rf"({_LABEL}) not measured: ", r"\1 未测到:"),
    (rf"not measured: ((?:{_LABEL}(?:, )?)+)", r"未测到:\1"),
    (
        r"the picture is out of focus: surfaces bend at their edges over several pixels; "  # noqa: ISC004
        r"move the camera to its working distance, or focus it, and scan again",
        "图像失焦:表面边缘在数个像素内弯曲;请将相机移至工作距离或重新对焦后再扫描",
    ),
    (
        r"the camera smoothed this scan: its surfaces run into each other at their edges",
        "相机平滑了该扫描:表面在边缘相互渗混",
    ),
    (
        r"the camera filled in what it did not measure: surfaces lie where nothing is",
        "相机填补了未测到之处:出现并不存在的表面",
    ),
    (
        r"the camera copied depths over the edges of this scan: its surfaces are larger than what was measured",
        "相机把深度复制到了该扫描的边缘之外:表面比实测的大",
    ),
    (r"no opening: the mouth is plugged or covered", "没有开口:套筒口被堵塞或遮盖"),
    (r"too little of the mouth's rim is seen to measure it", "套筒口边缘可见部分太少,无法测量"),
    (r"outside of what the scan shows of the foot", "在扫描到的柱底范围之外"),
    (r"outside of what the scan shows", "在扫描范围之外"),
    (r"no bar stands there, or it is hidden from the camera", "该处没有钢筋,或被遮挡"),
    (r"its top could not be measured: too little of its outline is seen", "钢筋顶面轮廓可见部分太少,无法测量"),
    (
        r"the verdict depends on how the column is turned, which the scan does not show",
        "结论取决于柱的转位,扫描中看不出",
    ),
    (r"the pattern fits in (\d+) turns", r"布置在 \1 种转位下都吻合"),
    (r"what was seen of the pattern fits in (\d+) places of it", r"所见部分与布置的 \1 处都吻合"),
    (r": scan it with both of its ends, ", ":请连同两端一起扫描,"),
    (r"or in views that share three points and more", "或使各视角至少共有三点"),
    (r"in the first of these places: ", "按其中第一处:"),
    (
        r"the points it shares with the others differ by more than their uncertainty: it is open which they are",
        "与其余视角共有的点之差超出不确定度,无法确定对应关系",
    ),
    (
        r"it is open which points it shares with the others: it lies on them in (\d+) ways",
        r"与其余视角共有哪些点不能确定:有 \1 种可能",
    ),
    (r"view (\d+) was left out: ", r"第 \1 个视角未采用:"),
    (r", but their mirror image does: the scan is mirrored", ",但其镜像吻合:扫描是镜像的"),
    (r", or it was taken from the other side than supposed", ",或从相反一侧拍摄"),
    (
        r"the (\d+) points found do not fit the pattern of the (\d+) design points",
        r"找到的 \1 个点与设计的 \2 个点不吻合",
    ),
    (r"declare up to settle which", "请在任务中指定 up"),
    (r"in the first of these turns: ", "按第一种转位:"),
    (r"the pattern contradicts the declared up of ", "布置与指定的 up 矛盾:"),
    (r"absolute position not checked: the job gives no control points", "未检查绝对位置:任务没有控制点"),
    (r"absolute position not checked", "未检查绝对位置"),
    (r"the design gives no exposed length", "设计没有给出外露长度"),
    (r"the scan does not show the floor", "扫描中看不到楼面"),
    (r"the job names no scan of its sleeves or rebars", "任务没有给出套筒或钢筋的扫描文件"),
    (r"ends or breaks off within its header", "文件在文件头中断"),
    (r"breaks off", "文件不完整"),
    (r"; copy it again", ";请重新拷贝"),
    (r"diameter over the ribs after ", "肋外径取自 "),
    (r"in none of the (\d+) views", r"\1 个视角中都未见"),
    (r"neither a limit of the distance nor the room over the ribs is known", "既无中心距限值,也不知肋外净空"),
    (r"bend (R\d+) by \((\S+), (\S+)\) mm", r"将 \1 弯移 (\2, \3) mm"),
    (r"subject to the engineer's release: ", "须经工程师批准:"),
    (r" and set it upright", ",并扶直"),
    (rf"\. Then the largest distance is ({_NUMBER}) mm", r"。处理后最大中心距 \1 mm"),
    (r"reject the position of (S\d+): ", r"不接受 \1 的位置:"),
    (r"rescan closer; if that confirms it, ", "靠近重新扫描;若结果相同,"),
    (
        r"rescan closer: at the measured values the column goes in, no bar has to be bent",
        "靠近重新扫描:按实测值可以就位,无需弯筋",
    ),
    (
        r"no bend can be advised; a disposal plan \(特殊处理方案\) agreed with the designer is needed",
        "不能建议弯筋;须与设计单位商定特殊处理方案",
    ),
    (r"a disposal plan \(特殊处理方案\) agreed with the designer is needed", "须与设计单位商定特殊处理方案"),
    (r"no set of bars was found whose bending would let the column in: ", "没有找到弯筋后可就位的方案:"),
    (r", unverified", ",未核对"),
    (r"displaced alike in (\d+) columns: ", r"\1 根柱中一致偏移:"),
    (rf"(S\d+) by \(({_NUMBER}), ({_NUMBER})\) mm", r"\1 偏移 (\2, \3) mm"),
    (r"; look at the mould", ";请检查模具"),
    (r"no sleeve is displaced alike in these (\d+) columns", r"这 \1 根柱中没有一致偏移的套筒"),
    (r"\. scatters more than the others: ", "。离散大于其他套筒:"),
    (r"; look at its fixing", ";请检查其固定"),
    (rf"\(scatter ({_NUMBER}) mm per axis\)", r"(每轴离散 \1 mm)"),
    (r"not found in the scan", "扫描中未找到"),
)
_LONGEST_SENTENCE = 1000
"""Characters: ours have at most some hundred, and patterns take a time that grows with their square."""

_COMPILED = [(re.compile(pattern), chinese) for pattern, chinese in (*FRAGMENTS_OF_SCANS, *_FRAGMENTS)]


def in_both_languages(sentence: str) -> Phrase:
    """A sentence of report.json, and its Chinese as far as its fragments are known."""
    if len(sentence) > _LONGEST_SENTENCE:
        return Phrase(sentence, sentence)
    chinese = finding_in_chinese(sentence)
    for pattern, replacement in _COMPILED:
        chinese = pattern.sub(replacement, chinese)
    return Phrase(sentence, chinese)
