"""What is said of files that are more, or other, than such files can be."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "bounded.device": Sentence("is a device or a pipe", "是设备或管道"),
    "bounded.doctype": Sentence(
        "declares its own XML document type, which may be meant to harm",
        "声明了自己的 XML 文档类型，可能有恶意",
    ),
    "bounded.encrypted": Sentence("is encrypted (entry {name})", "已加密（条目 {name}）"),
    "bounded.entry_large": Sentence(
        "holds an entry {name} of {size_bytes} bytes, more than {most_bytes}",
        "含 {size_bytes} 字节的条目 {name}，超过 {most_bytes}",
    ),
    "bounded.entry_length": Sentence("its entry {name} is not as long as it says", "其条目 {name} 的长度与声明不符"),
    "bounded.folder": Sentence("is a folder", "是文件夹"),
    "bounded.grew": Sentence("grew beyond {most_bytes} bytes while it was read", "读取时超过了 {most_bytes} 字节"),
    "bounded.large": Sentence(
        "has {size_bytes} bytes, more than {most_bytes}",
        "有 {size_bytes} 字节，超过 {most_bytes}",
    ),
    "bounded.leads_out": Sentence(
        "holds an entry called {name}, which leads out of it",
        "含名为 {name} 的条目，指向文件之外",
    ),
    "bounded.lists_many": Sentence(
        "lists more than a {kind:word} can hold ({most} entries)",
        "条目多于{kind:word}所能有的数目（{most} 个）",
    ),
    "bounded.many": Sentence(
        "has {count} entries, more than a {kind:word} can hold ({most})",
        "有 {count} 个条目，多于{kind:word}所能有的数目（{most}）",
    ),
    "bounded.no_name": Sentence("holds an entry without a name", "含没有名称的条目"),
    "bounded.no_xml": Sentence("is no XML ({why})", "不是 XML（{why}）"),
    "bounded.no_zip": Sentence(
        "is no {kind:word}, or is cut short or damaged ({why})",
        "不是{kind:word}，或不完整、已损坏（{why}）",
    ),
    "bounded.packs": Sentence(
        "packs its entry {name} in a way that no {kind:word} does",
        "条目 {name} 的压缩方式不是{kind:word}所用",
    ),
    "bounded.unpacks": Sentence(
        "has {packed_bytes} bytes and would unpack to {unpacked_bytes}: no {kind:word} packs like that",
        "有 {packed_bytes} 字节，解压后将达 {unpacked_bytes}：{kind:word}不会这样压缩",
    ),
    "bounded.xml_deep": Sentence(
        "is XML of more than {deepest} levels or {most} elements",
        "XML 超过 {deepest} 层或 {most} 个元素",
    ),
    "bounded.unwritten": Sentence(
        "cannot be written ({why}); check that its folder exists, is writable and has room",
        "无法写入（{why}）；请检查其文件夹是否存在、可写且有空间",
    ),
    "bounded.own_link": Sentence(
        "it is a link, which is not followed; remove it, or put the file there",
        "是链接，不予跟随；请移除，或把文件放到该处",
    ),
    "bounded.own_no_file": Sentence("it is {kind:word}, not a file; remove it", "是{kind:word}，不是文件；请移除"),
    "bounded.own_replaced": Sentence("it was replaced while it was opened", "打开时被替换"),
    "bounded.own_replaced_again": Sentence("somebody else replaces it again and again", "被他人反复替换"),
    "bounded.toml.array_end": Sentence("Expected ']]' at the end of an array declaration", "表数组的声明应以“]]”结束"),
    "bounded.toml.array_open": Sentence("Unclosed array", "数组没有结束"),
    "bounded.toml.at": Sentence("{what} (at line {line}, column {column})", "第 {line} 行第 {column} 列：{what}"),
    "bounded.toml.at_end": Sentence("{what} (at end of document)", "在文件末尾：{what}"),
    "bounded.toml.backslash": Sentence("Unescaped '\\' in a string", "字符串中的反斜杠未转义"),
    "bounded.toml.character": Sentence("Found invalid character {sign}", "出现无效字符 {sign}"),
    "bounded.toml.date": Sentence("Invalid date or datetime", "日期或时间无效"),
    "bounded.toml.declared": Sentence("Cannot declare {key} twice", "{key} 声明了两次"),
    "bounded.toml.equals": Sentence("Expected '=' after a key in a key/value pair", "键之后应为“=”"),
    "bounded.toml.expected": Sentence("Expected {sign}", "此处应为 {sign}"),
    "bounded.toml.frozen": Sentence("Cannot mutate immutable namespace {key}", "{key} 已写全，不能再添加内容"),
    "bounded.toml.hex": Sentence("Invalid hex value", "十六进制数无效"),
    "bounded.toml.illegal": Sentence("Illegal character {sign}", "不允许的字符 {sign}"),
    "bounded.toml.key_start": Sentence("Invalid initial character for a key part", "键不能以该字符开头"),
    "bounded.toml.key_twice": Sentence("Duplicate inline table key {key}", "行内表中键 {key} 重复"),
    "bounded.toml.long_number": Sentence(
        "Exceeds the limit ({most} digits) for integer string conversion: value has {count} digits; "
        "use sys.set_int_max_str_digits() to increase the limit",
        "整数过长：{count} 位，最多 {most} 位",
    ),
    "bounded.toml.newline": Sentence("Expected newline or end of document after a statement", "语句之后应换行或结束"),
    "bounded.toml.other": Sentence("{words}", "解析器报告“{words}”"),
    "bounded.toml.overwrite": Sentence("Cannot overwrite a value", "同一个键赋值两次"),
    "bounded.toml.redefined": Sentence("Cannot redefine namespace {key}", "{key} 定义了两次"),
    "bounded.toml.scalar": Sentence("Escaped character is not a Unicode scalar value", "转义的字符不是 Unicode 字符"),
    "bounded.toml.statement": Sentence("Invalid statement", "语句无效"),
    "bounded.toml.string_open": Sentence("Unterminated string", "字符串没有结束"),
    "bounded.toml.table_end": Sentence("Expected ']' at the end of a table declaration", "表的声明应以“]”结束"),
    "bounded.toml.table_open": Sentence("Unclosed inline table", "行内表没有结束"),
    "bounded.toml.value": Sentence("Invalid value", "值无效"),
}
