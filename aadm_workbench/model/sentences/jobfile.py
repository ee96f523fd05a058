"""What is said of job files and tolerance profiles that cannot be used."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "jobfile.at_line": Sentence("{file}, line {line}: {what}", "{file} 第 {line} 行：{what}"),
    "jobfile.camera": Sentence("[camera] {why}", "[camera] 中{why}"),
    "jobfile.check_twice": Sentence('checks holds "{check}" twice', "checks 中“{check}”出现两次"),
    "jobfile.control_character": Sentence(
        "{key} holds the control character {sign}; take it out of the "
        "name, and write paths of Windows with / or in single quotes",
        "{key} 含有控制字符 {sign}；请将其去掉，Windows 路径请用 / 或写在单引号中",
    ),
    "jobfile.control_character.plain": Sentence(
        "{key} holds the control character {sign}; take it out",
        "{key} 含有控制字符 {sign}；请将其去掉",
    ),
    "jobfile.control_no_model": Sentence(
        "control point {name}: this column has its own design and no model; give column = [x, y, z] in mm",
        "控制点 {name}：该柱自带设计、没有模型；请给出 column = [x, y, z]（mm）",
    ),
    "jobfile.control_scan": Sentence(
        "control points are measured in the scan of the rebars: name that scan",
        "控制点在钢筋扫描中量测：请给出该扫描",
    ),
    "jobfile.control_twice": Sentence('two control points have the name "{name}"', "两个控制点同名“{name}”"),
    "jobfile.control_where": Sentence(
        "control point {name} must have either model or column = [x, y, z] in mm: where it is known to be",
        "控制点 {name} 须有 model 或 column = [x, y, z]（mm）之一：其已知位置",
    ),
    "jobfile.corner": Sentence(
        "near must be one of the corners {listed}, it is {shown}",
        "near 应为以下角之一：{listed}；现为 {shown}",
    ),
    "jobfile.direction": Sentence(
        '{key} must be "+x", "-x", "+y", "-y" or a number of degrees from +x, it is {shown}',
        '{key} 应为 "+x"、"-x"、"+y"、"-y" 或自 +x 起的角度，现为 {shown}',
    ),
    "jobfile.empty_list": Sentence(
        "{key} is an empty list; leave the key out, or name something",
        "{key} 为空列表；请去掉该键，或写入内容",
    ),
    "jobfile.empty_text": Sentence("{key} is empty", "{key} 为空"),
    "jobfile.hoisting": Sentence(
        "hoisting must hold files or {example}, not {shown}",
        "hoisting 应由文件或 {example} 组成，现为 {shown}",
    ),
    "jobfile.holds_no_text": Sentence(
        "{key} must hold texts in quotes, one is {shown}",
        "{key} 应由引号中的文本组成，其中一个为 {shown}",
    ),
    "jobfile.how_many_numbers": Sentence(
        "{key} must hold {count} numbers [{named}], it is {shown}",
        "{key} 应为 {count} 个数 [{named}]，现为 {shown}",
    ),
    "jobfile.lacks": Sentence("{table:word} has no {lacking}; add {what}", "{table:word}缺少 {lacking}；请加上 {what}"),
    "jobfile.long_id": Sentence(
        "the id has {count} characters, {most} are the most; call the column shorter",
        "id 有 {count} 个字符，最多 {most} 个；请缩短柱名",
    ),
    "jobfile.long_text": Sentence(
        "{key} has {count} characters, {most} are the most",
        "{key} 有 {count} 个字符，最多 {most} 个",
    ),
    "jobfile.many_columns": Sentence(
        "the job has {count} columns, {most} are the most; split it",
        "任务有 {count} 根柱，最多 {most} 根；请拆分",
    ),
    "jobfile.no_columns": Sentence(
        'the job has no columns; add [[columns]] with id = "..." and its scans',
        '任务中没有柱；请加入 [[columns]]，写明 id = "..." 及其扫描',
    ),
    "jobfile.no_design": Sentence(
        "column {name} has no design: add [columns.design] to it, or [model] with a path to the job",
        "柱 {name} 没有设计：请为其加上 [columns.design]，或在任务中加上带路径的 [model]",
    ),
    "jobfile.no_file": Sentence("{file}: there is no such job file", "{file}：没有这个任务文件"),
    "jobfile.no_toml": Sentence(
        "{file}, line {line}: this is no TOML: {what}", "{file} 第 {line} 行：不是 TOML：{what}"
    ),
    "jobfile.no_toml.backslashes": Sentence(
        "{file}, line {line}: this is no TOML: {what}; write paths of Windows with / or in single quotes",
        "{file} 第 {line} 行：不是 TOML：{what}；Windows 路径请用 / 或写在单引号中",
    ),
    "jobfile.not_above_zero": Sentence("{key} must be above zero, it is {value:g}", "{key} 应大于零，现为 {value:g}"),
    "jobfile.not_boolean": Sentence(
        "{key} must be true or false, it is {shown}",
        "{key} 应为 true 或 false，现为 {shown}",
    ),
    "jobfile.not_list": Sentence("{key} must be a list of texts, it is {shown}", "{key} 应为文本列表，现为 {shown}"),
    "jobfile.not_lists": Sentence(
        "{key} must be a list of lists, it is {shown}",
        "{key} 应为由列表组成的列表，现为 {shown}",
    ),
    "jobfile.not_number": Sentence("{key} must be a number, it is {shown}", "{key} 应为一个数，现为 {shown}"),
    "jobfile.not_one_of": Sentence(
        "{key} must be {choices:or}, it is {shown}", "{key} 应为 {choices:or}，现为 {shown}"
    ),
    "jobfile.not_table": Sentence(
        "{key} must be a table {called}, it is {shown}", "{key} 应为表 {called}，现为 {shown}"
    ),
    "jobfile.not_tables": Sentence(
        "{key} must be written as {called}, a table each",
        "{key} 应写作 {called}，每项一个表",
    ),
    "jobfile.not_text": Sentence("{key} must be text in quotes, it is {shown}", "{key} 应为引号中的文本，现为 {shown}"),
    "jobfile.not_text_or_list": Sentence(
        "{key} must be text in quotes or a list of texts, it is {shown}",
        "{key} 应为引号中的文本或文本列表，现为 {shown}",
    ),
    "jobfile.not_utf8": Sentence(
        "{file}, line {line}: this is not UTF-8 text; save the job as UTF-8",
        "{file} 第 {line} 行：不是 UTF-8 文本；请以 UTF-8 保存任务",
    ),
    "jobfile.not_whole": Sentence(
        "{key} must be a whole number above zero, it is {shown}",
        "{key} 应为大于零的整数，现为 {shown}",
    ),
    "jobfile.one_control_point": Sentence(
        "one control point gives no position: add two more that span a triangle",
        "一个控制点定不出位置：请再加两个，三点成三角形",
    ),
    "jobfile.report_no_toml": Sentence(
        "{file}: is no TOML ({error}); repeat the check", "{file}：不是 TOML（{error}）；请重新检查"
    ),
    "jobfile.same_id": Sentence(
        'two columns have the id "{id}": the other stands in line {line}',
        "两根柱的 id 同为“{id}”：另一根在第 {line} 行",
    ),
    "jobfile.scale_error": Sentence(
        "scale_error must not be below zero, it is {value:g}",
        "scale_error 不得小于零，现为 {value:g}",
    ),
    "jobfile.schema": Sentence(
        "schema must be 1, it is {shown}; another one needs another version of aadm",
        "schema 应为 1，现为 {shown}；其他值需要其他版本的 aadm",
    ),
    "jobfile.set_pose": Sentence(
        "set_pose must lie within ±{most:g} mm and degrees: no play is as large",
        "set_pose 应在 ±{most:g} mm 与度以内：没有这么大的间隙",
    ),
    "jobfile.too_deep": Sentence(
        "{file}: is nested deeper than any job; write it anew", "{file}：嵌套过深，不像任何任务；请重新编写"
    ),
    "jobfile.too_deep_line": Sentence(
        "{file}, line {line}: is nested deeper than any job; write it anew",
        "{file} 第 {line} 行：嵌套过深，不像任何任务；请重新编写",
    ),
    "jobfile.too_large": Sentence(
        "{file}: has {size} bytes, {most} are the most; split the job",
        "{file}：有 {size} 字节，最多 {most}；请拆分任务",
    ),
    "jobfile.unknown_check": Sentence(
        'checks holds "{check}"; it may hold {listed}',
        "checks 含有“{check}”；可选：{listed}",
    ),
    "jobfile.unknown_key": Sentence(
        'unknown key "{key}" in {table:word}; {meant}',
        "{table:word}中有未知的键“{key}”；{meant}",
    ),
    "jobfile.unreadable": Sentence("the job file cannot be read: {error}", "任务文件无法读取：{error}"),
    "jobfile.profile_finite": Sentence("upper_mm and lower_mm must be finite", "upper_mm 和 lower_mm 必须是有限的数"),
    "jobfile.profile_kind": Sentence("kind: {limits} cannot be {kind}", "kind：{limits} 不能取 {kind}"),
    "jobfile.profile_missing": Sentence("the key {key} is missing", "缺少键 {key}"),
    "jobfile.profile_no_lower": Sentence(
        "lower_mm: a {kind} limit has no lower end", "lower_mm：{kind} 类限值没有下限"
    ),
    "jobfile.profile_no_rules": Sentence(
        "rules: a profile needs at least one [[rules]] table", "rules：允许偏差依据至少要有一个 [[rules]] 表"
    ),
    "jobfile.profile_no_toml": Sentence("not TOML: {why}", "不是 TOML：{why}"),
    "jobfile.profile_one_of": Sentence(
        "{key} must be one of {known}; it is {found}", "{key} 必须是 {known} 之一；现为 {found}"
    ),
    "jobfile.profile_order": Sentence(
        "lower_mm {lower} must be below upper_mm {upper}", "lower_mm {lower} 必须小于 upper_mm {upper}"
    ),
    "jobfile.profile_positive": Sentence(
        "upper_mm must be above zero, it is {upper}", "upper_mm 必须大于零，现为 {upper}"
    ),
    "jobfile.profile_same_name": Sentence("two rules have the name {name}", "有两条规则同名 {name}"),
    "jobfile.profile_schema": Sentence("schema must be 1, it is {found}", "schema 必须为 1，现为 {found}"),
    "jobfile.profile_unknown": Sentence(
        "Unknown tolerance profile {name}. Built in: {known}; or give the path of a .toml file.",
        "没有名为 {name} 的允许偏差依据。内置的有：{known}；也可给出 .toml 文件的路径。",
    ),
    "jobfile.profile_unknown_key": Sentence(
        "unknown key {key}; known are {known}", "未知的键 {key}；已知的键为 {known}"
    ),
    "jobfile.profile_unread": Sentence(
        "Tolerance profile {path} cannot be read: {why}", "允许偏差依据 {path} 无法读取：{why}"
    ),
}
