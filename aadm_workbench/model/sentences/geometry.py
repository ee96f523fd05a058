"""Why a body of a model could not be evaluated, or makes no sense."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "geometry.bounded_by": Sentence("#{id} is bounded by {type}", "#{id} 以 {type} 为界"),
    "geometry.context": Sentence(
        "context #{id} is a part of itself or of none",
        "上下文 #{id} 是自身的一部分或不属于任何上下文",
    ),
    "geometry.curved": Sentence("#{id} is curved", "#{id} 是曲面"),
    "geometry.cut": Sentence("#{id} is cut by a plane that reaches only so far", "#{id} 被一个有限平面切割"),
    "geometry.disk_turned": Sentence("a disk is turned about an axis in itself", "圆盘绕自身内的轴旋转"),
    "geometry.far": Sentence(
        "a point lies {distance:g} away, beyond all maps",
        "有点位于 {distance:g} 之外，超出任何地图",
    ),
    "geometry.grid_curved": Sentence("grid axis {axis} is not straight", "轴线 {axis} 不是直线"),
    "geometry.item": Sentence("#{id} {type}: {why}", "#{id} {type}：{why}"),
    "geometry.left_out": Sentence(
        "{type} {global_id}: its geometry was left out: {why}",
        "{type} {global_id}：其几何未采用：{why}",
    ),
    "geometry.legs": Sentence("#{id} {type} has more than {most} legs", "#{id} {type} 的折线段多于 {most}"),
    "geometry.made_of": Sentence(
        "#{id} {type} is made of more than {most} pieces",
        "#{id} {type} 由多于 {most} 块组成",
    ),
    "geometry.nested": Sentence("#{id} {type} is nested too deeply", "#{id} {type} 嵌套过深"),
    "geometry.no_crossing": Sentence("#{id} names two grid axes that do not cross", "#{id} 所指的两条轴线不相交"),
    "geometry.no_disk": Sentence(
        "#{id} sweeps a profile that is no disk about its directrix",
        "#{id} 沿准线扫掠的截面不是圆盘",
    ),
    "geometry.no_end": Sentence(
        "#{id} {type} comes to no end in the geometry kernel",
        "#{id} {type} 在几何内核中未能算完",
    ),
    "geometry.no_evaluation": Sentence("#{id} {type} cannot be evaluated", "#{id} {type} 无法求值"),
    "geometry.no_full_turn": Sentence("#{id} is no full turn", "#{id} 不是整圈"),
    "geometry.no_grid": Sentence("a grid axis belongs to no grid", "某轴线不属于任何轴网"),
    "geometry.no_length": Sentence("a direction has no length", "某方向长度为零"),
    "geometry.no_trim": Sentence("#{id} has no trim", "#{id} 没有裁剪"),
    "geometry.none": Sentence("has no geometry that could be evaluated", "没有可求值的几何"),
    "geometry.none.since": Sentence("has no geometry that could be evaluated ({why})", "没有可求值的几何（{why}）"),
    "geometry.not_evaluated": Sentence("#{id} {type} is not evaluated", "#{id} {type} 无法求值"),
    "geometry.not_tried": Sentence(
        "#{id} {type} was not tried: others came to no end",
        "#{id} {type} 未尝试：其他几何未能算完",
    ),
    "geometry.nothing": Sentence("#{id} {type} encloses nothing", "#{id} {type} 没有围成任何体积"),
    "geometry.own_crossing": Sentence("#{id} points at the crossing that it stands on", "#{id} 指向自身所在的交点"),
    "geometry.own_mapped": Sentence("#{id} IfcMappedItem is a part of itself", "#{id} IfcMappedItem 是自身的一部分"),
    "geometry.own_part": Sentence("#{id} {type} is a part of itself", "#{id} {type} 是自身的一部分"),
    "geometry.own_placement": Sentence("placement #{id} is relative to itself", "定位 #{id} 相对于自身"),
    "geometry.parallel": Sentence("a placement's axes are parallel", "某定位的两轴平行"),
    "geometry.pieces": Sentence("it is drawn in more than {most} pieces", "分成多于 {most} 块绘制"),
    "geometry.scales": Sentence("#{id} scales by {scale:g}", "#{id} 缩放 {scale:g} 倍"),
    "geometry.size": Sentence("#{id} {type} has a size of {size:g}", "#{id} {type} 的尺寸为 {size:g}"),
    "geometry.tapers": Sentence("#{id} tapers", "#{id} 有锥度"),
    "geometry.tapers_aslant": Sentence("#{id} tapers aslant", "#{id} 斜向收缩"),
    "geometry.trimmed_by_points": Sentence(
        "#{id} trims {type} by points, which is not evaluated",
        "#{id} 以点裁剪 {type}，无法求值",
    ),
    "geometry.turns": Sentence("#{id} {type} goes around {turns:g} times", "#{id} {type} 绕了 {turns:g} 圈"),
    "geometry.unsound_body": Sentence("a body of it has no extent, or lies nowhere", "某实体没有范围，或不在任何位置"),
    "geometry.unsound_far": Sentence("it lies beyond all maps", "位于任何地图之外"),
    "geometry.unsound_left_out": Sentence(
        "{type} {called} was left out, wholly or in part: {why}",
        "{type} {called} 全部或部分未采用：{why}",
    ),
    "geometry.unsound_more": Sentence("{count} more elements were left out", "另有 {count} 个构件未采用"),
    "geometry.unsound_no_area": Sentence("its profile has no area", "其截面没有面积"),
    "geometry.unsound_no_corner": Sentence(
        "a face of it names a corner that is not in its list of points",
        "某面所指的角点不在其点表中",
    ),
    "geometry.unsound_no_depth": Sentence("its extrusion has no depth", "其拉伸没有深度"),
    "geometry.unsound_no_faces": Sentence("it has no faces", "没有面"),
    "geometry.unsound_no_line": Sentence("it is swept along a line without length", "沿没有长度的线扫掠"),
    "geometry.unsound_placement": Sentence("its placement makes no sense", "其定位没有意义"),
    "geometry.unsound_size": Sentence("its {what} is {size_mm:g} mm", "其 {what} 为 {size_mm:g} mm"),
    "geometry.unsound_turned_no_area": Sentence("what it turns has no area", "所旋转的截面没有面积"),
}
