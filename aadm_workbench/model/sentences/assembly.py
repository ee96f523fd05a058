"""What is said of measured points against the design, and of the trial assembly."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "assembly.axes_not_told": Sentence(
        "the file does not tell how its axes run: the top of the picture was taken for -y of the file; write axes "
        '= "opengl" where it is +y',
        '文件未说明坐标轴方向：图像上方按文件的 -y 处理；若应为 +y，请写 axes = "opengl"',
    ),
    "assembly.bent": Sentence(
        "{rebars}: a lean of up to {lean_deg:.1f}° in what was seen, from {seen_mm:.0f} mm below the top on down they "
        "may stand upright: scan them further down",
        "{rebars}：可见部分倾斜达 {lean_deg:.1f}°，顶端以下 {seen_mm:.0f} mm 起可能是直立的：请扫描到更低处",
    ),
    "assembly.beyond": Sentence("{how}, limit {upper:g} mm ({clause})", "{how}，限值 {upper:g} mm（{clause}）"),
    "assembly.close": Sentence(
        "{what}: too close to it for an uncertainty of {u_mm:.2f} mm",
        "{what}：不确定度 {u_mm:.2f} mm，过于接近限值",
    ),
    "assembly.close_rescan": Sentence(
        "{what}: too close to it for an uncertainty of {u_mm:.2f} mm, rescan closer",
        "{what}：不确定度 {u_mm:.2f} mm，过于接近限值，请靠近重新扫描",
    ),
    "assembly.coincide": Sentence("the points that were found coincide", "找到的点重合"),
    "assembly.collides": Sentence(
        "{rebar} collides with {sleeve}: {missing_mm:.2f} mm of room are missing over the ribs",
        "{rebar} 与 {sleeve} 碰撞：肋外净空差 {missing_mm:.2f} mm",
    ),
    "assembly.common_lean": Sentence(
        "{found:and}: they may do so, or the vertical of their scan is off by as much",
        "{found:and}：可能确实如此，也可能是扫描的竖直方向偏了同样的角度",
    ),
    "assembly.depends_on_lean": Sentence(
        "{said}; as measured the trial comes to {as_measured:word}, without that to {without:word}",
        "{said}；按实测预拼装结论为{as_measured:word}，扣除后为{without:word}",
    ),
    "assembly.design_off": Sentence(
        "in the design itself {rebar} is {apart_mm:.2f} mm off {sleeve}, {limit}",
        "设计中 {rebar} 就偏离 {sleeve} {apart_mm:.2f} mm，{limit}",
    ),
    "assembly.displaced": Sentence(
        "{label} by ({dx_mm:+.2f}, {dy_mm:+.2f}) mm",
        "{label} 偏移 ({dx_mm:+.2f}, {dy_mm:+.2f}) mm",
    ),
    "assembly.displaced_alike": Sentence(
        "displaced alike in {columns} columns: {sleeves}; look at the mould",
        "{columns} 根柱中一致偏移：{sleeves}；请检查模具",
    ),
    "assembly.erected": Sentence("it is measured on the erected column", "须在安装后的柱上测量"),
    "assembly.extra": Sentence(
        "{count} further {kind:word} found that belong to no design point",
        "另找到 {count} 个{kind:word}不对应任何设计点",
    ),
    "assembly.few_points": Sentence(
        "only {count} points were found, {needed} are needed to lay them on the design",
        "只找到 {count} 个点，与设计对应至少需要 {needed} 个",
    ),
    "assembly.few_shared": Sentence(
        "it shares {shared} points with the others, {needed} are needed",
        "与其余视角只共有 {shared} 个点，至少需要 {needed} 个",
    ),
    "assembly.first_place": Sentence("in the first of these places: {why}", "按其中第一处：{why}"),
    "assembly.first_turn": Sentence("in the first of these turns: {why}", "按第一种转位：{why}"),
    "assembly.fit_coincide": Sentence("the {name:word} points coincide", "{name:word}点重合"),
    "assembly.fit_few_plane": Sentence(
        "{count} points given, a pose in the plane needs 2",
        "只有 {count} 个点，求平面位姿需要 2 个",
    ),
    "assembly.fit_few_space": Sentence(
        "{count} points given, a pose in space needs 3",
        "只有 {count} 个点，求空间位姿需要 3 个",
    ),
    "assembly.fit_weights": Sentence("weights must be {count:d} numbers, none negative", "权重须为 {count:d} 个非负数"),
    "assembly.fit_few_weights": Sentence("only {count} points have a weight", "只有 {count} 个点有权重"),
    "assembly.fit_not_finite": Sentence("a coordinate is not finite", "坐标不是有限数"),
    "assembly.fit_on_line": Sentence("the {name:word} points lie on one line", "{name:word}点在一条直线上"),
    "assembly.follows": Sentence("follows from {culprits:and}: {what}", "由 {culprits:and} 引起：{what}"),
    "assembly.from_centre": Sentence(
        "{rebar} is {distance_mm:.2f} mm from the centre of {sleeve}, {limit}",
        "{rebar} 距 {sleeve} 中心 {distance_mm:.2f} mm，{limit}",
    ),
    "assembly.from_design": Sentence(
        "{label} is {deviation_mm:.2f} mm from design, {limit}",
        "{label} 偏离设计位置 {deviation_mm:.2f} mm，{limit}",
    ),
    "assembly.from_to": Sentence("{lower:+g} to {upper:+g}", "{lower:+g} 至 {upper:+g}"),
    "assembly.from_zero": Sentence("0 to {upper:+g}", "0 至 {upper:+g}"),
    "assembly.hardly_seen": Sentence(
        "{text}, but what was hardly seen does not pass: rescan closer",
        "{text}，但未看清的点不能判为合格：请靠近重新扫描",
    ),
    "assembly.hardly_seen.above_all": Sentence(
        "{text}, but what was hardly seen does not pass: rescan closer, above all {points:and}",
        "{text}，但未看清的点不能判为合格：请靠近重新扫描，首先是 {points:and}",
    ),
    "assembly.in_no_view": Sentence("in none of the {views} views", "{views} 个视角中都未见"),
    "assembly.in_the_way": Sentence("{label} is in the way: {why}", "{label} 挡住就位：{why}"),
    "assembly.inscribed": Sentence(
        "the square inscribed in the circle of the limit: limit / sqrt(2)",
        "限值圆的内接正方形：限值 / √2",
    ),
    "assembly.largest": Sentence(
        "largest distance {largest_mm:.2f} mm, limit {limit_mm:g} mm",
        "最大中心距 {largest_mm:.2f} mm，限值 {limit_mm:g} mm",
    ),
    "assembly.largest.no_room": Sentence(
        "largest distance {largest_mm:.2f} mm, limit {limit_mm:g} mm; no room over the ribs in {sleeves}",
        "最大中心距 {largest_mm:.2f} mm，限值 {limit_mm:g} mm；{sleeves} 中没有肋外净空",
    ),
    "assembly.lean_alike": Sentence(
        "all {name:word} lean alike by {lean_deg:.1f}°",
        "全部{name:word}同向倾斜 {lean_deg:.1f}°",
    ),
    "assembly.lean_alone": Sentence(
        "its lean alone takes more room than {sleeve} has",
        "仅其倾斜就超出 {sleeve} 的净空",
    ),
    "assembly.limit": Sentence("limit {upper:g} mm ({clause})", "限值 {upper:g} mm（{clause}）"),
    "assembly.limit_per_axis": Sentence("the limit holds for each axis", "限值按每轴"),
    "assembly.little_room": Sentence(
        "{rebar} has {room_mm:.2f} mm of room left in {sleeve} over the ribs: too little for its uncertainty",
        "{rebar} 在 {sleeve} 中肋外净空只剩 {room_mm:.2f} mm：小于其不确定度所需",
    ),
    "assembly.mirrored": Sentence(
        "the {measured} points found do not fit the pattern of the {design} design points, but their mirror image "
        "does: the scan is mirrored, or it was taken from the other side than supposed",
        "找到的 {measured} 个点与设计的 {design} 个点不吻合，但其镜像吻合：扫描是镜像的，或从相反一侧拍摄",
    ),
    "assembly.missing": Sentence("not measured: {labels}", "未测得：{labels}"),
    "assembly.more": Sentence("and {count} more", "另有 {count} 项"),
    "assembly.mould": Sentence(
        "{parts:.} (scatter {scatter_mm:.2f} mm per axis)",
        "{parts:.}（每轴离散 {scatter_mm:.2f} mm）",
    ),
    "assembly.no_absolute_position": Sentence(
        "absolute position not checked: the job gives no control points",
        "未检查绝对位置：任务没有控制点",
    ),
    "assembly.no_camera": Sentence(
        "the cloud does not tell where its camera stood, so its edges are less certain; with [camera] and the "
        "camera's own depth map or cloud they are better",
        "点云未说明相机位置，边缘因此不太确定；给出 [camera]，并用相机自己的深度图或点云，结果会更好",
    ),
    "assembly.no_exposed_length": Sentence("the design gives no exposed length", "设计没有给出外露长度"),
    "assembly.no_floor": Sentence("the scan does not show the floor", "扫描中看不到楼面"),
    "assembly.no_limit": Sentence("no limit", "无限值"),
    "assembly.no_limit_nor_room": Sentence(
        "neither a limit of the distance nor the room over the ribs is known",
        "既无中心距限值，也不知肋外净空",
    ),
    "assembly.no_limit_nor_room.cell": Sentence(
        "neither a limit of the distance nor the room is known",
        "既无中心距限值，也不知净空",
    ),
    "assembly.no_pose": Sentence("no pose brings every rebar into its sleeve", "不存在使全部钢筋进入套筒的位置"),
    "assembly.no_position_limit": Sentence(
        "the profile has no limit for the position of sleeves",
        "规范没有给出套筒位置的限值",
    ),
    "assembly.no_probability": Sentence(
        "for lack of {labels} no probability that a pose exists is stated",
        "因缺少 {labels}，未给出可就位概率",
    ),
    "assembly.no_trial": Sentence(
        "no trial with {count} pairs of sleeve and rebar: {why}",
        "{count} 对套筒与钢筋无法试拼：{why}",
    ),
    "assembly.no_vertical": Sentence("the scan does not show which way is up", "扫描中看不出竖直方向"),
    "assembly.none_displaced": Sentence(
        "no sleeve is displaced alike in these {columns} columns",
        "这 {columns} 根柱中没有一致偏移的套筒",
    ),
    "assembly.none_found": Sentence("no {kind:word} was found in the scan", "扫描中未找到{kind:word}"),
    "assembly.not_measured": Sentence("{label} not measured: {why}", "{label} 未测得：{why}"),
    "assembly.of_no_pair": Sentence("it is no limit of a single pair", "它不是单对的限值"),
    "assembly.off_own_place": Sentence(
        "it stands {off_mm:.2f} mm off the place that the other {others:word} give it",
        "偏离其余{others:word}给出的位置 {off_mm:.2f} mm",
    ),
    "assembly.one_extra": Sentence(
        "{count} further {kind:word} found that belongs to no design point",
        "另找到 {count} 个{kind:word}不对应任何设计点",
    ),
    "assembly.open_shared": Sentence(
        "it is open which points it shares with the others: it lies on them in {ways} ways",
        "与其余视角共有哪些点不能确定：有 {ways} 种可能",
    ),
    "assembly.places": Sentence(
        "what was seen of the pattern fits in {count} places of it: scan it with both of its ends, or in views "
        "that share three points and more",
        "所见部分与布置的 {count} 处都吻合：请连同两端一起扫描，或使各视角至少共有三点",
    ),
    "assembly.probability": Sentence(
        "the probability that a pose exists is {percent:.1f} %",
        "可就位概率 {percent:.1f} %",
    ),
    "assembly.probability.of_measured": Sentence(
        "the probability that a pose exists for the pairs that were measured is {percent:.1f} %",
        "已测各对的可就位概率 {percent:.1f} %",
    ),
    "assembly.rebar_of": Sentence("the rebar of {sleeve}", "{sleeve} 的钢筋"),
    "assembly.ribs_after": Sentence("diameter over the ribs after {source}", "肋外径取自 {source}"),
    "assembly.ribs_and_lean": Sentence(
        "over its ribs and its lean it takes more room than {sleeve} has",
        "连同肋和倾斜所需空间大于 {sleeve} 的净空",
    ),
    "assembly.room_not_checked": Sentence(
        "clearance over the ribs not checked: the outer diameter of a bar is not known",
        "未检查肋外净空：不知某根钢筋的外径",
    ),
    "assembly.scatters": Sentence(
        "scatters more than the others: {sleeves}; look at its fixing",
        "离散大于其他套筒：{sleeves}；请检查其固定",
    ),
    "assembly.seen_length": Sentence(
        "of the embedded length of the bars {least_mm:.0f} to {most_mm:.0f} mm were seen; below, a bar is taken "
        "to be straight within 4 mm a metre (GB/T 1499.2-2018, 6.5, unverified)",
        "钢筋埋入长度中见到 {least_mm:.0f} 至 {most_mm:.0f} mm；其下按每米 4 mm 以内视为直筋（GB/T 1499.2-2018 第 "
        "6.5 条，未核对）",
    ),
    "assembly.shared_apart": Sentence(
        "the points it shares with the others lie up to {apart_mm:.2f} mm apart",
        "与其余视角共有的点相差达 {apart_mm:.2f} mm",
    ),
    "assembly.shared_differ": Sentence(
        "the points it shares with the others differ by more than their uncertainty: it is open which they are",
        "与其余视角共有的点之差超出不确定度，无法确定对应关系",
    ),
    "assembly.spaced": Sentence(
        "{first}–{second} are spaced {deviation_mm:+.2f} mm from design, limit {limits} mm ({clause})",
        "{first}–{second} 间距与设计相差 {deviation_mm:+.2f} mm，限值 {limits} mm（{clause}）",
    ),
    "assembly.stands_off": Sentence(
        "{label} stands {off_mm:.2f} mm off the place that the other {others:word} give it",
        "{label} 偏离其余{others:word}给出的位置 {off_mm:.2f} mm",
    ),
    "assembly.sticks_out": Sentence(
        "{label} sticks out {exposed_mm:.1f} mm, {deviation_mm:+.1f} mm from design, limit {limits} mm ({clause})",
        "{label} 外露 {exposed_mm:.1f} mm，与设计相差 {deviation_mm:+.1f} mm，限值 {limits} mm（{clause}）",
    ),
    "assembly.turn_decides": Sentence(
        "the verdict depends on how the column is turned, which the scan does not show",
        "结论取决于柱的转位，扫描中看不出",
    ),
    "assembly.turns": Sentence(
        "the pattern fits in {count} turns: declare up to settle which",
        "布置在 {count} 种转位下都吻合：请在任务中指定 up",
    ),
    "assembly.turns_at": Sentence(
        "the pattern fits in {count} turns (top of the image at {turns}): declare up to settle which",
        "布置在 {count} 种转位下都吻合（图像上方为 {turns}）：请在任务中指定 up",
    ),
    "assembly.turns_come_to": Sentence(
        "of {turns} turns of the bars against the sleeves: {found}",
        "钢筋相对套筒的 {turns} 种转位中：{found}",
    ),
    "assembly.undecided": Sentence(
        "{text}, too close to the limit for the uncertainty: rescan closer",
        "{text}，不确定度下过于接近限值：请靠近重新扫描",
    ),
    "assembly.undecided.above_all": Sentence(
        "{text}, too close to the limit for the uncertainty: rescan closer, above all {points:and}",
        "{text}，不确定度下过于接近限值：请靠近重新扫描，首先是 {points:and}",
    ),
    "assembly.unfit": Sentence(
        "the {measured} points found do not fit the pattern of the {design} design points",
        "找到的 {measured} 个点与设计的 {design} 个点不吻合",
    ),
    "assembly.unspaced": Sentence("{first}–{second}: {missing} was not measured", "{first}–{second}：{missing} 未测得"),
    "assembly.unsupported": Sentence(
        "this scan cannot support a decision on {limit_mm:g} mm: its centres have u = {u_mm:.2f} mm, rescan closer",
        "该扫描不足以判定 {limit_mm:g} mm：其中心 u = {u_mm:.2f} mm，请靠近重新扫描",
    ),
    "assembly.unverified": Sentence("{clause:word}, unverified", "{clause:word}，未核对"),
    "assembly.up_contradicted": Sentence(
        "the pattern contradicts the declared up of {said}°: it fits only with {actual}° at the top of the image, "
        "{turned:.0f}° away",
        "布置与指定的 up = {said}° 矛盾：只有图像上方为 {actual}° 时才吻合，相差 {turned:.0f}°",
    ),
    "assembly.up_contradicted.worse": Sentence(
        "the pattern contradicts the declared up of {said}°: it fits to {fitting_mm:.2f} mm with {actual}° at the "
        "top of the image, to {declared_mm:.2f} mm as declared",
        "布置与指定的 up = {said}° 矛盾：图像上方为 {actual}° 时均方根 {fitting_mm:.2f} mm，按指定则为 "
        "{declared_mm:.2f} mm",
    ),
    "assembly.up_says_nothing": Sentence(
        "up was declared, but the scan has no direction across the vertical that it could describe",
        "指定了 up，但扫描中没有可由它说明的横向",
    ),
    "assembly.verdict_in": Sentence("{verdict:word} in {count:d}", "{count:d} 种{verdict:word}"),
    "assembly.view_left_out": Sentence("view {view} was left out: {why}", "第 {view} 个视角未采用：{why}"),
    "assembly.with_u": Sentence("{label} (u = {u_mm:.2f} mm)", "{label} (u = {u_mm:.2f} mm)"),
    "assembly.section_both": Sentence(
        "both edges across {axes:and} have to be seen",
        "须看到 {axes:and} 方向的两条边",
    ),
    "assembly.section_edge": Sentence("edge {side}: {why}", "{side} 边：{why}"),
    "assembly.section_off": Sentence("{part}: {off_mm:+.1f} mm from design", "{part}：与设计相差 {off_mm:+.1f} mm"),
    "assembly.section_pattern": Sentence(
        "the sleeves sit {dx_mm:+.1f}, {dy_mm:+.1f} mm from their place in the section",
        "套筒组在截面内偏离 {dx_mm:+.1f}、{dy_mm:+.1f} mm",
    ),
    "assembly.section_rough": Sentence("a face that is roughened has no flatness", "粗糙面不评定平整度"),
    "assembly.eopa_shapes": Sentence(
        "EOPA needs two arrays of shape (n, {width}), row for row; got {first} and {second}",
        "EOPA 需要两个形状为 (n, {width}) 且逐行对应的数组；现为 {first} 与 {second}",
    ),
    "assembly.minimax_limits": Sentence(
        "minimax needs one limit above zero for each of the {count:d} points",
        "minimax 需要为 {count:d} 个点各给出一个大于零的限值",
    ),
}
