"""What is said of columns that could not be checked."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "run.died": Sentence("the process that checked it was {cause}", "检查它的进程{cause}"),
    "run.died.several": Sentence(
        "{count} processes that checked it died, the last was {cause}",
        "检查它的 {count} 个进程已中止，最后一个{cause}",
    ),
    "run.internal": Sentence(
        "internal error ({error}); --debug shows where",
        "内部错误（{error}）；--debug 可显示位置",
    ),
    "run.last_words": Sentence("{what}; the last that it wrote: {words}", "{what}；其最后输出：{words}"),
    "run.no_group": Sentence(
        "the design has no {kind:word}, but the job names a scan of them ({names})",
        "设计中没有{kind:word}，而任务给出了其扫描（{names}）",
    ),
    "run.no_memory": Sentence(
        "there is not enough memory for its scans: check fewer columns at a time, or raise --memory-limit",
        "内存不足以读取其扫描：请减少同时检查的柱数，或增大 --memory-limit",
    ),
    "run.no_scan": Sentence("the job names no scan of its sleeves or rebars", "任务没有给出套筒或钢筋的扫描文件"),
    "run.not_checked": Sentence("it was not checked", "未检查"),
    "run.not_evaluated": Sentence(
        "{model} cannot be evaluated: something in it is not as its format wants it ({error}); export it again "
        "(--debug shows where)",
        "{model} 无法求值：其中有内容不合其格式（{error}）；请重新导出（--debug 可显示位置）",
    ),
    "run.defect": Sentence(
        '--defect "{text}" is none: write COLUMN: POINT DX,DY in mm, as in "C-302: R5 +7.5,0", or "C-301: S7 plugged"',
        '--defect "{text}" 无法识别：请写 柱: 测点 DX,DY（mm），例如 "C-302: R5 +7.5,0"，或 "C-301: S7 plugged"',
    ),
    "run.defect_column": Sentence(
        "--defect names column {column}, but these are made: {ids}; name one of them, or ask for more with --columns",
        "--defect 指定了柱 {column}，但生成的柱为：{ids}；请指定其中之一，或用 --columns 增加",
    ),
    "run.defect_far": Sentence(
        '--defect "{text}": at most {most_mm:g} mm, beyond that a bar stands in the place of another',
        '--defect "{text}"：最多 {most_mm:g} mm，再远就到了另一根钢筋的位置',
    ),
    "run.defect_point": Sentence(
        '--defect "{text}": a column has points 1 to {most:d}',
        '--defect "{text}"：每根柱只有 1 至 {most:d} 号测点',
    ),
}
