"""Translations: every text has its Chinese, and the compiled file is that of the text file."""

import string
import xml.etree.ElementTree as ElementTree

import pytest

from tests.gui.texts import FOLDER, QM, TS, all_texts, translated


def test_every_text_is_translated_and_no_other() -> None:
    known = translated()
    assert known.keys() == all_texts(), "run: python tests/gui/texts.py"
    assert [text for text, chinese in known.items() if not chinese] == []


def test_placeholders_are_kept() -> None:
    def names(text: str) -> list[str]:
        return sorted(name for _, name, _, _ in string.Formatter().parse(text) if name)

    assert [text for text, chinese in translated().items() if names(text[1]) != names(chinese)] == []


def test_ts_is_well_formed() -> None:
    root = ElementTree.parse(TS).getroot()
    assert root.get("language") == "zh_CN"
    assert sorted(path.name for path in FOLDER.iterdir()) == [QM.name, TS.name]


@pytest.mark.freecad
def test_compiled_file_holds_the_same(freecad, repository) -> None:
    result = freecad.run(
        "from PySide import QtCore\n"
        "translator = QtCore.QTranslator()\n"
        f"assert translator.load({str(QM)!r})\n"
        f"asked = {sorted(all_texts())!r}\n"
        "result['found'] = [translator.translate(context, text) for context, text in asked]\n"
    )
    known = translated()
    assert result["found"] == [known[text] for text in sorted(all_texts())], "run: python tests/gui/texts.py"
