"""How sentences are put together: of whom, and several in one."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "said.all": Sentence("{parts:;}", "{parts:;}"),
    "said.and_more": Sentence("{shown} and {count:d} more", "{shown} 等，另有 {count:d} 个"),
    "said.between": Sentence("{first}–{second}: {why}", "{first}–{second}：{why}"),
    "said.list": Sentence("{parts}", "{parts}"),
    "said.of": Sentence("{what:word}: {why}", "{what:word}：{why}"),
    "said.of_file": Sentence("{file}: {why}", "{file}：{why}"),
    "said.sentences": Sentence("{parts: }", "{parts: }"),
    "said.with_notes": Sentence("{why}; {notes:;}", "{why}；{notes:;}"),
    "said.section_edge": Sentence("edge {side}", "{side} 边"),
    "said.section_flatness": Sentence("flatness of the face", "底面平整度"),
    "said.section_pattern": Sentence("sleeves in the section, {axis}", "套筒组在截面内，{axis}"),
    "said.section_side": Sentence("side of the section along {axis}", "截面边长，{axis} 向"),
}
