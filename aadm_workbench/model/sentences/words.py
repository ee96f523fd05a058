"""Words that fill places of sentences whose format says so."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "words.BCF file": Sentence("BCF file", "BCF 文件"),
    "words.Checking columns in several processes": Sentence("Checking columns in several processes", "多进程检查"),
    "words.Checking columns on a cluster": Sentence("Checking columns on a cluster", "在集群上检查"),
    "words.FreeCAD document": Sentence("FreeCAD document", "FreeCAD 文档"),
    "words.Plots of a study": Sentence("Plots of a study", "研究图表"),
    "words.The fringe camera": Sentence("The fringe camera", "条纹投影虚拟相机"),
    "words.The virtual camera": Sentence("The virtual camera", "虚拟相机"),
    "words.a PDF report": Sentence("a PDF report", "PDF 报告"),
    "words.a compressed LAZ file": Sentence("a compressed LAZ file", "读取压缩的 LAZ 文件"),
    "words.a compressed PCD file (DATA binary_compressed)": Sentence(
        "a compressed PCD file (DATA binary_compressed)",
        "读取压缩的 PCD 文件（DATA binary_compressed）",
    ),
    "words.a depth map or a picture": Sentence("a depth map or a picture", "读取深度图或图像"),
    "words.absolute position": Sentence("absolute position", "绝对位置"),
    "words.an E57 file": Sentence("an E57 file", "读取 E57 文件"),
    "words.as the others do": Sentence("as the others do", "按其余钢筋"),
    "words.bars": Sentence("bars", "钢筋"),
    "words.by design": Sentence("by design", "按设计"),
    "words.column": Sentence("column", "柱"),
    "words.depth map": Sentence("depth map", "深度图"),
    "words.error": Sentence("error", "出错"),
    "words.fail": Sentence("fail", "不合格"),
    "words.grey picture": Sentence("grey picture", "灰度图"),
    "words.inconclusive": Sentence("inconclusive", "不确定"),
    "words.none": Sentence("none", "无"),
    "words.not_assessed": Sentence("not_assessed", "未评定"),
    "words.not_measured": Sentence("not_measured", "未测得"),
    "words.pass": Sentence("pass", "合格"),
    "words.reading FreeCAD documents, STEP and BREP": Sentence(
        "reading FreeCAD documents, STEP and BREP",
        "读取 FreeCAD 文档、STEP 和 BREP",
    ),
    "words.reading IFC models": Sentence("reading IFC models", "读取 IFC 模型"),
    "words.reading meshes": Sentence("reading meshes", "读取网格模型"),
    "words.reading report.json": Sentence("reading report.json", "读取 report.json"),
    "words.rebar": Sentence("rebar", "钢筋"),
    "words.rebars": Sentence("rebars", "钢筋"),
    "words.sleeve": Sentence("sleeve", "套筒"),
    "words.sleeves": Sentence("sleeves", "套筒"),
    "words.sleeves of the foot": Sentence("sleeves of the foot", "柱底套筒"),
    "words.source": Sentence("source", "来源"),
    "words.target": Sentence("target", "目标"),
    "words.zip archive of a model": Sentence("zip archive of a model", "模型压缩包"),
}
