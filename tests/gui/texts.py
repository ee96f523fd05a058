"""All texts of the workbench that a person reads, and their Chinese: keeps ``AADM_zh-CN.ts`` and ``.qm`` up to date.

Run it after changing a text: ``python tests/gui/texts.py``. It needs Qt's ``lrelease`` (Debian: qttools5-dev-tools).
"""

import ast
import os
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "aadm_workbench"
FOLDER = PACKAGE / "resources" / "translations"
TS, QM = FOLDER / "AADM_zh-CN.ts", FOLDER / "AADM_zh-CN.qm"
MARKERS = {"translate", "QT_TRANSLATE_NOOP"}

Text = tuple[str, str]
"""Context and source text."""


def texts_in_code() -> set[Text]:
    """Texts that the package's Python marks for translation."""
    found: set[Text] = set()
    for file in sorted([*(PACKAGE / "gui").rglob("*.py"), *(PACKAGE / "document").rglob("*.py")]):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and _name(node.func) in MARKERS and len(node.args) >= 2:
                context, text = node.args[:2]
                if isinstance(context, ast.Constant) and isinstance(text, ast.Constant):
                    found.add((str(context.value), str(text.value)))
    return found


def texts_in_forms() -> set[Text]:
    """Texts of the forms that are not marked as no text."""
    found: set[Text] = set()
    for file in (PACKAGE / "resources" / "ui").glob("*.ui"):
        root = ElementTree.parse(file).getroot()
        context = root.findtext("class") or ""
        found |= {(context, entry.text or "") for entry in root.iter("string") if entry.get("notr") != "true"}
    return found


def all_texts() -> set[Text]:
    """Everything that is to be translated."""
    return texts_in_code() | texts_in_forms()


def translated() -> dict[Text, str]:
    """The translations of the .ts file; empty texts for what is not translated yet."""
    if not TS.exists():
        return {}
    return {
        (context.findtext("name") or "", message.findtext("source") or ""): message.findtext("translation") or ""
        for context in ElementTree.parse(TS).getroot().iter("context")
        for message in context.iter("message")
    }


def write_ts(known: dict[Text, str]) -> None:
    """Write the .ts file with all texts of today, in a stable order."""
    root = ElementTree.Element("TS", {"version": "2.1", "language": "zh_CN", "sourcelanguage": "en"})
    contexts: dict[str, ElementTree.Element] = {}
    for context, text in sorted(all_texts()):
        if context not in contexts:
            contexts[context] = ElementTree.SubElement(root, "context")
            ElementTree.SubElement(contexts[context], "name").text = context
        message = ElementTree.SubElement(contexts[context], "message")
        ElementTree.SubElement(message, "source").text = text
        translation = ElementTree.SubElement(message, "translation")
        translation.text = known.get((context, text), "")
        if not translation.text:
            translation.set("type", "unfinished")
    ElementTree.indent(root, " ")
    TS.write_text(
        '<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n' + ElementTree.tostring(root, "unicode") + "\n"
    )


def lrelease() -> str | None:
    """Qt's compiler of translations, wherever Debian puts it."""
    places = [os.environ.get("LRELEASE", ""), "lrelease", "/usr/lib/qt5/bin/lrelease", "/usr/lib/qt6/bin/lrelease"]
    return next((found for place in places if place and (found := shutil.which(place))), None)


def _name(function: ast.expr) -> str:
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


if __name__ == "__main__":
    write_ts(translated())
    program = lrelease()
    if program is None:
        sys.stderr.write("lrelease was not found: apt-get install qttools5-dev-tools\n")
        raise SystemExit(2)
    raise SystemExit(subprocess.run([program, "-silent", str(TS), "-qm", str(QM)], check=False).returncode)
