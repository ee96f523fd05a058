"""What is said of documents of FreeCAD, and of jobs and scans as they stand in them."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "document.bad_geometry": Sentence("its geometry cannot be read ({why})", "无法读取其几何（{why}）"),
    "document.column_slip": Sentence(
        "column {number:d} of the report is not what a report holds ({why}); repeat the check",
        "报告的第 {number:d} 根柱不符合报告的格式（{why}）；请重新检查",
    ),
    "document.columns_differ": Sentence(
        "the columns differ in {name} ({values}), and a job has one for all: set it alike",
        "各柱的 {name} 不同（{values}），而一个任务只有一个：请设为相同",
    ),
    "document.empty_report": Sentence(
        "the report holds no columns: name the report.json of a check", "报告中没有柱：请给出检查得到的 report.json"
    ),
    "document.folder": Sentence("cannot be read ({why}); choose another folder", "无法读取（{why}）；请选择其他文件夹"),
    "document.from_report": Sentence(
        "{label} was made from a report, which holds no diameters of the design: sample its design first",
        "{label} 由报告生成，而报告中没有设计直径：请先提取设计",
    ),
    "document.job_unread": Sentence("cannot be read ({why}); name a job file", "无法读取（{why}）；请给出任务文件"),
    "document.job_unusable": Sentence("{why}; name a job file", "{why}；请给出任务文件"),
    "document.job_unwritten": Sentence(
        "cannot be written ({why}); choose another place for the job file", "无法写入（{why}）；请为任务文件另选位置"
    ),
    "document.no_body": Sentence(
        "{label} has no body of its own: select the column, or the group that holds it.",
        "{label} 自身没有实体：请选择柱，或包含它的组。",
    ),
    "document.no_columns": Sentence(
        "is no job file: it has no [[columns]] with an id each", "不是任务文件：没有各带 id 的 [[columns]]"
    ),
    "document.no_document": Sentence("there is no such FreeCAD document", "没有这个 FreeCAD 文档"),
    "document.no_geometry": Sentence("it holds no geometry", "其中没有几何"),
    "document.no_job": Sentence(
        "is no job file ({why}); it is TOML, saved as UTF-8", "不是任务文件（{why}）；任务文件是以 UTF-8 保存的 TOML"
    ),
    "document.no_picture": Sentence("FreeCAD wrote no picture", "FreeCAD 没有写出图片"),
    "document.no_result": Sentence(
        "no column of this document has a result yet: check a column or run a job",
        "本文档中还没有柱有结果：请检查一根柱或运行任务",
    ),
    "document.no_scans": Sentence(
        "{label} has no scans yet: import one of its sleeves, its rebars or both",
        "{label} 还没有扫描：请导入其套筒、钢筋或两者的扫描",
    ),
    "document.no_state": Sentence("is no report and no hoisting state ({why})", "既不是报告也不是吊装状态（{why}）"),
    "document.not_held": Sentence("it holds no document", "其中没有文档"),
    "document.profiles": Sentence(
        "the columns were judged by different tolerance profiles ({profiles}): check them again by one, or "
        "delete the results of the others",
        "各柱按不同的允许偏差依据评定（{profiles}）：请按同一依据重新检查，或删除其余的结果",
    ),
    "document.scan_changed": Sentence(
        "has changed since it was imported; import it again, and check what it shows",
        "导入后已改动；请重新导入，并核对其内容",
    ),
    "document.scan_gone": Sentence(
        "is not there any more; bring it back, or import the scan again", "已不存在；请放回原处，或重新导入扫描"
    ),
    "document.scan_kind": Sentence(
        "a scan shows {kinds:or}, in {units:or}, not {word}",
        "扫描的内容为 {kinds:or}，单位为 {units:or}，不能是 {word}",
    ),
    "document.scan_nameless": Sentence(
        "{label} names no file: import the scan again", "{label} 未指明文件：请重新导入扫描"
    ),
    "document.scans_differ": Sentence(
        "the scans of {label} differ in {name}, and a check has one for all: import them again alike",
        "{label} 的各扫描 {name} 不同，而一次检查只有一个：请按相同设置重新导入",
    ),
    "document.unopened": Sentence(
        "FreeCAD cannot open it ({why}); save it again, or name a .FCStd file",
        "FreeCAD 无法打开（{why}）；请重新保存，或给出 .FCStd 文件",
    ),
    "document.left_out.groups": Sentence(
        "{label} was left out: its groups hold each other",
        "{label} 未采用：其各组互相包含",
    ),
    "document.left_out.link": Sentence(
        "{label} was left out: what it links to is missing",
        "{label} 未采用：所链接的对象不存在",
    ),
    "document.left_out.nothing": Sentence(
        "{label} was left out: it links to nothing, or to a document that is not there",
        "{label} 未采用：没有链接到任何对象，或所链接的文档不存在",
    ),
    "document.left_out.scaled": Sentence(
        "{label} was left out: it is scaled by different factors along its axes",
        "{label} 未采用：各轴缩放比例不同",
    ),
    "document.left_out.shape": Sentence(
        "{label} was left out: its shape cannot be evaluated ({why})",
        "{label} 未采用：其形状无法求值（{why}）",
    ),
}
