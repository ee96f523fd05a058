"""What contradicts the design, what was declared, or the camera; the rest of a code is what a finding is about."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

_INTRINSICS = Sentence(
    "the intrinsics that the camera's software exports with the scans (Mech-Eye, Zivid: Camera Intrinsics; Photoneo: "
    "Camera Matrix; RealSense: Intrinsics)",
    "相机软件随扫描导出的内参（Mech-Eye、Zivid：Camera Intrinsics；Photoneo：Camera Matrix；RealSense：Intrinsics）",
)
_RESOLUTION = Sentence(
    "another resolution (Zivid: Sampling, Resampling; Photoneo: Resolution)",
    "另一分辨率（Zivid：Sampling、Resampling；Photoneo：Resolution）",
)
_NO_FILLING = Sentence(
    "Mech-Eye: Gap Filling = Off; Photoneo: Hole Filling = off; Zivid: Hole > Repair = off; RealSense: Hole Filling "
    "Filter = off",
    "Mech-Eye：Gap Filling 设为 Off；Photoneo：关闭 Hole Filling；Zivid：关闭 Hole > Repair；RealSense：关闭 Hole "
    "Filling Filter",
)
_NO_SMOOTHING = Sentence(
    "Mech-Eye: Surface Smoothing = Off; Photoneo: Surface Smoothness = Sharp; Zivid: Smoothing > Gaussian = off; "
    "RealSense: Spatial Filter = off",
    "Mech-Eye：Surface Smoothing 设为 Off；Photoneo：Surface Smoothness 设为 Sharp；Zivid：关闭 Smoothing > "
    "Gaussian；RealSense：关闭 Spatial Filter",
)
_DEPTH_UNIT = Sentence(
    "what the camera's software states (Mech-Eye: Unit; Photoneo and Zivid store millimetres; RealSense: Depth Units)",
    "请按相机软件给出的值填写（Mech-Eye：Unit；Photoneo 和 Zivid 以毫米存储；RealSense：Depth Units）",
)

SENTENCES: dict[str, Sentence] = {
    "finding.camera_bends": Sentence(
        "views of the {group:word} differ by what turns with the camera: it bends its picture by up to {bend_mm:.2f} "
        "mm (u {u_mm:.2f} mm), more than the stated uncertainty of {stated_u_mm:.2f} mm leaves open. Take the "
        "intrinsics and the lens correction that belong to this camera, have it calibrated, or learn a profile of it",
        "{group:word}的各视图之间存在随相机转动的差异：相机使图像畸变达 {bend_mm:.2f} mm（u {u_mm:.2f} mm），"
        "超出所给不确定度 {stated_u_mm:.2f} mm 的范围。请采用该相机自己的内参和镜头校正，送检标定，或学习其相机档案",
    ),
    "finding.common_lean.camera": Sentence(
        "all sleeves lean by {sleeves_deg:.1f}° and all bars by {rebars_deg:.1f}° towards the same side of their "
        "images: the principal point of the camera (cx, cy in [camera]) is not that of these scans, or the image "
        f"was cropped; take {_INTRINSICS.en}",
        "全部套筒倾斜 {sleeves_deg:.1f}°、全部钢筋倾斜 {rebars_deg:.1f}°，且朝向图像同一侧：相机主点（[camera] "
        f"中的 cx、cy）与扫描不符，或图像被裁剪过；请采用{_INTRINSICS.zh}",
    ),
    "finding.common_lean.rebar": Sentence(
        "all bars lean alike by {lean_deg:.1f}° against the floor: they stand so, the floor is not level, or the "
        "principal point of the camera (cx, cy) is wrong: hold a spirit level to one of them, "
        f"and take {_INTRINSICS.en}",
        "全部钢筋相对楼面同向倾斜 {lean_deg:"
        f".1f}}°：可能确实如此，或楼面不平，或相机主点（cx、cy）有误：请用水平尺量一根，并采用{_INTRINSICS.zh}",
    ),
    "finding.common_lean.sleeve": Sentence(
        "all sleeves lean alike by {lean_deg:.1f}° against the foot's face: they are cast in so, the face is not "
        "square to the column, or the principal point of the camera (cx, cy) is wrong: measure one with a square, and "
        f"take {_INTRINSICS.en}",
        "全部套筒相对柱底面同向倾斜 {lean_deg:"
        ".1f}°：可能预埋如此，或柱底面与柱轴线不垂直，或相机主点（cx、cy）有误：请用角尺量一个，"
        f"并采用{_INTRINSICS.zh}",
    ),
    "finding.diameter_differs.other_sleeves": Sentence(
        "sleeves of {design_mm:g} mm are designed, but the mouths on their places measure {measured_mm:.1f} mm: "
        "measure one with a calliper",
        "设计为 {design_mm:g} mm 套筒，而各位置上的套筒口实测 {measured_mm:.1f} mm：请用卡尺量一个",
    ),
    "finding.diameter_differs.others": Sentence(
        "bars of {design_mm:g} mm are designed, but those that stand in the scan measure {measured_mm:.1f} mm "
        "across the core; sizes that would fit: {seems:word}",
        "设计为 {design_mm:g} mm 钢筋，而扫描中的钢筋芯部实测 {measured_mm:.1f} mm；相符的规格：{seems:word}",
    ),
    "finding.diameter_differs.rebar": Sentence(
        "{about:word} measure {measured_mm:.1f} mm (±{U_mm:.1f} mm) across the core, bars of {design_mm:g} mm are "
        "designed, whose cores have {least_mm:.1f} to {most_mm:.1f} mm; sizes that would fit: {seems:word}. "
        "Another size, caps, burrs or mortar on the tops, or a scale that is wrong: look at the bars",
        "{about:word}芯部实测 {measured_mm:.1f} mm（±{U_mm:.1f} mm），设计为 {design_mm:g} mm 钢筋，其芯径为 "
        "{least_mm:.1f} 至 {most_mm:.1f} mm；相符的规格：{seems:word}。"
        "可能是规格不同、端部有保护帽、毛刺或砂浆，或比例有误：请查看钢筋",
    ),
    "finding.diameter_differs.sleeve": Sentence(
        "{about:word} measure {measured_mm:.1f} mm (±{U_mm:.1f} mm) inside at the mouth, {design_mm:g} mm are "
        "designed (±{play_mm:.1f} mm). Another size, grout or tape at the rim, a camera that loses the edges, or "
        "a wrong scale: measure one with a calliper",
        "{about:word}套筒口内径实测 {measured_mm:.1f} mm（±{U_mm:.1f} mm），设计为 {design_mm:g} "
        "mm（±{play_mm:.1f} mm）。可能是规格不同、口部有灰浆或胶带、相机丢失边缘，或比例有误：请用卡尺量一个",
    ),
    "finding.duplicate_global_id": Sentence(
        "the GlobalId of {about:word} is that of another element of the model too: results are not written where "
        "it is not sure which one is meant; export the model with a GlobalId for each element",
        "{about:word}的 GlobalId 与模型中其他构件重复：无法确定是哪一个时不写入结果；请重新导出模型，使每个构件的 "
        "GlobalId 唯一",
    ),
    "finding.edge_chipped": Sentence(
        "at the edge {side} a piece is missing, {length_mm:.0f} mm long and {depth_mm:.0f} mm deep, at {at_mm:+.0f} mm "
        "along the edge, counter-clockwise from its middle",
        "{side} 边缺损，长 {length_mm:.0f} mm、深 {depth_mm:.0f} mm，位于该边中点起逆时针 {at_mm:+.0f} mm 处",
    ),
    "finding.edges_fattened": Sentence(
        "in the scan of the {group:word} the pixels at edges and gaps repeat the depths of their neighbours: what "
        "is near was carried over what lies behind it, or over what was not measured, and edges stand where "
        "nothing is. Turn this off in the camera's software (hole filling with the nearest or the left neighbour, "
        f"dilation, edge padding; {_NO_FILLING.en}) and scan again",
        "{group:word}的扫描在边缘和空缺处重复相邻像素的深度：近处表面被延伸到其后方或未测得之处，边缘因此移位。"
        f"请在相机软件中关闭以最近点或左邻点补洞、膨胀、边缘扩展（{_NO_FILLING.zh}）后重新扫描",
    ),
    "finding.exposed_length_differs.long": Sentence(
        "{about:word} sticks out {measured_mm:.0f} mm where {expected_mm:.0f} mm are expected ({of:word}): it may "
        "strike the end of its sleeve before the column is down",
        "{about:word}外露 {measured_mm:.0f} mm，应为 {expected_mm:.0f} mm（{of:word}）：柱未落位前可能顶到套筒底",
    ),
    "finding.exposed_length_differs.short": Sentence(
        "{about:word} sticks out {measured_mm:.0f} mm where {expected_mm:.0f} mm are expected ({of:word}): it is "
        "cut off or bent away, and does not reach as far into its sleeve as it must",
        "{about:word}外露 {measured_mm:.0f} mm，应为 {expected_mm:.0f} mm（{of:"
        "word}）：被截断或弯倒，伸入套筒的长度不足",
    ),
    "finding.face_not_flat": Sentence(
        "the face of the foot is uneven by {range_mm:.1f} mm (±{U_mm:.1f} mm; limit {limit_mm:g} mm, unverified): look "
        "at the map of its heights, the column may rock on its shims",
        "柱底面不平整，高差 {range_mm:.1f} mm（±{U_mm:.1f} mm；限值 {limit_mm:g} mm，未核实）："
        "请查看高差图，柱可能在垫片上晃动",
    ),
    "finding.gaps_filled": Sentence(
        "the scan of the {group:word} has surfaces where nothing is, between edges and what lies behind them: "
        "what was not measured was filled in, or edges were fattened. Turn hole filling off in the camera's "
        f"software (interpolation, dilation; {_NO_FILLING.en}) and scan again",
        "{group:word}的扫描在边缘与其后方之间有并不存在的表面：未测得处被填补，或边缘被加粗。"
        f"请在相机软件中关闭孔洞填充（补洞、插值、膨胀；{_NO_FILLING.zh}）后重新扫描",
    ),
    "finding.hoisting_frames_contradict": Sentence(
        "{source} (near = {near}) and {other} (near = {other_near}) contradict each other: they agree once one of "
        "them is turned by {turn_deg:.0f}°. Correct near of the frame that was taken from another corner",
        "{source}（near = {near}）与 {other}（near = {other_near}）相互矛盾：将其一转 {turn_deg:.0f}° 后才一致。"
        "请改正从另一角拍摄的那一帧的 near",
    ),
    "finding.hoisting_frames_contradict.pairs": Sentence(
        "{source} (near = {near}) and {other} (near = {other_near}) contradict each other: their pairs do not "
        "stand to each other alike. Correct near of the frame that was taken from another corner, or see whether "
        "a bar was bent in between",
        "{source}（near = {near}）与 {other}（near = {other_near}）相互矛盾：各对之间的相对位置不一致。"
        "请改正从另一角拍摄的那一帧的 near，或查看其间是否有钢筋被碰弯",
    ),
    "finding.hoisting_turn_doubtful": Sentence(
        "in {source} the column or the camera is {turn_deg:.0f}° off what near = {near} claims, nearly half-way "
        "to the next turn: turn the column nearer to its place, or correct near, and take another frame",
        "{source} 中，柱或相机与 near = {near} 相差 {turn_deg:.0f}°，接近下一种转位：请先将柱转近就位方向或改正 "
        "near，再拍一帧",
    ),
    "finding.mirrored": Sentence(
        "the scan of the {group:word} is mirrored: its points fit the pattern only as in a mirror. The picture "
        "was flipped when it was stored, or the cloud has an axis the wrong way round: store it as the camera gives it "
        "(flip, mirror and rotate off)",
        "{group:word}的扫描是镜像的：各点只有镜像后才与布置吻合。存图时被翻转，或点云的某轴方向反了："
        "请按相机原样存储（关闭 flip、mirror、rotate，即翻转、镜像、旋转）",
    ),
    "finding.other_column": Sentence(
        "the scan of the {group:word} does not show this column: its points fit the design of {column}. Name the file "
        "of this column in the job",
        "{group:word}的扫描不是这根柱：各点与 {column} 的设计吻合。请在任务中指定本柱的文件",
    ),
    "finding.pattern_off_section": Sentence(
        "the sleeves as a group sit {dx_mm:+.1f}, {dy_mm:+.1f} mm (±{U_mm:.1f} mm) and {turn_deg:+.2f}° from their "
        "place in the section: erected on its bars the column's faces are off by as much the other way (limit "
        "{limit_mm:g} mm, unverified)",
        "整组套筒在截面内偏离设计位置 {dx_mm:+.1f}、{dy_mm:+.1f} mm（±{U_mm:.1f} mm），转角 {turn_deg:+.2f}°："
        "按钢筋就位后，柱侧面将反向偏移同样的量（限值 {limit_mm:g} mm，未核实）",
    ),
    "finding.profile_differs": Sentence(
        "at the edges of the {group:word} this camera does not do what the profile of [camera] says: they are seen "
        "{off_pixels:+.1f} pixels off. Another camera, other settings or filters than it was learned with: name the "
        "right profile, or learn it anew",
        "在{group:word}边缘，该相机的表现与 [camera] 中的相机档案不符：边缘偏离 {off_pixels:+.1f} 像素。"
        "可能是另一台相机，或设置、滤波与学习时不同：请指定正确的档案，或重新学习",
    ),
    "finding.profile_of_other_laws": Sentence(
        "the profile of [camera] was learned by laws {laws:g} of extraction (0: not told), {group:word} are measured "
        "by laws {now:g}: what it takes off is no longer quite what they leave. Learn it from the same captures",
        "[camera] 中的相机档案按提取规则 {laws:g}（0 表示未注明）学习，而{group:word}按规则 {now:g} 测量："
        "其修正量已不完全适用。请用同一批采集重新学习",
    ),
    "finding.same_scan_twice.column": Sentence(
        "one file is named twice for this column ({source}): one of its scans is missing",
        "本柱有一个文件被指定了两次（{source}）：缺少一个扫描",
    ),
    "finding.same_scan_twice.columns": Sentence(
        "the scan of the {group:word} ({source}) is the same file as that of {others}: at least one of them was "
        "not scanned",
        "{group:word}的扫描（{source}）与 {others} 的是同一个文件：至少有一个没有扫描",
    ),
    "finding.scale_differs.bores": Sentence(
        "what was scanned of the {groups:word}, patterns and bores together, is {scale:.4f} times as large as designed "
        "(±{U:.4f}): the intrinsics of the camera (focal length fx, fy in [camera]) or the unit are wrong; no position "
        f"in these scans is to be trusted before that is settled. Take {_INTRINSICS.en}",
        "{groups:word}的扫描（布置与套筒内径合计）为设计尺寸的 {scale:.4f} 倍（±{U:.4f}）：相机内参（[camera] 中的焦距 "
        f"fx、fy）或单位有误；查明之前，这些扫描的位置均不可信。请采用{_INTRINSICS.zh}",
    ),
    "finding.scale_differs.camera": Sentence(
        "the patterns of sleeves and rebars are both {scale:.4f} times as large as designed (±{U:.4f}): the "
        "intrinsics of the camera (focal length fx, fy in [camera]) or the unit are wrong; no position in these "
        f"scans is to be trusted before that is settled. Take {_INTRINSICS.en}",
        "套筒与钢筋的布置尺寸同为设计的 {scale:.4f} 倍（±{U:.4f}）：相机内参（[camera] 中的焦距 "
        f"fx、fy）或单位有误；查明之前，这些扫描的位置均不可信。请采用{_INTRINSICS.zh}",
    ),
    "finding.scale_differs.column": Sentence(
        "the patterns of sleeves and rebars differ in scale by {difference:.4f} (±{U:.4f}): one of the two scans, "
        f"or one of the two templates, is too large. See that both have {_INTRINSICS.en}",
        "套筒与钢筋的布置比例相差 {difference:.4f}（±{U:.4f}）：两个扫描之一或两个模板之一偏大。"
        f"请核对两个扫描是否都采用{_INTRINSICS.zh}",
    ),
    "finding.scale_differs.focal": Sentence(
        "the {group:word} lie on their design, with their sizes, once the focal length is taken as {times:.2g} "
        f"times what the job says: fx and fy in [camera] are those of another camera, or of {_RESOLUTION.en}; "
        f"take {_INTRINSICS.en}",
        "只有把焦距取为任务所给的 {times:.2g} 倍时，{group:word}的位置和尺寸才与设计吻合：[camera] 中的 fx、fy "
        f"是另一台相机或{_RESOLUTION.zh}的内参；请采用{_INTRINSICS.zh}",
    ),
    "finding.scale_differs.group": Sentence(
        "the pattern of the {group:word} is {scale:.4f} times as large as designed (±{U:.4f}): the intrinsics of "
        "the camera (focal length fx, fy in [camera]) or the unit are wrong, or the template was; no position in "
        f"this scan is to be trusted before that is settled. Take {_INTRINSICS.en}",
        "{group:word}的布置尺寸为设计的 {scale:.4f} 倍（±{U:.4f}）：相机内参（[camera] 中的焦距 "
        f"fx、fy）或单位有误，或模板有误；查明之前，该扫描的位置均不可信。请采用{_INTRINSICS.zh}",
    ),
    "finding.scale_differs.unit": Sentence(
        "the {group:word} lie on their design, with their sizes, once all lengths of the scan are divided by "
        "{factor:.3g}: the depth scale (depth_scale_mm in [camera]) or the unit is wrong; write "
        f"{_DEPTH_UNIT.en}",
        "只有把扫描的全部长度除以 {factor:.3g} 时，{group:word}的位置和尺寸才与设计吻合：深度比例（[camera] 中的 "
        f"depth_scale_mm）或单位有误；{_DEPTH_UNIT.zh}",
    ),
    "finding.section_size_differs": Sentence(
        "the section measures {measured_mm:.1f} mm (±{U_mm:.1f} mm) between its edges {between}, {design_mm:g} mm are "
        "designed (±{limit_mm:g} mm, unverified)",
        "截面两边 {between} 间实测 {measured_mm:.1f} mm（±{U_mm:.1f} mm），设计为 {design_mm:g} mm"
        "（±{limit_mm:g} mm，未核实）",
    ),
    "finding.sleeves_by_design": Sentence(
        "the method {method} lays the sleeves where the design has them and measures none: this is a baseline of the "
        "literature and no check of this column; use refined",
        "{method} 方法按设计位置放置套筒，未测量任何套筒：这只是文献基准方法，不能作为本柱的检查；请使用 refined",
    ),
    "finding.smoothed": Sentence(
        "the scan of the {group:word} was smoothed: its noise is shared by neighbouring pixels, and edges run "
        "into each other. Turn smoothing off in the camera's software (surface smoothing, Gaussian, median or "
        f"spatial filter; {_NO_SMOOTHING.en}) and scan again",
        "{group:word}的扫描被平滑过：相邻像素的噪声相同，边缘相互渗混。"
        f"请在相机软件中关闭平滑（表面平滑、高斯、中值或空间滤波；{_NO_SMOOTHING.zh}）后重新扫描",
    ),
    "finding.swapped": Sentence(
        "the scans of the sleeves and of the rebars are swapped: each shows what the other should. Exchange the two "
        "files in the job",
        "套筒与钢筋的扫描弄反了：各自显示的是对方的内容。请在任务中对调这两个文件",
    ),
    "finding.swapped.one": Sentence(
        "the scan named for the {group:word} ({source}) shows the {others:word}: another file is meant",
        "为{group:word}指定的扫描（{source}）显示的是{others:word}：应为另一个文件",
    ),
    "finding.turn_contradicted": Sentence(
        "the {group:word} contradict the declared up of {declared_deg:.0f}°: they fit only with "
        "{fitting_deg:.0f}° at the top of the image, to {fitting_mm:.2f} mm. Correct up in the job, or see "
        "whether they are built so",
        "{group:word}与任务中的 up = {declared_deg:.0f}° 矛盾：只有图像上方为 {fitting_deg:.0f}° 时才吻合，均方根 "
        "{fitting_mm:.2f} mm。请改正 up，或查看是否就是这样施工的",
    ),
    "finding.turn_contradicted.worse": Sentence(
        "the {group:word} contradict the declared up of {declared_deg:.0f}°: with {fitting_deg:.0f}° at the top "
        "of the image they fit to {fitting_mm:.2f} mm, as declared only to {declared_mm:.2f} mm. Correct up in "
        "the job, or see whether they are built so",
        "{group:word}与任务中的 up = {declared_deg:.0f}° 矛盾：图像上方为 {fitting_deg:.0f}° 时均方根 "
        "{fitting_mm:.2f} mm，按指定则为 {declared_mm:.2f} mm。请改正 up，或查看是否就是这样施工的",
    ),
    "finding.turn_doubtful": Sentence(
        "the {group:word} lie {off_deg:.0f}° off the declared up, nearly half-way to the next turn that fits: "
        "which point is which hangs on that; hold the camera upright, or correct up",
        "{group:word}与任务中的 up 相差 {off_deg:.0f}°，接近下一种吻合的转位：各点编号取决于此；请摆正相机，或改正 up",
    ),
}
