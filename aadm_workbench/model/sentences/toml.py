"""What the parser of TOML says of a text that is none: its own English, by which it is read back, and the Chinese."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "toml.array_end": Sentence("Expected ']]' at the end of an array declaration", "表数组的声明应以“]]”结束"),
    "toml.array_open": Sentence("Unclosed array", "数组没有结束"),
    "toml.at": Sentence("{what} (at line {line}, column {column})", "第 {line} 行第 {column} 列：{what}"),
    "toml.at_end": Sentence("{what} (at end of document)", "在文件末尾：{what}"),
    "toml.backslash": Sentence("Unescaped '\\' in a string", "字符串中的反斜杠未转义"),
    "toml.character": Sentence("Found invalid character {sign}", "出现无效字符 {sign}"),
    "toml.date": Sentence("Invalid date or datetime", "日期或时间无效"),
    "toml.declared": Sentence("Cannot declare {key} twice", "{key} 声明了两次"),
    "toml.equals": Sentence("Expected '=' after a key in a key/value pair", "键之后应为“=”"),
    "toml.expected": Sentence("Expected {sign}", "此处应为 {sign}"),
    "toml.frozen": Sentence("Cannot mutate immutable namespace {key}", "{key} 已写全，不能再添加内容"),
    "toml.hex": Sentence("Invalid hex value", "十六进制数无效"),
    "toml.illegal": Sentence("Illegal character {sign}", "不允许的字符 {sign}"),
    "toml.key_start": Sentence("Invalid initial character for a key part", "键不能以该字符开头"),
    "toml.key_twice": Sentence("Duplicate inline table key {key}", "行内表中键 {key} 重复"),
    "toml.long_number": Sentence(
        "Exceeds the limit ({most} digits) for integer string conversion: value has {count} digits; "
        "use sys.set_int_max_str_digits() to increase the limit",
        "整数过长：{count} 位，最多 {most} 位",
    ),
    "toml.newline": Sentence("Expected newline or end of document after a statement", "语句之后应换行或结束"),
    "toml.other": Sentence("{words}", "解析器报告“{words}”"),
    "toml.overwrite": Sentence("Cannot overwrite a value", "同一个键赋值两次"),
    "toml.redefined": Sentence("Cannot redefine namespace {key}", "{key} 定义了两次"),
    "toml.scalar": Sentence("Escaped character is not a Unicode scalar value", "转义的字符不是 Unicode 字符"),
    "toml.statement": Sentence("Invalid statement", "语句无效"),
    "toml.string_open": Sentence("Unterminated string", "字符串没有结束"),
    "toml.table_end": Sentence("Expected ']' at the end of a table declaration", "表的声明应以“]”结束"),
    "toml.table_open": Sentence("Unclosed inline table", "行内表没有结束"),
    "toml.value": Sentence("Invalid value", "值无效"),
}
