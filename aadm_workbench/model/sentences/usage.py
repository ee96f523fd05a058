"""What is said of words of a command line that make no command: argparse's own English, and the Chinese."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "usage.ambiguous": Sentence(
        "ambiguous option: {option} could match {matches}", "选项 {option} 不明确，可能是 {matches}"
    ),
    "usage.argument": Sentence("argument {name}: {why}", "参数 {name}：{why}"),
    "usage.at_least_one": Sentence("expected at least one argument", "至少需要一个值"),
    "usage.at_most_one": Sentence("expected at most one argument", "最多一个值"),
    "usage.choice": Sentence("invalid choice: {value} (choose from {choices})", "没有 {value}，可选：{choices}"),
    "usage.error": Sentence("{program}: error: {what}", "{program}：错误：{what}"),
    "usage.explicit": Sentence("ignored explicit argument {value}", "该选项不带值，不应写 {value}"),
    "usage.length": Sentence("{value} is not a length above zero", "{value} 不是大于零的长度"),
    "usage.limit": Sentence("{value} is no limit; write {example}", "{value} 不是限值；请写 {example}"),
    "usage.memory": Sentence(
        "{value} is too little memory to check anything; give 600MB or more",
        "内存 {value} 太少，无法检查；请给出 600MB 以上",
    ),
    "usage.missing": Sentence("the following arguments are required: {names}", "缺少参数：{names}"),
    "usage.not_with": Sentence("not allowed with argument {name}", "不能与参数 {name} 同用"),
    "usage.one": Sentence("expected one argument", "需要一个值"),
    "usage.one_of": Sentence("one of the arguments {names} is required", "须给出以下参数之一：{names}"),
    "usage.other": Sentence("{words}", "解析器报告“{words}”"),
    "usage.parser": Sentence("unknown parser {value} (choices: {choices})", "没有命令 {value}，可选：{choices}"),
    "usage.port": Sentence(
        "{value} is no port; write a number from 1 to 65535", "{value} 不是端口；请写 1 到 65535 的数字"
    ),
    "usage.several": Sentence("expected {count} arguments", "需要 {count} 个值"),
    "usage.time": Sentence("{value} is no time; write {example}", "{value} 不是时间；请写 {example}"),
    "usage.unexpected": Sentence("unexpected option string: {option}", "此处不应有选项 {option}"),
    "usage.unknown": Sentence("unrecognized arguments: {words}", "不认识的参数：{words}"),
    "usage.usage": Sentence("usage: ", "用法："),
    "usage.value": Sentence("invalid {type} value: {value}", "{value} 不是 {type} 类型的值"),
    "usage.whole_number": Sentence("{value} is not a whole number above zero", "{value} 不是大于零的整数"),
}
