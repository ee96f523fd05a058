"""What is said of reports that cannot be used, and of the models and BCF files that results go into."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "report.bcf_no_markup": Sentence(
        "{place} is no markup of a topic, but <{tag}>; start a new BCF file",
        "{place} 不是议题的标记文件，而是 <{tag}>；请另建 BCF 文件",
    ),
    "report.bcf_no_topic": Sentence(
        "{place} has no topic in it; start a new BCF file", "{place} 中没有议题；请另建 BCF 文件"
    ),
    "report.bcf_per": Sentence(
        "topics can be made per column or per pair, not per {per}",
        "议题可以按 column（每柱）或 pair（每对）生成，不能按 {per}",
    ),
    "report.bcf_two": Sentence(
        "is of BCF version {found}, and {asked} was asked for, but no file holds two; leave the version out to "
        "go on with it, or write into another folder",
        "是 BCF {found} 文件，而要求写 {asked}，一个文件只能是一种版本；请不指定版本以续写，或写到其他文件夹",
    ),
    "report.bcf_unread": Sentence(
        "cannot be read as a BCF file ({why}); name another, or start without it",
        "不能作为 BCF 文件读取（{why}）；请给出另一个文件，或不用它而新建",
    ),
    "report.bcf_version": Sentence(
        "is of BCF version {found}, but topics are written as {known:and}, and no file holds two versions; "
        "save it as one of these in the program that it comes from, or start a new file",
        "是 BCF {found} 文件，而议题按 {known:and} 写入，一个文件只能是一种版本；请在原程序中另存为其中一种，或"
        "新建文件",
    ),
    "report.bcf_xml": Sentence("{place} {why}; start a new BCF file", "{place} {why}；请另建 BCF 文件"),
    "report.broken": Sentence(
        "is no report.json, or breaks off ({why}); repeat the check",
        "不是 report.json，或内容不完整（{why}）；请重新检查",
    ),
    "report.cut": Sentence(
        "breaks off at line {line}, column {column}; copy it again or repeat the check",
        "在第 {line} 行第 {column} 列处中断；请重新复制或重新检查",
    ),
    "report.deep": Sentence("is nested too deeply to be a report.json", "嵌套过深，不是 report.json"),
    "report.ifczip": Sentence(
        "results are written into .ifc files; unpack it and name the .ifc, and check with it",
        "结果只写入 .ifc 文件；请解压并给出其中的 .ifc，也用它检查",
    ),
    "report.many": Sentence(
        "holds more than {most} values, which no check writes", "含有多于 {most} 个值，检查不会写出这样的文件"
    ),
    "report.match": Sentence(
        "is a match.json; name the report.json of a check", "是 match.json；请给出检查得到的 report.json"
    ),
    "report.no_columns": Sentence(
        "is no report.json of a check: it has no columns", "不是检查得到的 report.json：其中没有柱"
    ),
    "report.no_element": Sentence(
        "{model} holds none of the report's columns ({shown}): no element has their GlobalIds. Name another model",
        "{model} 中没有报告里的柱（{shown}）：没有构件带有它们的 GlobalId。请给出另一个模型",
    ),
    "report.no_json": Sentence(
        "is no JSON ({why}, line {line}, column {column}); name the report.json of a check",
        "不是 JSON（{why}，第 {line} 行第 {column} 列）；请给出检查得到的 report.json",
    ),
    "report.no_model": Sentence(
        "the columns of this report were checked against designs in the job, not against a model, so no "
        "element is theirs. Check them with [model] in the job",
        "本报告的柱按任务中的设计检查，而不是按模型检查，因此没有与之对应的构件。请在任务中写明 [model] 后检查",
    ),
    "report.no_number": Sentence(
        "holds a number that is none ({why}); repeat the check", "含有无效的数值（{why}）；请重新检查"
    ),
    "report.no_results": Sentence(
        "{model} holds no results of a check: there is nothing to take out", "{model} 中没有检查结果：无可移除"
    ),
    "report.no_schema": Sentence(
        "is no report.json of a check: it has no key schema", "不是检查得到的 report.json：没有 schema 键"
    ),
    "report.no_text": Sentence(
        "is no text, but report.json is; name the report.json of a check",
        "不是文本，而 report.json 是文本；请给出检查得到的 report.json",
    ),
    "report.one_element": Sentence(
        "columns {first} and {second} of the report are one element of the model ({global_id}): name it once "
        "in the job, and repeat the check",
        "报告中的柱 {first} 与 {second} 是模型中的同一构件（{global_id}）：请在任务中只写一次，再重新检查",
    ),
    "report.other_model": Sentence(
        "{model} is not the model that was checked ({source}), or has changed since: its sha256 begins with "
        "{now}, that of the report with {checked}. Repeat the check; or write into it as it is, columns found "
        "by GlobalId (--force)",
        "{model} 不是所检查的模型（{source}），或此后已改动：其 sha256 以 {now} 开头，报告中的以 {checked} 开头。"
        "请重新检查；或按现状写入，柱按 GlobalId 查找（--force）",
    ),
    "report.read_only": Sentence(
        "{model} may only be read, so that nobody changes it: allow writing it, or write another file (--out)",
        "{model} 为只读，以防改动：请允许写入，或写入另一个文件（--out）",
    ),
    "report.schema": Sentence(
        "has schema {found}, this version reads schema {schema}; repeat the check, or use the version of aadm "
        "that wrote it",
        "的 schema 为 {found}，本版本读取 schema {schema}；请重新检查，或使用写出它的 aadm 版本",
    ),
    "report.slip": Sentence(
        "{key:word} is not what a report holds ({why}); repeat the check",
        "{key:word} 不符合报告的格式（{why}）；请重新检查",
    ),
    "report.unread": Sentence(
        "cannot be read ({why}); name the report.json of a check", "无法读取（{why}）；请给出检查得到的 report.json"
    ),
    "report.unusable": Sentence("{why}; name the report.json of a check", "{why}；请给出检查得到的 report.json"),
    "report.utf16": Sentence(
        "is written in UTF-16, into which no line of STEP fits; export it again",
        "以 UTF-16 写成，无法加入 STEP 行；请重新导出",
    ),
    "report.as_before": Sentence(
        "the model equals the one that the results were written into, byte for byte",
        "模型与写入结果之前的模型逐字节相同",
    ),
    "report.changed_since": Sentence(
        "the model was changed by another program since: what that program wrote stays",
        "此后模型已被其他程序改动：该程序写入的内容保留",
    ),
    "report.left_alone": Sentence(
        "{name} of {count:d} elements was in the model already and was left as it is",
        "{count:d} 个构件的 {name} 已在模型中，保持不变",
    ),
    "report.relation": Sentence(
        "relation #{number} was altered for the results and is another one now: it was not put back",
        "关系 #{number} 曾为写入结果而改动，现已不同：未恢复",
    ),
    "report.shared_ids": Sentence(
        "{count:d} GlobalIds are those of several elements ({shown}): nothing was written where it is not sure "
        "which one is meant; export the model with a GlobalId for each element",
        "{count:d} 个 GlobalId 各为几个构件共用（{shown}）：无法确定是哪一个时不写入；请导出每个构件各有 GlobalId"
        " 的模型",
    ),
    "report.unshared": Sentence(
        "{count:d} elements got property sets of their own where they had shared one",
        "{count:d} 个构件原共用一个属性集，现各有自己的属性集",
    ),
    "report.models_differ": Sentence("the models are not the same file", "两次的模型不是同一文件"),
    "report.tolerances_differ": Sentence(
        "the tolerances differ: {before}, then {after}",
        "允许偏差依据不同：先为 {before}，后为 {after}",
    ),
    "report.decision_differs": Sentence(
        "decision: {before}, then {after}", "判定规则不同：先为 {before}，后为 {after}"
    ),
    "report.method_differs": Sentence("method: {before}, then {after}", "方法不同：先为 {before}，后为 {after}"),
}
