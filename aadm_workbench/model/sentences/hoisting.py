"""What is said of frames of a hanging column."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "hoisting.absent_bars": Sentence(
        "{absent} of {expected} bars that should be in view are not where the design has them: are they those of "
        "another column?",
        "应可见的 {expected} 根钢筋中有 {absent} 根不在设计位置：是否为另一根柱的钢筋？",
    ),
    "hoisting.ahead": Sentence(
        "the frame's time lies {ahead_s:.0f} s ahead: set the clocks alike",
        "该帧的时间超前 {ahead_s:.0f} s：请校准时钟",
    ),
    "hoisting.bars_unfit": Sentence(
        "the bars in the frame do not stand as the design says: are they those of another column?",
        "画面中的钢筋与设计布置不符：是否为另一根柱的钢筋？",
    ),
    "hoisting.close": Sentence(
        "{sleeve}-{rebar}: {distance_mm:.2f} mm, u = {u_mm:.2f} mm, is too close to the {clause}",
        "{sleeve}-{rebar}：{distance_mm:.2f} mm，u = {u_mm:.2f} mm，过于接近{clause}",
    ),
    "hoisting.closed": Sentence(
        "{labels:and} closed, in plain sight: take the tape, cap or mortar off and take a new frame",
        "{labels:and} 清楚可见但被封住：请清除胶带、盖帽或砂浆后重新拍摄",
    ),
    "hoisting.decides": Sentence("{label} decides where the column goes, and is not seen", "{label} 决定移动而未见到"),
    "hoisting.empty": Sentence(
        "the frame is empty: it holds too few points to show a column",
        "该帧为空：点太少，看不出柱",
    ),
    "hoisting.far": Sentence(
        "{sleeve} is {distance_mm:.2f} mm from {rebar}, {clause}",
        "{sleeve} 距 {rebar} {distance_mm:.2f} mm，{clause}",
    ),
    "hoisting.few_bars": Sentence(
        "only {count} bars are seen under the foot: too few to tell which is which",
        "柱底下方只见到 {count} 根钢筋：太少，无法对应",
    ),
    "hoisting.few_bars_measured": Sentence(
        "only {seen} bars under the foot can be measured",
        "柱底下方只能测量 {seen} 根钢筋",
    ),
    "hoisting.few_frames": Sentence(
        "seen in fewer than three frames: whether it moves is not known",
        "不足三帧：尚不知是否在移动",
    ),
    "hoisting.few_measured": Sentence(
        "only {seen} sleeves can be measured: their mouths are covered, hidden, too far away or seen too flat",
        "只能测量 {seen} 个套筒：套筒口被遮盖、被遮挡、太远或视角太平",
    ),
    "hoisting.few_pairs": Sentence(
        "only {count} pairs are seen: three decide where the column goes",
        "只见到 {count} 对：至少三对才能决定移动",
    ),
    "hoisting.few_sleeves": Sentence(
        "only {count} sleeves of the foot are seen: too few to tell how it hangs",
        "只见到柱底 {count} 个套筒：太少，无法判断柱的姿态",
    ),
    "hoisting.frame_no_pass": Sentence("the frame does not pass", "该帧不合格"),
    "hoisting.half": Sentence(
        "only {shown} of {count} sleeves are in what the frame shows: aim at the whole foot, move the camera "
        "back, or measure the column in two frames",
        "画面中只有 {count} 个套筒中的 {shown} 个：请对准整个柱底，将相机后移，或分两帧测量",
    ),
    "hoisting.inferred": Sentence(
        "{labels:and} not seen: inferred from the others",
        "未见到 {labels:and}：由其余各点推断",
    ),
    "hoisting.largest": Sentence(
        "largest distance {largest_mm:.1f} mm, limit {limit_mm:g} mm",
        "最大中心距 {largest_mm:.1f} mm，限值 {limit_mm:g} mm",
    ),
    "hoisting.look_again": Sentence(
        "{labels} not seen: what is only inferred does not pass, look from another corner",
        "未见到 {labels}：仅靠推断不能判为合格，请从另一角拍摄",
    ),
    "hoisting.missing": Sentence(
        "{labels:and} not there: the frame shows what lies behind its place",
        "{labels:and} 不在原处：画面中其位置后方清楚可见",
    ),
    "hoisting.moved": Sentence("{label} moved {moved_mm:.1f} mm", "{label} 移动了 {moved_mm:.1f} mm"),
    "hoisting.moved_since": Sentence("{points} since the scan from before hoisting", "{points}（与吊装前的扫描相比）"),
    "hoisting.moved_since.look": Sentence(
        "{points} since the scan from before hoisting; look at {labels}, which the frame does not show",
        "{points}（与吊装前的扫描相比）；请查看画面未见到的 {labels}",
    ),
    "hoisting.moving": Sentence(
        "moving: wait for three frames that tell where it comes to rest",
        "正在移动：请等待三帧以判断其静止位置",
    ),
    "hoisting.near_contradicted": Sentence(
        'near = "{said}" contradicts the bars in the frame: their pattern puts corner "{found}" next to the '
        "camera; correct near in the job, or see whether these are the bars of another column",
        'near = "{said}" 与画面中的钢筋矛盾：按其布置，离相机最近的是 "{found}" 角；请改正任务中的 '
        "near，或查看是否为另一根柱的钢筋",
    ),
    "hoisting.no_bar": Sentence("no bar of {bar_mm:g} mm is seen under the foot", "柱底下方没有 {bar_mm:g} mm 的钢筋"),
    "hoisting.no_foot": Sentence(
        "no foot of a column with sleeves of {diameter_mm:g} mm is seen in the frame: it is hidden, beside the "
        "picture, or seen flatter than about 5 degrees",
        "画面中没有带 {diameter_mm:g} mm 套筒的柱底：被遮挡、不在画面中，或视角小于约 5°",
    ),
    "hoisting.no_limit": Sentence("no limit is given", "未给出限值"),
    "hoisting.no_such_method": Sentence(
        "the method {method} measures no hanging columns; use refined",
        "{method} 方法不能测量悬吊中的柱；请使用 refined",
    ),
    "hoisting.no_tilt": Sentence("the tilt of the column is not known", "不知柱的倾斜"),
    "hoisting.no_time": Sentence(
        "when the frame was captured is not known: take a new one",
        "不知该帧的拍摄时间：请重新拍摄",
    ),
    "hoisting.no_viewpoint": Sentence(
        "the file does not tell where the camera stood: give [camera], or export it with its pose",
        "文件未说明相机位置：请给出 [camera]，或导出时带上位姿",
    ),
    "hoisting.not_measured": Sentence("not measured", "未测得"),
    "hoisting.not_seen": Sentence(
        "{labels} not seen: where it was measured before hoisting",
        "未见到 {labels}：取吊装前的测量位置",
    ),
    "hoisting.other_bars": Sentence(
        "the bars in the frame are {measured_mm:.1f} mm thick, the design's {diameter_mm:g} mm: are they those of "
        "another column?",
        "画面中的钢筋粗 {measured_mm:.1f} mm，设计为 {diameter_mm:g} mm：是否为另一根柱的钢筋？",
    ),
    "hoisting.other_sleeves": Sentence(
        "openings of {measured_mm:.1f} mm are seen in the foot, the design's sleeves have {diameter_mm:g} mm: is "
        "it another column?",
        "柱底所见开口为 {measured_mm:.1f} mm，设计套筒为 {diameter_mm:g} mm：是否为另一根柱？",
    ),
    "hoisting.plan_known": Sentence(
        "no place gives u = {wanted_u_mm:g} mm: take a larger u, or scan more surely before hoisting",
        "没有位置能达到 u = {wanted_u_mm:g} mm：请放宽 u，或在吊装前扫描得更准",
    ),
    "hoisting.plan_none": Sentence(
        "no place gives u = {wanted_u_mm:g} mm: {otherwise}",
        "没有位置能达到 u = {wanted_u_mm:g} mm：{otherwise}",
    ),
    "hoisting.plan_otherwise": Sentence(
        "take a larger u, or a longer lens; with scans from before hoisting, plan with --before",
        "请放宽 u，或换更长的镜头；有吊装前的扫描时，用 --before 规划",
    ),
    "hoisting.plan_short_lens": Sentence(
        "no place shows two thirds of the foot: take a shorter lens",
        "没有位置能看到柱底的三分之二：请换更短的镜头",
    ),
    "hoisting.plan_two": Sentence(
        "two frames do not see {lacking} at u = {wanted_u_mm:g} mm",
        "两帧仍不能以 u = {wanted_u_mm:g} mm 看到 {lacking}",
    ),
    "hoisting.recorded": Sentence("recorded, not live", "记录，并非实时"),
    "hoisting.repair": Sentence(
        "no move brings {label} in with the others: bend it by {dx_mm:+.1f}, {dy_mm:+.1f} mm (x, y of the bars)",
        "移动柱子无法使 {label} 与其他钢筋同时对准：请将其扳动 {dx_mm:+.1f}、{dy_mm:+.1f} mm（钢筋坐标系的 x、y）",
    ),
    "hoisting.repair.part": Sentence(
        "{mm:.1f} mm towards the side of {first} to {last}", "向 {first} 至 {last} 一侧 {mm:.1f} mm"
    ),
    "hoisting.repair.towards": Sentence(
        "no move brings {label} in with the others: bend it by {parts}",
        "移动柱子无法使 {label} 与其他钢筋同时对准：请将其扳动：{parts}",
    ),
    "hoisting.resting": Sentence(
        "{labels:and} not seen: where it was measured before hoisting",
        "未见到 {labels:and}：取吊装前的测量位置",
    ),
    "hoisting.sleeves_unfit": Sentence(
        "the sleeves in the frame do not lie as the design says: is it another column?",
        "画面中的套筒与设计布置不符：是否为另一根柱？",
    ),
    "hoisting.slid": Sentence(
        "a regular row is not seen whole: which point is which is open, show it from end to end",
        "等距的一排未全部见到：无法对应各点，请从一端到另一端完整拍摄",
    ),
    "hoisting.stale": Sentence("captured {age_s:.0f} s ago: take a new frame", "拍摄于 {age_s:.0f} s 前：请重新拍摄"),
    "hoisting.stray": Sentence(
        "{stray} openings of the foot lie where the design has no sleeve: is it another column?",
        "柱底有 {stray} 个开口不在设计的套筒位置上：是否为另一根柱？",
    ),
    "hoisting.swings": Sentence(
        "swings by {amplitude_mm:.1f} mm, {largest_mm:.1f} mm off at rest, limit {limit_mm:g} mm: let it come to rest",
        "摆动 {amplitude_mm:.1f} mm，静止位置偏差 {largest_mm:.1f} mm，限值 {limit_mm:g} mm：请等其静止",
    ),
    "hoisting.three_pairs": Sentence("the method measures three key pairs only", "该方法只测三对关键点"),
    "hoisting.tilted": Sentence(
        "tilted by {tilt_deg:.2f}°: on its way down that moves the foot by {aside_mm:.1f} mm",
        "倾斜 {tilt_deg:.2f}°：下放时柱底会偏移 {aside_mm:.1f} mm",
    ),
    "hoisting.turned_far": Sentence(
        "the column hangs turned by more than 45 degrees against its bars: turn it first",
        "柱相对钢筋转了 45° 以上：请先转正",
    ),
    "hoisting.unexpected_bars": Sentence(
        "{unexpected} bars stand where the design has none: are they those of another column?",
        "有 {unexpected} 根钢筋立在设计没有钢筋之处：是否为另一根柱的钢筋？",
    ),
    "hoisting.unpaired": Sentence("the design has not one bar for every sleeve", "设计中并非每个套筒都有一根钢筋"),
    "hoisting.which_sleeve": Sentence(
        "it is open which sleeve is which: say near, the corner of the bars nearest to the camera",
        "各套筒的编号未定：请给出 near，即离相机最近的钢筋角",
    ),
}
