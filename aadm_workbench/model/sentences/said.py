"""How sentences are put together: of whom, and several in one."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "said.all": Sentence("{parts:;}", "{parts:;}"),
    "said.between": Sentence("{first}–{second}: {why}", "{first}–{second}：{why}"),
    "said.of": Sentence("{what:word}: {why}", "{what:word}：{why}"),
    "said.of_file": Sentence("{file}: {why}", "{file}：{why}"),
    "said.with_notes": Sentence("{why}; {notes:;}", "{why}；{notes:;}"),
}
