"""What is said of IFC models: their text, and what was taken for columns, sleeves and bars, or not."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "ifc.beam_not_level": Sentence("does not lie: nothing of it is level", "不是水平构件：没有任何水平的部分"),
    "ifc.beam_short": Sentence(
        "is {long_mm:.0f} mm long: no beam between two columns", "长 {long_mm:.0f} mm：不是两柱之间的梁"
    ),
    "ifc.beam_upright": Sentence(
        "does not lie: it is {high_mm:.0f} mm high and {long_mm:.0f} mm long",
        "不是水平构件：高 {high_mm:.0f} mm，长 {long_mm:.0f} mm",
    ),
    "ifc.above_bars": Sentence(
        "its foot is drawn above the tops of its bars: embedded length is not known",
        "其柱底画在钢筋顶之上：不知埋入长度",
    ),
    "ifc.area": Sentence(
        "CrossSectionArea is {written_mm2:.4g} mm², a bar of {diameter_mm:g} mm has {drawn_mm2:.1f} mm², which "
        "was believed",
        "CrossSectionArea 为 {written_mm2:.4g} mm²，{diameter_mm:g} mm 钢筋为 {drawn_mm2:.1f} mm²，以后者为准",
    ),
    "ifc.area_slip": Sentence(
        "CrossSectionArea is {written_mm2:.4g} mm² (it is in {unit:word}), a bar of {diameter_mm:g} mm has "
        "{drawn_mm2:.1f} mm², which was believed",
        "CrossSectionArea 为 {written_mm2:.4g} mm²（单位实为{unit:word}），{diameter_mm:g} mm 钢筋为 "
        "{drawn_mm2:.1f} mm²，以后者为准",
    ),
    "ifc.assumed": Sentence(
        "not in the model: assumed on the axis of {label}",
        "模型中没有：按位于 {label} 轴线上假定",
    ),
    "ifc.axis_alone": Sentence(
        "is drawn as its axis alone, and neither it nor its type says its diameter",
        "只画了轴线，其本身和类型都没有给出直径",
    ),
    "ifc.axis_of": Sentence("{what}, drawn as its axis alone", "{what}，只画了轴线"),
    "ifc.backslashes": Sentence(
        "backslashes in line {lines} are not doubled as STEP wants them; they were read as they are",
        "第 {lines} 行的反斜杠没有按 STEP 的规定写成两个；已按原样读取",
    ),
    "ifc.backslashes.others": Sentence(
        "backslashes in line {lines} and others are not doubled as STEP wants them; they were read as they are",
        "第 {lines} 等行的反斜杠没有按 STEP 的规定写成两个；已按原样读取",
    ),
    "ifc.bar_by_shape": Sentence("{element}, a bar by its shape", "{element}，按形状为钢筋"),
    "ifc.bar_called": Sentence("is called {named}: a stirrup, tie or spiral", "名为 {named}：箍筋、拉筋或螺旋筋"),
    "ifc.bar_kind": Sentence("is a {kind} by its PredefinedType", "按其 PredefinedType 为 {kind}"),
    "ifc.bars_assumed": Sentence(
        "{missing} of {count} sleeves have no bar in the model: theirs are assumed on their axes",
        "{count} 个套筒中有 {missing} 个在模型中没有钢筋：按位于其轴线上假定",
    ),
    "ifc.bars_beside": Sentence(
        "in the model itself bars stand up to {worst_mm:.1f} mm beside their sleeves' axes",
        "模型中钢筋距其套筒轴线达 {worst_mm:.1f} mm",
    ),
    "ifc.behind": Sentence(
        "sleeves begin up to {behind_mm:.0f} mm behind the foot face; their centres are on it",
        "套筒从柱底面内侧 {behind_mm:.0f} mm 处才开始；其中心取在柱底面上",
    ),
    "ifc.believed": Sentence(
        "{name} is {written_mm} mm, drawn is {drawn_mm} mm, which was believed",
        "{name} 为 {written_mm} mm，所绘为 {drawn_mm} mm，以所绘为准",
    ),
    "ifc.believed_slip": Sentence(
        "{name} is {written_mm} mm ({slip:word}), drawn is {drawn_mm} mm, which was believed",
        "{name} 为 {written_mm} mm（{slip:word}），所绘为 {drawn_mm} mm，以所绘为准",
    ),
    "ifc.beside": Sentence(
        "{rebar} {apart_mm:.1f} mm beside the axis of {sleeve}",
        "{rebar} 距 {sleeve} 轴线 {apart_mm:.1f} mm",
    ),
    "ifc.bore": Sentence(
        "has an inner diameter of {bore_mm:g} mm, outside {least_mm:g} to {most_mm:g} mm",
        "内径为 {bore_mm:g} mm，不在 {least_mm:g} 至 {most_mm:g} mm 之内",
    ),
    "ifc.by_property": Sentence('{type} "{name}", property "{text}"', '{type} "{name}"，属性 "{text}"'),
    "ifc.by_shape": Sentence(
        "its sleeves have no telling name and were recognised by their shape alone",
        "其套筒没有可辨认的名称，仅按形状识别",
    ),
    "ifc.called": Sentence("{count:d} {type} called {name}", "{count:d} 个名为 {name} 的 {type}"),
    "ifc.called_each": Sentence(
        "{count:d} {type} called {name}: each {why}",
        "{count:d} 个名为 {name} 的 {type}：每个{why}",
    ),
    "ifc.chosen": Sentence("chosen by the selector", "由选择器选定"),
    "ifc.chosen_element": Sentence("chosen by the selector; {element}", "由选择器选定；{element}"),
    "ifc.closed": Sentence("is closed: a stirrup", "是封闭的：箍筋"),
    "ifc.column_is": Sentence("Column {called} {why}.", "柱 {called} {why}。"),
    "ifc.counted": Sentence("{count:d} {what:word}", "{count:d} 个{what:word}"),
    "ifc.counted.several": Sentence("{count:d} {what:word}s", "{count:d} 个{what:word}"),
    "ifc.coupler": Sentence("{why}, a COUPLER by its PredefinedType", "{why}，按其 PredefinedType 为 COUPLER"),
    "ifc.cut": Sentence(
        "{path} is cut short: line {lines} is its last, without END-ISO-10303-21. Copy it again.",
        "{path} 不完整：最后是第 {lines} 行，没有 END-ISO-10303-21。请重新拷贝。",
    ),
    "ifc.damaged": Sentence(
        "{path} is no IFC model or a damaged one: line {number} reads {shown} where '{word};' is due. Export it "
        "again, or repair that line.",
        "{path} 不是 IFC 模型或已损坏：第 {number} 行为 {shown}，此处应为 '{word}；'。请重新导出，或修复该行。",
    ),
    "ifc.design_misses": Sentence(
        "the design itself misses the {limit_mm:g} mm between bar and sleeve: {pairs}",
        "设计本身就不满足钢筋与套筒间 {limit_mm:g} mm 的限值：{pairs}",
    ),
    "ifc.drawn_over_ribs": Sentence(
        "drawn over the ribs, {drawn_mm:g} mm; the NominalDiameter of {written_mm:g} mm was taken",
        "按肋外径 {drawn_mm:g} mm 绘制；采用 NominalDiameter 的 {written_mm:g} mm",
    ),
    "ifc.each": Sentence("{count:d} {type}: each {why}", "{count:d} 个 {type}：每个{why}"),
    "ifc.encoding": Sentence(
        "the file is written in {encoding}, not as STEP wants it; it was read as {encoding}",
        "文件以 {encoding} 写成，不合 STEP 的规定；已按 {encoding} 读取",
    ),
    "ifc.ends_inside": Sentence(
        "ends inside column {column}: its own reinforcement",
        "终止于柱 {column} 内：柱自身的钢筋",
    ),
    "ifc.escaped": Sentence(
        "names are written in escaped bytes of {best}, not as STEP wants it; they were read as {best}",
        "名称以 {best} 的转义字节写成，不合 STEP 的规定；已按 {best} 读取",
    ),
    "ifc.escaped.close": Sentence(
        "names are written in escaped bytes of {best}, not as STEP wants it; they were read as {best}; {close} is "
        "nearly as likely",
        "名称以 {best} 的转义字节写成，不合 STEP 的规定；已按 {best} 读取；{close} 几乎同样可能",
    ),
    "ifc.evidence": Sentence('{evidence} "{said}"', '{evidence} "{said}"'),
    "ifc.fewer_alike": Sentence(
        "is one of fewer than {fewest} alike, without a name of a sleeve",
        "同样的少于 {fewest} 个，且没有套筒的名称",
    ),
    "ifc.fragment": Sentence("is {length_mm:.2f} mm long: a fragment", "长 {length_mm:.2f} mm：只是碎段"),
    "ifc.grid": Sentence("IfcGrid {global_id} was left out: {why}", "IfcGrid {global_id} 未采用：{why}"),
    "ifc.hole": Sentence("a round hole in the column's body", "柱体内的圆孔"),
    "ifc.hole_in": Sentence("a round hole in {element}", "{element} 中的圆孔"),
    "ifc.hole_unsaid": Sentence(
        "a round hole in {element}; nothing says that it is a grouting sleeve",
        "{element} 中的圆孔；没有说明它是灌浆套筒",
    ),
    "ifc.hollow": Sentence("is hollow: a pipe or a sleeve", "是空心的：管或套筒"),
    "ifc.in_column": Sentence(
        "is in column {column} but does not open in its foot face",
        "在柱 {column} 内，但未开口于其柱底面",
    ),
    "ifc.in_wall": Sentence("stands in wall {wall}: a dowel of a wall", "在墙 {wall} 内：墙的插筋"),
    "ifc.is_xml": Sentence(
        "{path} is XML: export the model as IFC in STEP format (.ifc), not as ifcXML.",
        "{path} 是 XML：请将模型导出为 STEP 格式的 IFC（.ifc），而不是 ifcXML。",
    ),
    "ifc.is_zip": Sentence(
        "{path} is a zip archive, not an IFC model: unpack it and name the .ifc file in it.",
        "{path} 是 zip 文件，不是 IFC 模型：请解压并指定其中的 .ifc 文件。",
    ),
    "ifc.it_is_in": Sentence("it is in {unit:word}", "单位实为{unit:word}"),
    "ifc.leans": Sentence("leans {lean_deg:.1f}° from the vertical", "偏离竖直 {lean_deg:.1f}°"),
    "ifc.left_out": Sentence("Left out were {shown:;}.", "未采用的有：{shown:;}。"),
    "ifc.line": Sentence("line {number}: {said}", "第 {number} 行：{said}"),
    "ifc.listed_loose": Sentence(
        "no column with grouting sleeves was recognised; its upright round holes are listed as they are, as loose",
        "没有识别出带灌浆套筒的柱；其竖直圆孔按原样列出（见 loose）",
    ),
    "ifc.looked_at": Sentence(
        "{count:d} column was looked at ({called}); no grouting sleeve opens in a foot face.",
        "查看了 {count:d} 根柱（{called}）；柱底面没有灌浆套筒开口。",
    ),
    "ifc.looked_at.several": Sentence(
        "{count:d} columns were looked at ({called}); no grouting sleeve opens in a foot face.",
        "查看了 {count:d} 根柱（{called}）；柱底面没有灌浆套筒开口。",
    ),
    "ifc.lying": Sentence(
        "is drawn lying: which bars it will come down on is not in the model",
        "画成平放：将落在哪些钢筋上，模型中没有",
    ),
    "ifc.lying_about": Sentence(
        "{found:and} of the model belong to no column (see loose).",
        "模型中有 {found:and} 不属于任何柱（见 loose）。",
    ),
    "ifc.may_be": Sentence(
        "What may be one: {shown:;}. Say which are columns, for instance {selector}.",
        "可能是柱的有：{shown:;}。请指明哪些是柱，例如 {selector}。",
    ),
    "ifc.more_attributes": Sentence(
        "{count:d} more elements have attributes that contradict what is drawn",
        "另有 {count:d} 个构件的属性与所绘不符",
    ),
    "ifc.more_holes": Sentence(
        "{count} more round holes in its foot (Ø {bores} mm) have no name of a sleeve and were not taken",
        "柱底另有 {count} 个圆孔（Ø {bores} mm）没有套筒的名称，未采用",
    ),
    "ifc.more_left_out": Sentence(
        "the geometry of {count} more elements was left out",
        "另有 {count} 个构件的几何未采用",
    ),
    "ifc.names_no_schema": Sentence("its header names no schema", "其文件头没有声明格式"),
    "ifc.names_schema": Sentence("its header names the schema {schema}", "其文件头声明的格式为 {schema}"),
    "ifc.no_bars": Sentence(
        "no bars of the model stand under it: it has no connecting rebars to check",
        "模型中没有钢筋在其下方：没有可检查的连接钢筋",
    ),
    "ifc.no_bore": Sentence("is a solid cylinder without a bore", "是没有内孔的实心圆柱"),
    "ifc.no_column": Sentence(
        "There is no IfcColumn in it, and nothing called a column.",
        "模型中没有 IfcColumn，也没有名为柱的构件。",
    ),
    "ifc.no_end": Sentence(
        "has no straight upright end of {least_mm:.0f} mm: a stirrup, spiral or bent bar",
        "没有 {least_mm:.0f} mm 的竖直直段：箍筋、螺旋筋或弯筋",
    ),
    "ifc.no_name": Sentence("{type} without a telling name", "{type}，没有可辨认的名称"),
    "ifc.no_project": Sentence("it holds no IfcProject", "其中没有 IfcProject"),
    "ifc.no_round": Sentence("has no straight round part", "没有直的圆形部分"),
    "ifc.no_round_ends": Sentence(
        "is drawn as a body without two round ends: no straight bar",
        "画成的实体没有两个圆端：不是直筋",
    ),
    "ifc.no_sleeve": Sentence("is called {excluded}: no grouting sleeve", "名为 {excluded}：不是灌浆套筒"),
    "ifc.no_sleeves": Sentence("has no grouting sleeves in its foot face", "柱底面没有灌浆套筒"),
    "ifc.no_unit": Sentence(
        "{path} declares no unit of length (IfcUnitAssignment): export it again with units.",
        "{path} 没有声明长度单位（IfcUnitAssignment）：请连同单位重新导出。",
    ),
    "ifc.nothing_round": Sentence(
        "Nothing round lies in their feet: the export may leave out what is cast in (embedded parts, "
        "reinforcement, openings). Sleeves elsewhere, or drawn in another way, are named with {selector}.",
        "其柱底没有圆形物体：导出可能省略了预埋的内容（预埋件、钢筋、孔洞）。位于别处或以其他方式绘制的套筒，请用 "
        "{selector} 指定。",
    ),
    "ifc.number": Sentence(
        "the number {shown} is given to several entities: the first of each counts, the others were left out",
        "编号 {shown} 用于多个实体：以各自第一个为准，其余未采用",
    ),
    "ifc.numbers": Sentence(
        "the numbers {shown} are given to several entities: the first of each counts, the others were left out",
        "编号 {shown} 用于多个实体：以各自第一个为准，其余未采用",
    ),
    "ifc.on_head": Sentence(
        "is drawn on its head: {count} sleeves open in its upper face; turn it over, and export the model again",
        "画成倒置：有 {count} 个套筒开口于其上表面；请翻正后重新导出模型",
    ),
    "ifc.opens": Sentence(
        "{why}; {shape:word} Ø {bore_mm:.1f} mm, {length_mm:.0f} mm long, opens in the foot face",
        "{why}；{shape:word}Ø {bore_mm:.1f} mm，长 {length_mm:.0f} mm，开口于柱底面",
    ),
    "ifc.opens_nowhere": Sentence("{why}; opens in no column's foot face", "{why}；未开口于任何柱的柱底面"),
    "ifc.opens_nowhere.solid": Sentence(
        "{why}; opens in no column's foot face; drawn without a bore",
        "{why}；未开口于任何柱的柱底面；画成实心",
    ),
    "ifc.other_encoding": Sentence(
        "{others} names are not in {best} and were read in whatever fits them",
        "有 {others} 个名称不是 {best}，已按相符的编码读取",
    ),
    "ifc.other_sleeve": Sentence("has a property that names another kind of sleeve", "有属性指明是另一种套筒"),
    "ifc.raw": Sentence(
        "names are written in raw {best}, not as STEP wants it; they were read as {best}",
        "名称直接以 {best} 写成，不合 STEP 的规定；已按 {best} 读取",
    ),
    "ifc.raw.close": Sentence(
        "names are written in raw {best}, not as STEP wants it; they were read as {best}; {close} is nearly as likely",
        "名称直接以 {best} 写成，不合 STEP 的规定；已按 {best} 读取；{close} 几乎同样可能",
    ),
    "ifc.reference_only": Sentence(
        "Its columns have no geometry that could be evaluated: export it with bodies, not as a reference only.",
        "其柱没有可求值的几何：请连同实体导出，而不只是参照。",
    ),
    "ifc.round_things": Sentence(
        "Round things in their feet: {shown:;}. Where these are sleeves, say {selector}.",
        "其柱底的圆形物体：{shown:;}。若其为套筒，请用 {selector}。",
    ),
    "ifc.same_place": Sentence(
        "has sleeves that belong to column {column}, which stands in the same place",
        "其套筒属于位于同一处的柱 {column}",
    ),
    "ifc.schema": Sentence(
        "{path} cannot be read as an IFC model: {why}. Export it as IFC2X3, IFC4 or IFC4X3.",
        "{path} 无法按 IFC 模型读取：{why}。请导出为 IFC2X3、IFC4 或 IFC4X3。",
    ),
    "ifc.schema_read": Sentence("its schema {names} was read as {taken}", "其格式 {names} 按 {taken} 读取"),
    "ifc.selector": Sentence(
        "{option} '{query}' (in a job: {key} = \"{query}\" in [model])",
        "{option} '{query}'（在任务中：[model] 下 {key} = \"{query}\"）",
    ),
    "ifc.several": Sentence("{count:d} {type} ({shown})", "{count:d} 个 {type}（{shown}）"),
    "ifc.shared_id": Sentence(
        "1 GlobalId is given to several elements ({shown:;}): they were told apart as entities, but results "
        "cannot be written to the right one of them; export the model with a GlobalId for each element",
        "1 个 GlobalId 用于多个构件（{shown:;"
        "}）：已按实体区分，但结果无法写到正确的构件；请重新导出模型，使每个构件的 GlobalId 唯一",
    ),
    "ifc.shared_ids": Sentence(
        "{count:d} GlobalIds are given to several elements ({shown:;}): they were told apart as entities, but "
        "results cannot be written to the right one of them; export the model with a GlobalId for each element",
        "{count:d} 个 GlobalId 用于多个构件（{shown:;"
        "}）：已按实体区分，但结果无法写到正确的构件；请重新导出模型，使每个构件的 GlobalId 唯一",
    ),
    "ifc.short": Sentence(
        "is {length_mm:.0f} mm long at an inner diameter of {bore_mm:g} mm: too short for a grouting sleeve",
        "内径 {bore_mm:g} mm 而长 {length_mm:.0f} mm：对灌浆套筒来说太短",
    ),
    "ifc.skipped": Sentence("a line was skipped: {why}", "跳过一行：{why}"),
    "ifc.sleeve_aslant": Sentence(
        "is not upright and opens in no column's foot face",
        "不竖直，且未开口于任何柱的柱底面",
    ),
    "ifc.sleeve_shape": Sentence(
        "is called a sleeve, but nothing in its shape is a straight round body or hole",
        "名为套筒，但形状中没有直的圆柱体或圆孔",
    ),
    "ifc.sleeve_undrawn": Sentence("is called a sleeve, but {why}", "名为套筒，但{why}"),
    "ifc.solid": Sentence(
        "{count} sleeves are drawn without a bore: the diameter taken may be the outer one",
        "有 {count} 个套筒画成实心：所取直径可能是外径",
    ),
    "ifc.thickness": Sentence("is {diameter_mm:g} mm thick: no reinforcing bar", "粗 {diameter_mm:g} mm：不是钢筋"),
    "ifc.under_foot": Sentence(
        "upright under the foot, {apart_mm:.1f} mm beside the axis of {label}",
        "柱底下方的竖直钢筋，距 {label} 轴线 {apart_mm:.1f} mm",
    ),
    "ifc.under_none": Sentence("upright, under no sleeve of a column", "竖直，但不在任何柱的套筒下方"),
    "ifc.unit": Sentence(
        "{path} declares a unit of {called} of {scale:g} SI units: export it again.",
        "{path} 声明的 {called} 单位为 {scale:g} 个 SI 单位：请重新导出。",
    ),
    "ifc.unit_itself": Sentence("a unit is defined by itself", "单位以自身定义"),
    "ifc.unit_senseless": Sentence(
        "{path} declares a unit of {called} that makes no sense: export it again.",
        "{path} 声明的 {called} 单位没有意义：请重新导出。",
    ),
    "ifc.unread": Sentence(
        "{path} cannot be read as an IFC model: {why}. Export it again.",
        "{path} 无法按 IFC 模型读取：{why}。请重新导出。",
    ),
    "ifc.zip_holds": Sentence(
        "{path} holds {what} ({shown}): an .ifczip holds one. Unpack it and name the .ifc that is meant.",
        "{path} 含 {what}（{shown}）：.ifczip 应只含一个。请解压并指定所要的 .ifc。",
    ),
    "ifc.zip_models": Sentence("{count:d} models", "{count:d} 个模型"),
    "ifc.zip_no_model": Sentence("no .ifc in STEP format", "的内容中没有 STEP 格式的 .ifc"),
    "ifc.zip_nothing": Sentence("nothing", "空"),
    "ifc.zip_refused": Sentence(
        "{path} {why}: it was not opened. Pack it again, or name the .ifc itself.",
        "{path}{why}：未打开。请重新打包，或指定其中的 .ifc。",
    ),
}
