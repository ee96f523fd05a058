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
}
