"""What is said of plates, of captures of them, and of what a camera was found to be."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "calibration.age_unknown": Sentence(
        "the camera's profile: [capture] gives no date, so nobody knows whether it is still valid",
        "相机档案：[capture] 未给出日期，无从得知档案是否仍然有效",
    ),
    "calibration.far_place": Sentence(
        "{label} is {off_mm:.2f} mm from its place on the drawing, or has no u above zero: check rows, axes and unit "
        "of the table",
        "{label} 偏离图纸位置 {off_mm:.2f} mm，或其 u 不大于零：请检查表格的行、坐标轴和单位",
    ),
    "calibration.few_places": Sentence(
        "a plate needs {fewest} holes and {fewest} pins, or more, each with a label of its own",
        "标定板需要至少 {fewest} 个孔和 {fewest} 个销，各有不同的标号",
    ),
    "calibration.far_profile": Sentence(
        "its scale, a stretch or a spread is no number, or above {most:g} %; use aadm camera learn again",
        "其尺度、伸长或差异不是数值，或大于 {most:g} %；请用 aadm camera learn 重新学习",
    ),
    "calibration.few_captures": Sentence(
        "a camera is learned from {fewest} captures of the plate or more, one turned by each quarter; "
        "these are {count}",
        "学习相机至少需要标定板的 {fewest} 次采集（每转 90° 一次）；给出的是 {count} 次",
    ),
    "calibration.few_holes": Sentence(
        "only {found} of the plate's {count} holes are seen: the whole plate must be in the picture",
        "标定板的 {count} 个孔只见到 {found} 个：整块板须在画面内",
    ),
    "calibration.holes": Sentence(
        "{count} holes make no square ring with pins between them: take 12, 16, 20 … up to {most}",
        "{count} 个孔不能排成中间有销的方环：请取 12、16、20……至多 {most}",
    ),
    "calibration.few_views": Sentence(
        "only {used:d} of the captures were matched and share {fewest:d} points or more; take two, and more points",
        "只有 {used:d} 次采集匹配成功且共有至少 {fewest:d} 个点；需要两次采集及更多的点",
    ),
    "calibration.no_camera_serial": Sentence(
        "the camera's profile: whether it is that of this camera is not known, a serial number is missing in "
        "[capture] or in the profile",
        "相机档案：[capture] 或档案中缺少序列号，无从得知是否属于这台相机",
    ),
    "calibration.no_grid": Sentence(
        "a camera is learned from depth maps, or clouds in the camera's grid, with intrinsics; name --camera FILE",
        "学习相机需要深度图或保持相机网格的点云，并有内参；请给出 --camera FILE",
    ),
    "calibration.no_holes": Sentence(
        "no holes of the plate are seen: {why}",
        "未见到标定板的孔：{why}",
    ),
    "calibration.no_pins": Sentence(
        "no pins of the plate are seen: {why}",
        "未见到标定板的销：{why}",
    ),
    "calibration.no_plate": Sentence(
        "this is no plate.toml ({why}); draw one with aadm camera plate",
        "这不是 plate.toml（{why}）；请用 aadm camera plate 绘制",
    ),
    "calibration.no_reversal": Sentence(
        "nothing was captured twice: {count} captures have no column's sleeves or rebars in common. Name two jobs or "
        "reports on the same columns, the camera turned by half a turn or moved across in between",
        "没有被采集两次的构件：{count} 次采集中没有同一柱的套筒或钢筋。请给出同一批柱的两个任务或报告，"
        "其间相机转动半圈或横移",
    ),
    "calibration.no_profile": Sentence(
        "this is no profile of a camera ({why}); make one with aadm camera learn",
        "这不是相机档案（{why}）；请用 aadm camera learn 生成",
    ),
    "calibration.no_room": Sentence(
        "a pitch of {pitch_mm:g} mm leaves no room for a pin between holes of {diameter_mm:g} mm: take a larger pitch",
        "间距 {pitch_mm:g} mm 在 {diameter_mm:g} mm 的孔之间放不下销：请加大间距",
    ),
    "calibration.no_settings": Sentence(
        "the camera's profile: whether it was learned with these settings is not known, they are missing in [capture] "
        "or in the profile",
        "相机档案：[capture] 或档案中缺少相机设置，无从得知是否以这些设置学得",
    ),
    "calibration.no_turn": Sentence(
        "how the plate is turned cannot be told from the {found} pins that are seen: all of them must be, and the "
        "plate be the one of the drawing",
        "由见到的 {found} 个销无法判断标定板的转位：须全部可见，且与图纸一致",
    ),
    "calibration.not_yet": Sentence(
        "the camera's profile was learned on {date}, after this capture",
        "相机档案于 {date} 学得，晚于本次采集",
    ),
    "calibration.other_camera_serial": Sentence(
        "the camera's profile is that of {known}, these scans are of {told}: learn this camera",
        "相机档案属于 {known}，而扫描来自 {told}：请对这台相机重新学习",
    ),
    "calibration.other_intrinsics": Sentence(
        "the job's own intrinsics are used; those of the camera's profile differ",
        "采用任务自己的内参；它与相机档案中的不同",
    ),
    "calibration.other_settings": Sentence(
        "the camera's profile was learned with the settings {known}, these scans were taken with {told}: learn them",
        "相机档案以设置 {known} 学得，而扫描使用 {told}：请以此设置重新学习",
    ),
    "calibration.no_table": Sentence(
        "{where} is no row of places ({why}); its columns are label, x_mm, y_mm, z_mm, diameter_mm, u_mm",
        "{where} 不是位置行（{why}）；各列为 label、x_mm、y_mm、z_mm、diameter_mm、u_mm",
    ),
    "calibration.scattered": Sentence(
        "the captures scatter by {noise_mm:.2f} mm, too much for how little the camera was turned or moved in between",
        "各次采集的离散为 {noise_mm:.2f} mm，而其间相机转动或移动太少，无法判断",
    ),
    "calibration.too_old": Sentence(
        "the camera's profile was {days} days old when this was captured, it is valid for {valid_days}: verify or "
        "learn the camera again",
        "采集时相机档案已有 {days} 天，有效期为 {valid_days} 天：请重新核查或学习相机",
    ),
    "calibration.unmoved": Sentence(
        "the camera stood alike in all captures: turn it by half a turn, or move it by a good part of the picture",
        "各次采集中相机位置相同：请将相机转动半圈，或横移画面的相当一部分",
    ),
    "calibration.no_log": Sentence(
        "is no log of aadm camera verify; name another one with --log",
        "不是 aadm camera verify 的记录；请用 --log 给出另一个",
    ),
}
