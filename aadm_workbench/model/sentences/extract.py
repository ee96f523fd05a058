"""Why a scan does not show what is to be measured in it."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "extract.blurred": Sentence(
        "the picture is out of focus: surfaces bend at their edges over several pixels; move the camera to its "
        "working distance, or focus it, and scan again",
        "图像失焦：表面边缘在数个像素内弯曲；请将相机移至工作距离或重新对焦后再扫描",
    ),
    "extract.by_design": Sentence("where the design has it, by the corners of the foot", "按设计位置，由柱底角点推得"),
    "extract.circle_through": Sentence("circle through {count:d} edge points", "过 {count:d} 个边缘点的圆"),
    "extract.copied": Sentence(
        "the camera copied depths over the edges of this scan: its surfaces are larger than what was measured",
        "相机把深度复制到了该扫描的边缘之外：表面比实测的大",
    ),
    "extract.corners_design": Sentence(
        "the corners method needs a design that places the sleeves in the section: use a model, or write size in "
        "[columns.design] with centres about the section's middle",
        "corners 方法需要设计给出套筒在截面内的位置：请使用模型，或在 [columns.design] 中写 size，且 centres "
        "以截面中心为原点",
    ),
    "extract.corners_few": Sentence(
        "{found:d} corners of the foot were found, two are needed: bring all of the foot into the picture",
        "只找到 {found:d} 个柱底角点，需要两个：请将整个柱底摄入画面",
    ),
    "extract.corners_turn": Sentence(
        "the corners fit in {ways:d} ways, and the sleeves lie differently in each: declare up",
        "角点有 {ways:d} 种吻合方式，套筒位置各不相同：请声明 up",
    ),
    "extract.corners_view": Sentence(
        "the corners method needs a scan that says from where it was taken",
        "corners 方法需要已知拍摄位置的扫描",
    ),
    "extract.cylinder": Sentence("cylinder through sides and rim", "过侧面和边缘的圆柱"),
    "extract.edges_and_sides": Sentence(
        "{edges:d} edge and {sides:d} side points",
        "{edges:d} 个边缘点和 {sides:d} 个侧面点",
    ),
    "extract.few_key_points": Sentence(
        "only {count} {what:word} were found, three are needed",
        "只找到 {count} 个{what:word}，需要三个",
    ),
    "extract.few_points": Sentence("the scan holds too few points", "扫描的点太少"),
    "extract.foot_out_of_view": Sentence("outside of what the scan shows of the foot", "在扫描到的柱底范围之外"),
    "extract.gaps_filled": Sentence(
        "the camera filled in what it did not measure: surfaces lie where nothing is",
        "相机填补了未测得之处：出现并不存在的表面",
    ),
    "extract.hough": Sentence("Hough circle in the {picture:word}", "{picture:word}中的霍夫圆"),
    "extract.image_needs": Sentence(
        "the image method needs an organised scan and the intrinsics of its camera",
        "image 方法需要有序扫描及其相机内参",
    ),
    "extract.image_size": Sentence("the picture and the depth map differ in size", "图像与深度图大小不同"),
    "extract.no_band": Sentence(
        "no empty band along y parts the foot from the bars",
        "沿 y 方向没有空隙把柱底与钢筋分开",
    ),
    "extract.no_bar": Sentence("no bar stands there, or it is hidden from the camera", "该处没有钢筋，或被遮挡"),
    "extract.no_bar_of_size": Sentence(
        "nothing that stands in the scan is a bar of the expected size",
        "扫描中没有预期规格的钢筋",
    ),
    "extract.no_circle.binary": Sentence(
        "the binary image shows no circle of the expected size",
        "二值图像中没有预期大小的圆",
    ),
    "extract.no_circle.edges": Sentence(
        "the edge points of the face show no circle of the expected size",
        "端面边缘点中没有预期大小的圆",
    ),
    "extract.no_circle.picture": Sentence(
        "the {picture:word} shows no circle of the expected size",
        "{picture:word}中没有预期大小的圆",
    ),
    "extract.no_face": Sentence("no flat foot face was found in the scan", "扫描中未找到平整的柱底面"),
    "extract.no_hole": Sentence(
        "the face shows no round hole of {diameter_mm:g} mm",
        "柱底面上没有 {diameter_mm:g} mm 的圆孔",
    ),
    "extract.no_measured_hole": Sentence(
        "no hole of {diameter_mm:g} mm in the face could be measured",
        "柱底面上 {diameter_mm:g} mm 的孔均无法测量",
    ),
    "extract.no_plane": Sentence("no plane was found in the scan", "扫描中未找到平面"),
    "extract.no_plane_in_range": Sentence(
        "no plane was found within the pass-through range",
        "直通滤波范围内未找到平面",
    ),
    "extract.no_round_mouth": Sentence(
        "the openings in the face are no round mouths of {diameter_mm:g} mm",
        "柱底面上的开口不是 {diameter_mm:g} mm 的圆形套筒口",
    ),
    "extract.no_round_top": Sentence(
        "what stands in the scan has no round top of {diameter_mm:g} mm",
        "扫描中立着的物体没有 {diameter_mm:g} mm 的圆形顶面",
    ),
    "extract.no_top": Sentence(
        "no bar of {diameter_mm:g} mm has a top that could be measured",
        "没有能测量顶面的 {diameter_mm:g} mm 钢筋",
    ),
    "extract.no_upright_bar": Sentence(
        "the scan shows no upright bar of {diameter_mm:g} mm",
        "扫描中没有直立的 {diameter_mm:g} mm 钢筋",
    ),
    "extract.not_found": Sentence("not found in the scan", "扫描中未找到"),
    "extract.out_of_view": Sentence("outside of what the scan shows", "在扫描范围之外"),
    "extract.plugged": Sentence("no opening: the mouth is plugged or covered", "没有开口：套筒口被堵塞或遮盖"),
    "extract.rim_unseen": Sentence(
        "too little of the mouth's rim is seen to measure it",
        "套筒口边缘可见部分太少，无法测量",
    ),
    "extract.same_key_points": Sentence("two key points are one and the same point", "两个关键点是同一点"),
    "extract.smoothed": Sentence(
        "the camera smoothed this scan: its surfaces run into each other at their edges",
        "相机平滑了该扫描：表面在边缘相互渗混",
    ),
    "extract.sparse": Sentence("the points are too sparse to show an edge", "点太稀疏，看不出边缘"),
    "extract.top_unseen": Sentence(
        "its top could not be measured: too little of its outline is seen",
        "钢筋顶面轮廓可见部分太少，无法测量",
    ),
    "extract.upright_cylinder": Sentence("upright cylinder through the rim of the top", "过顶面边缘的竖直圆柱"),
    "extract.walls_and_edges": Sentence(
        "{walls:d} wall and {edges:d} edge points at {pitch_mm:.2f} mm",
        "{walls:d} 个内壁点和 {edges:d} 个边缘点，间距 {pitch_mm:.2f} mm",
    ),
    "extract.section_askew": Sentence(
        "what ends the face here runs askew to the section: something hides a part of it",
        "此处底面的边界与截面不平行：有物遮挡",
    ),
    "extract.section_blurred": Sentence(
        "heights before this edge are disturbed over more than three pixels: the camera is out of focus there",
        "该边前三个像素以上的高度均受扰动：相机在此处失焦",
    ),
    "extract.section_border": Sentence(
        "a cloud without its camera does not tell an edge of the foot from the border of the picture",
        "没有相机参数的点云无法区分柱底边缘与画面边界",
    ),
    "extract.section_flush": Sentence(
        "something lies flush with the face beyond this edge",
        "该边之外有物与底面齐平",
    ),
    "extract.section_hidden": Sentence(
        "this edge is not straight, or something hides a part of it",
        "该边不直，或部分被遮挡",
    ),
    "extract.section_no_face": Sentence("no face was found", "未找到柱底面"),
    "extract.section_out": Sentence("too little of this edge is in the picture", "该边在画面内的部分太少"),
    "extract.section_thin": Sentence("too few points lie on the face", "柱底面上的点太少"),
}
