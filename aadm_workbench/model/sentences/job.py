"""What is said of a column whose design the job gives."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "job.centre": Sentence(
        "Centre {number} of column {column} is {centre}: it must be two numbers [x, y] in mm.",
        "柱 {column} 的中心 {number} 为 {centre}：应为两个数 [x, y]，单位 mm。",
    ),
    "job.empty_place": Sentence(
        "{key} of column {column} has an empty place: give one length for each centre.",
        "柱 {column} 的 {key} 有空位：请为每个中心给出一个长度。",
    ),
    "job.length": Sentence(
        "{key} of column {column} is {value}: it must be a length in mm, above zero.",
        "柱 {column} 的 {key} 为 {value}：应为大于零的长度，单位 mm。",
    ),
    "job.lengths": Sentence(
        "{key} of column {column} lists {found} lengths for {count} centres: give one each, or one number.",
        "柱 {column} 的 {key} 列出 {found} 个长度，而中心有 {count} 个：请各给一个，或只给一个数。",
    ),
    "job.no_centres": Sentence(
        "The design of column {column} has no centres: give them as [[x, y], ...] in mm.",
        "柱 {column} 的设计没有 centres：请以 [[x, y], ...] 给出，单位 mm。",
    ),
    "job.no_sleeve_diameter": Sentence(
        "The design of column {column} has no sleeve_diameter (inner, at the mouth, mm): add it.",
        "柱 {column} 的设计没有 sleeve_diameter（套筒口内径，mm）：请补上。",
    ),
    "job.one_outer": Sentence(
        "The design of column {column} has bars of several sizes and one rebar_outer_diameter: give a list, one each.",
        "柱 {column} 的设计有多种规格的钢筋，却只有一个 rebar_outer_diameter：请给出列表，各一个。",
    ),
    "job.same_centre": Sentence(
        "Centres {first} and {second} of column {column} are the same point: remove one.",
        "柱 {column} 的中心 {first} 与 {second} 是同一点：请去掉一个。",
    ),
    "job.size": Sentence(
        "size of column {column} is {written}: it must be two lengths [x, y] in mm.",
        "柱 {column} 的 size 为 {written}：应为两个长度 [x, y]，单位 mm。",
    ),
    "job.too_wide": Sentence(
        "The design of column {column}, centre {number}: a bar of {widest_mm:g} mm does not enter a sleeve of "
        "{inner_mm:g} mm. sleeve_diameter is the inner diameter.",
        "柱 {column} 的设计，中心 {number}：{widest_mm:g} mm 的钢筋进不了 {inner_mm:g} mm 的套筒。sleeve_diameter "
        "是内径。",
    ),
}
