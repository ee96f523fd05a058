"""What is said of virtual cameras that are asked for what they cannot do."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "twin.case": Sentence(
        "{id} ({story}) came out as {verdict:word}, {goes_on:word}: change the seed or the case",
        "{id}（{story}）的结果为{verdict:word}、{goes_on:word}：请改变种子或该算例",
    ),
    "twin.filter": Sentence(
        "--filter {word}: there is no filter {name}; there are {known}",
        "--filter {word}：没有滤波 {name}；可用的有 {known}",
    ),
    "twin.filter_number": Sentence(
        "--filter {word}: {name} wants {kind:word} after an equals sign",
        "--filter {word}：{name} 的等号后应为{kind:word}",
    ),
    "twin.filter_range": Sentence(
        "--filter {word}: {name} goes from 0 to {most:g}", "--filter {word}：{name} 的范围为 0 至 {most:g}"
    ),
    "twin.site": Sentence(
        "--site {name}: no site does that; there are {known}", "--site {name}：没有这种现场情况；可用的有 {known}"
    ),
    "twin.slip": Sentence(
        "--slip {name}: there is no such slip; there are {known}", "--slip {name}：没有这种差错；可用的有 {known}"
    ),
    "twin.stands": Sentence("the column stands", "柱已就位"),
    "twin.undecided": Sentence(
        "the controller decided nothing within {within_s:g} s", "控制器在 {within_s:g} s 内没有作出决定"
    ),
}
