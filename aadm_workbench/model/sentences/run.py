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
    "run.cannot_run": Sentence(
        "it cannot run aadm ({what}); install there what is installed here",
        "它无法运行 aadm（{what}）；请在那里安装与本机相同的程序",
    ),
    "run.ended": Sentence("ended with status {code:d}", "以状态 {code:d} 结束"),
    "run.ended_at_once": Sentence("each ended at once", "每个都立即结束"),
    "run.folder_unseen": Sentence(
        "it does not see {folder}; share that folder with it, or add --ship-inputs",
        "它看不到 {folder}；请共享该文件夹，或加上 --ship-inputs",
    ),
    "run.gets_no_work": Sentence("the worker {name} gets no work: {why}", "工作进程 {name} 不被分配工作：{why}"),
    "run.job_unseen": Sentence(
        "it does not see {file} as it is here; share that folder with it, or add --ship-inputs",
        "它看到的 {file} 与本机不同或不存在；请共享该文件夹，或加上 --ship-inputs",
    ),
    "run.killed": Sentence("killed by signal {signal}", "被信号 {signal} 终止"),
    "run.killed_in_vain": Sentence("killed (and does not end)", "已终止（但仍未结束）"),
    "run.killed_unseen": Sentence("killed (nobody there says how)", "被终止（那里没有说明原因）"),
    "run.other_code": Sentence("other code under the same version of aadm", "版本相同而代码不同的 aadm"),
    "run.other_versions": Sentence(
        "it has {different}; install the same version there and here", "它装有 {different}；请在两处安装相同的版本"
    ),
    "run.several_threads": Sentence(
        "it calculates in several threads; start it with its nanny, as dask worker does",
        "它以多个线程计算；请像 dask worker 那样连同其 nanny 一起启动",
    ),
    "run.stopped": Sentence("stopped ({what})", "停止（{what}）"),
    "run.stopped_by_dask": Sentence("stopped by Dask ({what})", "被 Dask 停止（{what}）"),
    "run.too_large": Sentence(
        "{how}, because it held more memory than it may (--memory-limit)",
        "{how}，因为占用的内存超过允许值（--memory-limit）",
    ),
    "run.too_long": Sentence(
        "ended after {seconds:g} s, the time limit for one column (--time-limit)",
        "在 {seconds:g} s 后结束：这是单根柱的时限（--time-limit）",
    ),
    "run.no_group": Sentence(
        "the design has no {kind:word}, but the job names a scan of them ({names})",
        "设计中没有{kind:word}，而任务给出了其扫描（{names}）",
    ),
    "run.no_memory": Sentence(
        "there is not enough memory for its scans: check fewer columns at a time, or raise --memory-limit",
        "内存不足以读取其扫描：请减少同时检查的柱数，或增大 --memory-limit",
    ),
    "run.no_scan": Sentence("the job names no scan of its sleeves or rebars", "任务没有给出套筒或钢筋的扫描文件"),
    "run.not_evaluated": Sentence(
        "{model} cannot be evaluated: something in it is not as its format wants it ({error}); export it again "
        "(--debug shows where)",
        "{model} 无法求值：其中有内容不合其格式（{error}）；请重新导出（--debug 可显示位置）",
    ),
    "run.defect": Sentence(
        '--defect "{text}" is none: write COLUMN: POINT DX,DY in mm, as in "C-302: R5 +7.5,0", or "C-301: S7 plugged"',
        '--defect "{text}" 无法识别：格式为 COLUMN: POINT DX,DY（mm），例如 "C-302: R5 +7.5,0"，或 "C-301: S7 plugged"',
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
    "run.journal_changed": Sentence(
        "{file}: was changed while it was written; check again without --resume",
        "{file}：写入期间被改动；请不带 --resume 重新检查",
    ),
    "run.journal_full": Sentence(
        "{file}: the results so far cannot be kept ({why}); make room or let it be written",
        "{file}：已得到的结果无法保存（{why}）；请腾出空间或允许写入",
    ),
    "run.journal_long": Sentence(
        "{file}: has more than {most} lines, which no check writes; check without --resume",
        "{file}：超过 {most} 行，检查不会写出这样的文件；请不带 --resume 检查",
    ),
    "run.journal_refused": Sentence(
        "{file}: results cannot be kept there: {why}",
        "{file}：结果无法保存在那里：{why}",
    ),
    "run.no_answer": Sentence("its answer makes no sense ({why})", "其应答无法理解（{why}）"),
    "run.no_events": Sentence(
        "{target}: events cannot be written there ({why})", "{target}：无法把事件写到那里（{why}）"
    ),
    "run.no_port": Sentence(
        "{address}: names no port; an address is like tls://HOST:8786 (--scheduler)",
        "{address}：未给出端口；地址形如 tls://HOST:8786（--scheduler）",
    ),
    "run.no_process": Sentence(
        "no worker process can be started on this machine: {why}", "本机无法启动工作进程：{why}"
    ),
    "run.no_scheduler": Sentence(
        "no scheduler of Dask answers at {address} ({why}); start one with: dask scheduler",
        "{address} 处没有 Dask 调度器应答（{why}）；启动命令：dask scheduler",
    ),
    "run.no_worker": Sentence("no worker can be used: {why}", "没有可用的工作进程：{why}"),
    "run.no_worker_for": Sentence(
        "there has been no worker for {seconds:.0f} s; start one with: dask worker ADDRESS",
        "已有 {seconds:.0f} s 没有工作进程；启动命令：dask worker 地址",
    ),
    "run.scheduler_gone": Sentence(
        "the scheduler of Dask is gone; look at its own messages", "Dask 调度器已退出；请查看其自身的消息"
    ),
    "run.tls_address": Sentence(
        "{address}: certificates go with an address that begins with tls:// (--scheduler)",
        "{address}：证书只用于以 tls:// 开头的地址（--scheduler）",
    ),
    "run.tls_asked": Sentence(
        "{address}: asks for certificates; name them with --tls-ca, --tls-cert and --tls-key",
        "{address}：要求证书；请用 --tls-ca、--tls-cert、--tls-key 给出",
    ),
    "run.tls_no_file": Sentence(
        "{file}: there is no such file (--tls-ca, --tls-cert, --tls-key)",
        "{file}：没有这个文件（--tls-ca、--tls-cert、--tls-key）",
    ),
    "run.tls_unusable": Sentence(
        "{files}: cannot be used as authority, certificate and key in PEM format ({why})",
        "{files}：不能作为 PEM 格式的根证书、证书和私钥使用（{why}）",
    ),
    "run.worker_folder": Sentence("{folder}: the folder of the workers {why}", "{folder}：工作进程的文件夹{why}"),
    "run.worker_refused": Sentence(
        "no worker can be used: {name} gets no work: {why}", "没有可用的工作进程：{name} 不被分配工作：{why}"
    ),
    "run.folder_held": Sentence(
        "{folder}: {holder:word} is writing its results there; wait for it, or name another folder with --out",
        "{folder}：{holder:word}正在那里写入结果；请等待，或用 --out 给出另一个文件夹",
    ),
    "run.folder_link": Sentence(
        "{file}: {why}, or name another folder with --out", "{file}：{why}，或用 --out 给出另一个文件夹"
    ),
    "run.folder_shut": Sentence(
        "{folder}: nothing can be written there ({why}); name another folder with --out",
        "{folder}：无法写入（{why}）；请用 --out 给出另一个文件夹",
    ),
    "run.holder": Sentence("process {number:d} on {machine}", "{machine} 上的进程 {number:d}"),
    "run.kept": Sentence(
        "{id}: its kept result cannot be used ({why}); check again without --resume",
        "{id}：保存的结果无法使用（{why}）；请不带 --resume 重新检查",
    ),
    "run.no_dask": Sentence(
        "no scheduler of Dask answers at {address} ({why}); start one with: dask scheduler (this is "
        "distributed {version}; all of a cluster must have the same)",
        "{address} 处没有 Dask 调度器应答（{why}）；启动命令：dask scheduler（本机为 distributed {version}，集"
        "群各处须相同）",
    ),
    "run.tls_refused": Sentence(
        "{address}: does not take the certificate of --tls-cert, or does not speak TLS ({why}); it must be "
        "signed by the authority that the scheduler was started with",
        "{address}：不接受 --tls-cert 的证书，或不支持 TLS（{why}）；证书须由启动调度器所用的根证书签发",
    ),
    "run.tls_signed": Sentence(
        "{address}: its certificate is not signed by the authority of --tls-ca ({why})",
        "{address}：其证书不是由 --tls-ca 的根证书签发（{why}）",
    ),
}
