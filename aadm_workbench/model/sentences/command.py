"""What the commands say of what they are asked for, of links and virtual cameras, and of what is not installed."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "command.did_you_mean": Sentence('did you mean "{near}"?', "是否指“{near}”？"),
    "command.known": Sentence("known: {known}", "已知：{known}"),
    "command.asks_without_scan": Sentence(
        "column {column}: the job asks for {parts}, but names no scan for it",
        "柱 {column}：任务要求{parts}，但未给出其扫描",
    ),
    "command.cannot_write": Sentence(
        "{file}: cannot be written ({why}); check its folder", "{file}：无法写入（{why}）；请检查其文件夹"
    ),
    "command.edge_mask_camera": Sentence(
        "--filter edge-mask wants the brightness of the scan: use --camera fringe",
        "--filter edge-mask 需要扫描的亮度：请使用 --camera fringe",
    ),
    "command.events_and_json": Sentence(
        "--events - and --json both want stdout; write the events into a file",
        "--events - 与 --json 都要写到标准输出；请把事件写入文件",
    ),
    "command.folder_gone": Sentence(
        "{folder}: cannot be listed any more ({why})", "{folder}：已无法列出其内容（{why}）"
    ),
    "command.folder_is_link": Sentence(
        "{folder}: is a symbolic link; where it leads may be meant, then say so with --out",
        "{folder}：是符号链接；若确要写到其所指之处，请用 --out 指明",
    ),
    "command.link_to_nothing": Sentence(
        "nothing to link to: say --opcua PORT, --modbus PORT or --mqtt BROKER",
        "没有要连接的对象：请给出 --opcua 端口、--modbus 端口或 --mqtt 代理",
    ),
    "command.named_twice": Sentence(
        '{job}, line {line}: "{id}" and "{other}" (line {other_line}) are one column of {model} ({column}); '
        "name it once",
        "{job} 第 {line} 行：“{id}”与“{other}”（第 {other_line} 行）是 {model} 中的同一根柱（{column}）；请只写一次",
    ),
    "command.no_folder": Sentence(
        "{folder}: the folder cannot be made ({why})",
        "{folder}：无法建立该文件夹（{why}）",
    ),
    "command.no_producer": Sentence(
        "no producer is known: name one, gentl:FILE.cti, or set {variable}",
        "没有已知的 GenTL 驱动：请给出 gentl:FILE.cti，或设置 {variable}",
    ),
    "command.no_question": Sentence(
        "{file}: is no question of the workbench ({error})", "{file}：不是工作台的提问文件（{error}）"
    ),
    "command.no_report_folder": Sentence(
        "{folder}: the folder for the reports cannot be made ({why})", "{folder}：无法建立报告文件夹（{why}）"
    ),
    "command.no_room_for_sleeves": Sentence(
        "sleeves {cover_mm:g} mm from the sides of a column of {size_mm:g} mm leave no room",
        "套筒距柱边 {cover_mm:g} mm，而柱边长为 {size_mm:g} mm，放不下",
    ),
    "command.no_such_column": Sentence(
        '{job} has no column "{name}" (--only); {meant}', "{job} 中没有柱“{name}”（--only）；{meant}"
    ),
    "command.no_such_sleeve": Sentence(
        "the column has no sleeve {names}; it has {first} to {last}", "该柱没有套筒 {names}；其套筒为 {first} 至 {last}"
    ),
    "command.no_watched_folder": Sentence(
        "{folder}: there is no such folder to watch", "{folder}：没有这个要监视的文件夹"
    ),
    "command.nothing_to_match": Sentence(
        "{job} has nothing to match: it needs scans of sleeves and scans of rebars",
        "{job} 中没有可配对的内容：需要套筒扫描和钢筋扫描",
    ),
    "command.opcua_open": Sentence(
        "--opcua on an address that others reach needs --certificates DIR: without, anybody could read",
        "在他人可达的地址上使用 --opcua 时必须给出 --certificates 文件夹：否则任何人都能读取",
    ),
    "command.plan_of_what": Sentence(
        "name a job with --column, or a column with --size", "请给出任务和 --column，或用 --size 给出柱的尺寸"
    ),
    "command.report_of_job": Sentence(
        "{file}: of a job only --scan-card can be made; check it first (aadm check {job}), then name its report.json",
        "{file}：由任务只能生成 --scan-card；请先检查（aadm check {job}），再给出其 report.json",
    ),
    "command.seed_below_zero": Sentence(
        "--seed must not be below zero, it is {seed}", "--seed 不得小于零，当前为 {seed}"
    ),
    "command.several_columns": Sentence(
        "{model} holds {count} columns: {called}. Select one of them.",
        "{model} 中有 {count} 根柱：{called}。请选择其中一根。",
    ),
    "command.stack_write": Sentence(
        "--write-ifc writes one report into its model: name one REPORT.json and --model",
        "--write-ifc 把一份报告写入其模型：请给出一个 REPORT.json 和 --model",
    ),
    "command.tls_halved": Sentence(
        "--tls-ca and --tls-cert go together: whom to trust, and what to be trusted by",
        "--tls-ca 与 --tls-cert 须同时给出：信任谁，以及凭什么被信任",
    ),
    "command.tls_without_scheduler": Sentence(
        "--tls-ca, --tls-cert and --tls-key go with --scheduler; workers of this machine need none",
        "--tls-ca、--tls-cert、--tls-key 与 --scheduler 一起使用；本机进程不需要",
    ),
    "command.which_column": Sentence(
        "say with --column which column of the job is meant", "请用 --column 指明任务中的哪一根柱"
    ),
    "command.write_into_other": Sentence(
        "{job}: --write-ifc writes into IFC models (.ifc), but [model] path is {model}",
        "{job}：--write-ifc 只写入 IFC 模型（.ifc），而 [model] path 为 {model}",
    ),
    "command.write_without_model": Sentence(
        "{job}: --write-ifc needs a [model], for results are written into the model's elements",
        "{job}：--write-ifc 需要 [model]，因为结果要写入模型的构件",
    ),
    "command.writeback_of_what": Sentence(
        "{file}: name the report and the model: aadm writeback REPORT.json MODEL.ifc",
        "{file}：请给出报告与模型：aadm writeback REPORT.json MODEL.ifc",
    ),
    "command.no_bars": Sentence("the design of {column} has no bars", "{column} 的设计中没有钢筋"),
    "command.no_sleeves": Sentence(
        "{label} has no grouting sleeves in its foot face. {why}", "{label} 的柱底没有灌浆套筒。{why}"
    ),
    "command.link_authority": Sentence(
        "{folder}: needs ca.pem, the broker's authority ({why})", "{folder}：需要 ca.pem，即代理的根证书（{why}）"
    ),
    "command.link_halved": Sentence(
        "{folder}: holds one of certificate.der and key.pem; both are needed, or none",
        "{folder}：certificate.der 与 key.pem 只有其一；须两者都有，或都没有",
    ),
    "command.link_no_broker": Sentence(
        "{broker}: is no broker; write HOST or HOST:PORT", "{broker}：不是 MQTT 代理地址；请写 HOST 或 HOST:PORT"
    ),
    "command.link_not_listening": Sentence(
        "{where}: cannot listen ({why}); is the port taken?", "{where}：无法监听（{why}）；端口是否已被占用？"
    ),
    "command.link_port": Sentence(
        "{where}: cannot listen; is the port taken, or below 1024?",
        "{where}：无法监听；端口是否已被占用，或小于 1024？",
    ),
    "command.link_refused": Sentence(
        "{address}: the MQTT broker refuses the connection ({why:word})", "{address}：MQTT 代理拒绝连接（{why:word}）"
    ),
    "command.link_silent": Sentence(
        "{address}: the MQTT broker does not answer ({why})", "{address}：MQTT 代理没有应答（{why}）"
    ),
    "command.twin_case": Sentence(
        "{id} ({story}) came out as {verdict:word}, {goes_on:word}: change the seed or the case",
        "{id}（{story}）的结果为{verdict:word}、{goes_on:word}：请改变种子或该算例",
    ),
    "command.twin_filter": Sentence(
        "--filter {word}: there is no filter {name}; there are {known}",
        "--filter {word}：没有滤波 {name}；可用的有 {known}",
    ),
    "command.twin_filter_number": Sentence(
        "--filter {word}: {name} wants {kind:word} after an equals sign",
        "--filter {word}：{name} 的等号后应为{kind:word}",
    ),
    "command.twin_filter_range": Sentence(
        "--filter {word}: {name} goes from 0 to {most:g}", "--filter {word}：{name} 的范围为 0 至 {most:g}"
    ),
    "command.twin_site": Sentence(
        "--site {name}: no site does that; there are {known}", "--site {name}：没有这种现场情况；可用的有 {known}"
    ),
    "command.twin_slip": Sentence(
        "--slip {name}: there is no such slip; there are {known}", "--slip {name}：没有这种差错；可用的有 {known}"
    ),
    "command.twin_stands": Sentence("the column stands", "柱已就位"),
    "command.twin_undecided": Sentence(
        "the controller decided nothing within {within_s:g} s", "控制器在 {within_s:g} s 内没有作出决定"
    ),
    "command.missing": Sentence(
        "{needed_for:word} needs the package {package}, which is not installed. Install it with: {install}",
        "{needed_for:word}需要软件包 {package}，但未安装。安装命令：{install}",
    ),
    "command.missing.private": Sentence(
        "{needed_for:word} needs the package {package}, which is not installed. FreeCAD's private environment "
        "lacks it: repair that in About AADM and doctor, or name in the settings an aadm of your own that has it "
        "({install})",
        "{needed_for:word}需要软件包 {package}，但未安装。FreeCAD 的私有环境中缺少它：请在“关于 AADM "
        "与环境诊断”中修复，或在设置中指定已装有它的 aadm（{install}）",
    ),
    "command.usage.ambiguous": Sentence(
        "ambiguous option: {option} could match {matches}", "选项 {option} 不明确，可能是 {matches}"
    ),
    "command.usage.argument": Sentence("argument {name}: {why}", "参数 {name}：{why}"),
    "command.usage.at_least_one": Sentence("expected at least one argument", "至少需要一个值"),
    "command.usage.at_most_one": Sentence("expected at most one argument", "最多一个值"),
    "command.usage.choice": Sentence(
        "invalid choice: {value} (choose from {choices})", "没有 {value}，可选：{choices}"
    ),
    "command.usage.error": Sentence("{program}: error: {what}", "{program}：错误：{what}"),
    "command.usage.explicit": Sentence("ignored explicit argument {value}", "该选项不带值，不应写 {value}"),
    "command.usage.length": Sentence("{value} is not a length above zero", "{value} 不是大于零的长度"),
    "command.usage.limit": Sentence("{value} is no limit; write {example}", "{value} 不是限值；请写 {example}"),
    "command.usage.memory": Sentence(
        "{value} is too little memory to check anything; give 600MB or more",
        "内存 {value} 太少，无法检查；请给出 600MB 以上",
    ),
    "command.usage.missing": Sentence("the following arguments are required: {names}", "缺少参数：{names}"),
    "command.usage.not_with": Sentence("not allowed with argument {name}", "不能与参数 {name} 同用"),
    "command.usage.one": Sentence("expected one argument", "需要一个值"),
    "command.usage.one_of": Sentence("one of the arguments {names} is required", "须给出以下参数之一：{names}"),
    "command.usage.other": Sentence("{words}", "解析器报告“{words}”"),
    "command.usage.parser": Sentence(
        "unknown parser {value} (choices: {choices})", "没有命令 {value}，可选：{choices}"
    ),
    "command.usage.port": Sentence(
        "{value} is no port; write a number from 1 to 65535", "{value} 不是端口；请写 1 到 65535 的数字"
    ),
    "command.usage.several": Sentence("expected {count} arguments", "需要 {count} 个值"),
    "command.usage.time": Sentence("{value} is no time; write {example}", "{value} 不是时间；请写 {example}"),
    "command.usage.unexpected": Sentence("unexpected option string: {option}", "此处不应有选项 {option}"),
    "command.usage.unknown": Sentence("unrecognized arguments: {words}", "不认识的参数：{words}"),
    "command.usage.usage": Sentence("usage: ", "用法："),
    "command.usage.value": Sentence("invalid {type} value: {value}", "{value} 不是 {type} 类型的值"),
    "command.usage.whole_number": Sentence("{value} is not a whole number above zero", "{value} 不是大于零的整数"),
}
