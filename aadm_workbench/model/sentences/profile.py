"""What is said of tolerance profiles that cannot be used."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "profile.finite": Sentence("upper_mm and lower_mm must be finite", "upper_mm 和 lower_mm 必须是有限的数"),
    "profile.kind": Sentence("kind: {limits} cannot be {kind}", "kind：{limits} 不能取 {kind}"),
    "profile.missing": Sentence("the key {key} is missing", "缺少键 {key}"),
    "profile.no_lower": Sentence("lower_mm: a {kind} limit has no lower end", "lower_mm：{kind} 类限值没有下限"),
    "profile.no_rules": Sentence(
        "rules: a profile needs at least one [[rules]] table", "rules：允许偏差依据至少要有一个 [[rules]] 表"
    ),
    "profile.no_toml": Sentence("not TOML: {why}", "不是 TOML：{why}"),
    "profile.one_of": Sentence(
        "{key} must be one of {known}; it is {found}", "{key} 必须是 {known} 之一；现为 {found}"
    ),
    "profile.order": Sentence(
        "lower_mm {lower} must be below upper_mm {upper}", "lower_mm {lower} 必须小于 upper_mm {upper}"
    ),
    "profile.positive": Sentence("upper_mm must be above zero, it is {upper}", "upper_mm 必须大于零，现为 {upper}"),
    "profile.same_name": Sentence("two rules have the name {name}", "有两条规则同名 {name}"),
    "profile.schema": Sentence("schema must be 1, it is {found}", "schema 必须为 1，现为 {found}"),
    "profile.unknown": Sentence(
        "Unknown tolerance profile {name}. Built in: {known}; or give the path of a .toml file.",
        "没有名为 {name} 的允许偏差依据。内置的有：{known}；也可给出 .toml 文件的路径。",
    ),
    "profile.unknown_key": Sentence("unknown key {key}; known are {known}", "未知的键 {key}；已知的键为 {known}"),
    "profile.unread": Sentence("Tolerance profile {path} cannot be read: {why}", "允许偏差依据 {path} 无法读取：{why}"),
}
