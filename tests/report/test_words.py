"""Two languages: every text has both, and the sentences of a check are told in Chinese without losing a number."""

import re
from typing import Any

import pytest

from aadm_workbench.report.fonts import FONT_FILE
from aadm_workbench.report.words import all_words
from aadm_workbench.report.words_reasons import in_both_languages

CHINESE = re.compile(r"[\u4e00-\u9fff]")
SAME = {"ui.global_id", "ui.hash", "ui.offset_x", "ui.offset_y", "ui.u", "ui.p_value", "ui.cp", "ui.cpk"}


@pytest.mark.parametrize("name", all_words())
def test_both_languages(name: str) -> None:
    english, chinese = all_words()[name]
    assert english.strip()
    assert name in SAME or name == "ui.language" or CHINESE.search(chinese), "no Chinese"
    assert sorted(re.findall(r"{\w+}", english)) == sorted(re.findall(r"{\w+}", chinese))


def test_font_has_every_character_of_the_words() -> None:
    ttlib = pytest.importorskip("fontTools.ttLib")
    known = ttlib.TTFont(FONT_FILE).getBestCmap()
    used = {sign for text in all_words().values() for sign in text.zh + text.en}
    assert not {sign for sign in used if ord(sign) not in known} - {"✗", "▾"}
    assert all(ord(sign) in known for sign in "柱套筒灌浆连接钢筋預製±≤°²σ龘" if sign != "龘")
    assert FONT_FILE.stat().st_size < 2_500_000


def test_reasons_of_a_real_check_are_told_in_chinese(floor: dict[str, Any]) -> None:
    reasons = [reason for column in floor["columns"] for reason in column["reasons"]]
    assert len(reasons) > 10
    for reason in reasons:
        told = in_both_languages(reason)
        assert told.en == reason
        assert CHINESE.search(told.zh), reason
        assert sorted(re.findall(r"\d+\.\d+|[SR]\d+", told.zh)) == sorted(re.findall(r"\d+\.\d+|[SR]\d+", reason))


def test_unknown_sentence_stays() -> None:
    assert in_both_languages("the moon is full").zh == "the moon is full"
