"""What is said of models of any kind, and of the program that reads some of them."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "design.cloud_unwritten": Sentence(
        "the model's cloud cannot be written for the published route: {why}",
        "无法为已发表的方法写出模型的点云：{why}",
    ),
    "design.empty": Sentence("{path} is empty: export the model again.", "{path} 是空文件：请重新导出模型。"),
    "design.fcstd_entities": Sentence(
        "{path}: its part {name} defines entities, which FreeCAD never writes.",
        "{path}：其部分 {name} 定义了实体，FreeCAD 从不这样写。",
    ),
    "design.fcstd_part": Sentence(
        "{path}: its part {name} is longer than it says: it was not opened.",
        "{path}：其部分 {name} 比声明的长：未打开。",
    ),
    "design.fcstd_refused": Sentence(
        "{path} {why}: it was not opened. Copy it again, or save it again in FreeCAD.",
        "{path}{why}：未打开。请重新拷贝，或在 FreeCAD 中重新保存。",
    ),
    "design.fcstd_zip": Sentence(
        "{path} is a zip archive without {main}: no FreeCAD document. Save it in FreeCAD.",
        "{path} 是没有 {main} 的 zip 文件：不是 FreeCAD 文档。请在 FreeCAD 中保存。",
    ),
    "design.few_points": Sentence(
        "{source} has {count} points, too few to find sleeves and bars in; sample it more densely.",
        "{source} 只有 {count} 个点，太少，无法从中找到套筒和钢筋；请更密地采样。",
    ),
    "design.has": Sentence("It has {names}", "其中有 {names}"),
    "design.holds": Sentence("The model holds {holdings}. {how}", "模型中有 {holdings}。{how}"),
    "design.is_ifc": Sentence("{path} is an IFC model: name it .ifc.", "{path} 是 IFC 模型：请命名为 .ifc。"),
    "design.kernel": Sentence(
        "{path}: what FreeCAD answered about it makes no sense ({why}).",
        "{path}：FreeCAD 的回答没有意义（{why}）。",
    ),
    "design.measures": Sentence(
        "{source} is declared in {units}, so it measures {sizes} mm",
        "{source} 声明的单位为 {units}，尺寸因此为 {sizes} mm",
    ),
    "design.mesh_unread": Sentence(
        "{path} cannot be read as a mesh ({why}). Export it again.",
        "{path} 无法按网格读取（{why}）。请重新导出。",
    ),
    "design.name_sleeves": Sentence(
        'Where sleeves are called something else, name them with sleeves = "..." in [model], for instance sleeves '
        '= "IfcDiscreteAccessory, Name=/套筒/".',
        '套筒若另有名称，请在 [model] 中用 sleeves = "..." 指定，例如 sleeves = "IfcDiscreteAccessory, Name=/套筒/"。',
    ),
    "design.near": Sentence("Near to it: {names}", "相近的有：{names}"),
    "design.no_brep": Sentence(
        "{path} is no BREP file: it does not begin with 'CASCADE Topology'. Export it again.",
        "{path} 不是 BREP 文件：开头不是 'CASCADE Topology'。请重新导出。",
    ),
    "design.no_column": Sentence(
        "{source} has no column called {key}. {shown}.",
        "{source} 中没有名为 {key} 的柱。{shown}。",
    ),
    "design.no_coordinates": Sentence("it has coordinates that are no numbers", "有坐标不是数"),
    "design.no_elements": Sentence("no elements at all", "没有任何构件"),
    "design.no_extension": Sentence("models without an extension", "没有扩展名的模型"),
    "design.no_file": Sentence(
        "{path} does not exist. Paths in a job are relative to the job file.",
        "{path} 不存在。任务中的路径相对于任务文件。",
    ),
    "design.no_program": Sentence(
        "{variable} is {named}, which is no program: name FreeCAD's freecadcmd.",
        "{variable} 为 {named}，不是程序：请指定 FreeCAD 的 freecadcmd。",
    ),
    "design.no_size": Sentence(
        "{declared}: no column has that size. Declare its unit with units in [model], or --units: {known}.",
        "{declared}：没有柱是这个尺寸。请在 [model] 中用 units 或用 --units 声明其单位：{known}。",
    ),
    "design.no_sleeves": Sentence(
        "{source} has no column with grouting sleeves in its foot. {help}",
        "{source} 中没有柱底带灌浆套筒的柱。{help}",
    ),
    "design.no_solids": Sentence("no solids at all", "没有任何实体"),
    "design.no_step": Sentence(
        "{path} is no STEP file: it does not begin with ISO-10303-21. Export it again.",
        "{path} 不是 STEP 文件：开头不是 ISO-10303-21。请重新导出。",
    ),
    "design.no_triangles": Sentence(
        "{path} holds no triangles: export the model as a mesh with faces.",
        "{path} 没有三角形：请将模型导出为带面的网格。",
    ),
    "design.no_vertices": Sentence("it has faces of vertices that are not there", "有面的顶点不存在"),
    "design.none_held": Sentence(
        "{label} holds no design: sample the design of its column again",
        "{label} 中没有设计：请重新提取其柱的设计",
    ),
    "design.not_handed": Sentence(
        "holds no designs as the workbench hands them over ({why})",
        "其中的设计不是工作台交付的形式（{why}）",
    ),
    "design.of_format": Sentence("models of the format {suffix}", "{suffix} 格式的模型"),
    "design.other_unit": Sentence(
        "{declared} and holds no column with grouting sleeves; in {other} it holds one with {count} sleeves of "
        '{diameter_mm:.4g} mm: write units = "{other}" in [model], or --units {other}.',
        "{declared}，其中没有带灌浆套筒的柱；按 {other} 则有一根，带 {count} 个 {diameter_mm:.4g} mm 的套筒：请在 "
        '[model] 中写 units = "{other}"，或用 --units {other}。',
    ),
    "design.program_ended": Sentence(
        "{about}: FreeCAD ended without reading it; the file may be damaged.",
        "{about}：FreeCAD 未读完就结束；文件可能已损坏。",
    ),
    "design.program_ended.words": Sentence(
        "{about}: FreeCAD ended without reading it; the file may be damaged. Its last words: {printed}",
        "{about}：FreeCAD 未读完就结束；文件可能已损坏。其最后输出：{printed}",
    ),
    "design.program_failed": Sentence("{about} cannot be read with FreeCAD: {why}", "FreeCAD 无法读取 {about}：{why}"),
    "design.program_late": Sentence(
        "{about}: FreeCAD did not finish reading it in {limit_s:g} seconds. Set {variable} to more, or save a "
        "document that holds only columns and bars.",
        "{about}：FreeCAD 未能在 {limit_s:g} 秒内读完。请增大 {variable}，或只保存含柱和钢筋的文档。",
    ),
    "design.program_seconds": Sentence(
        "{variable} is {written}: it must be a number of seconds, above zero.",
        "{variable} 为 {written}：应为大于零的秒数。",
    ),
    "design.program_start": Sentence(
        "{about}: FreeCAD ({command}) cannot be started: {why}.",
        "{about}：无法启动 FreeCAD（{command}）：{why}。",
    ),
    "design.refused": Sentence("{path} {why}: name the model's file.", "{path}{why}：请指定模型文件。"),
    "design.selector_asks": Sentence(
        'The selector {key} = "{rule}" asks for {asked}; models of this format have {known}.',
        '选择器 {key} = "{rule}" 要求 {asked}；该格式的模型有 {known}。',
    ),
    "design.selector_at": Sentence(
        'The selector {key} = "{rule}" is not understood at "{text}"; write Name=/pattern/ or a class.',
        '选择器 {key} = "{rule}" 在 "{text}" 处无法理解；请写 Name=/模式/ 或类名。',
    ),
    "design.selector_empty": Sentence(
        'The selector {key} = "{query}" finds no element in {source}, which holds {holdings}.',
        '选择器 {key} = "{query}" 在 {source} 中没有找到构件，其中有 {holdings}。',
    ),
    "design.selector_pattern": Sentence(
        'The selector {key} = "{rule}" is not understood: {why} in /{pattern}/.',
        '选择器 {key} = "{rule}" 的模式 /{pattern}/ 无法理解：{why}。',
    ),
    "design.selector_unread": Sentence(
        'The selector {key} = "{query}" is not understood: {why}',
        '选择器 {key} = "{query}" 无法理解：{why}',
    ),
    "design.several": Sentence(
        "{key} names {count} columns of {source}: {ids}. Use one of these.",
        "{key} 在 {source} 中对应 {count} 根柱：{ids}。请用其中之一。",
    ),
    "design.step_cut": Sentence(
        "{path} is cut short: it does not end with END-ISO-10303-21. Copy it again.",
        "{path} 不完整：结尾不是 END-ISO-10303-21。请重新拷贝。",
    ),
    "design.units": Sentence(
        "the unit of models is {units}; it must be one of {known}",
        "模型的单位为 {units}；应为 {known} 之一",
    ),
    "design.unopened": Sentence("{path} cannot be opened: {why}.", "{path} 无法打开：{why}。"),
    "design.unread": Sentence("cannot be read ({why})", "无法读取（{why}）"),
    "design.unsupported": Sentence(
        "{path}: {called} are not supported. Supported: {supported}. Export the model as IFC, or describe the "
        "column in the job, in [columns.design].",
        "{path}：不支持{called}。支持的有：{supported}。请将模型导出为 IFC，或在任务的 [columns.design] 中描述柱。",
    ),
    "design.up": Sentence(
        "{label}: up must be +x, -x, +y, -y or a number of degrees from +x, it is {written}",
        "{label}：up 应为 +x、-x、+y、-y 或从 +x 起的度数，实为 {written}",
    ),
    "design.without": Sentence("Column {key} of {source} {why}. {help}", "{source} 的柱 {key} {why}。{help}"),
}
