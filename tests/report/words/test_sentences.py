"""Every sentence for people stands in one table, in both languages; what makes one names it by its code.

The files are read as syntax trees: that a code is known, that each place gets a value, and that nothing asks for words.
"""

import ast
import copy
import re
import string
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from aadm_workbench.errors import AadmError
from aadm_workbench.model import Reason, codes_of, in_one
from aadm_workbench.model.reason import reason_of, renamed
from aadm_workbench.model.sentences import Sentence
from aadm_workbench.report.pages.fonts import FONT_FILE
from aadm_workbench.report.words.reasons import in_both_languages, recognised

ROOT = Path(__file__).resolve().parents[3]
TABLES = ROOT / "aadm_workbench" / "model" / "sentences"
CHINESE = re.compile(r"[\u4e00-\u9fff]")
HALF_WIDTH = re.compile(r"(?<=[\u4e00-\u9fff])[,;:?!(]|[,;:?!](?=[\u4e00-\u9fff])")
ALIKE = {"said.all", "assembly.with_u"}
"""Nothing but places, symbols, and signs between them."""


@cache
def table() -> dict[str, Sentence]:
    """The whole table, read as files are found, not as the product asks for them."""
    found: dict[str, Sentence] = {}
    for file in TABLES.glob("[a-z]*.py"):
        scope: dict[str, dict[str, Sentence]] = {}
        exec(compile(file.read_text(encoding="utf-8"), str(file), "exec"), scope)
        assert all(code.split(".")[0] == file.stem for code in scope["SENTENCES"])
        found |= scope["SENTENCES"]
    return found


def places(text: str) -> list[tuple[str, str]]:
    """Names and formats of the places, by the standard library's own reading."""
    return sorted((name, form or "") for _, name, form, _ in string.Formatter().parse(text) if name)


NAMED_IN_CHINESE = {"repair.disposal_plan", "design.name_sleeves"}
"""What a Chinese designer calls the thing, said in English too."""


ROOMS = sorted({code.split(".")[0] for code in table()})


def codes_in(room: str) -> list[str]:
    return sorted(code for code in table() if code.split(".")[0] == room)


@pytest.mark.parametrize("room", ROOMS)
def test_both_languages_have_the_same_places(room: str) -> None:
    for code in codes_in(room):
        english, chinese = table()[code]
        assert english.strip(), code
        assert CHINESE.search(chinese) or code in ALIKE or not re.search("[A-Za-z]", re.sub("{.*?}", "", english)), code
        assert set(places(english)) == set(places(chinese)), code
        assert not CHINESE.search(english) or code in NAMED_IN_CHINESE, code
        shown = re.sub(r"{\w+:[^}]*[fg%]}", "1", chinese)
        assert not HALF_WIDTH.search(re.sub("{.*?}", "柱", shown)), f"{code}: Chinese signs are as wide as letters"


def test_one_word_for_one_thing() -> None:
    told = "".join(sentence.zh for sentence in table().values())
    folder = ROOT / "aadm_workbench" / "resources"
    told += "".join(path.read_text(encoding="utf-8") for path in (folder / "report").glob("words*.toml"))
    told += (folder / "translations" / "AADM_zh-CN.ts").read_text(encoding="utf-8")
    assert [word for word in ("未测到", "能否套入", "无法判定", "灌浆套管") if word in told] == []


def test_the_font_has_every_sign() -> None:
    known = pytest.importorskip("fontTools.ttLib").TTFont(FONT_FILE).getBestCmap()
    assert {sign for sentence in table().values() for sign in "".join(sentence) if ord(sign) not in known} == set()


@cache
def modules() -> dict[Path, ast.Module]:
    files = [file for folder in ("aadm_workbench", "batch") for file in (ROOT / folder).rglob("*.py")]
    return {file: ast.parse(file.read_text(encoding="utf-8")) for file in files if TABLES not in file.parents}


CODE_AT = {"Reason": 0, "because": 0, "said_of": 1, "about": 1}
"""What makes a reason, or an error with one; the place of the code among its arguments."""


def called(node: ast.AST) -> str:
    """The last name of what is called; empty for what is no call."""
    function = node.func if isinstance(node, ast.Call) else None
    return function.id if isinstance(function, ast.Name) else getattr(function, "attr", "")


@cache
def made() -> list[tuple[str, str, ast.Call]]:
    """Every making of a reason whose code stands there: its place, its code, the call."""
    found = []
    for file, tree in modules().items():
        for node in ast.walk(tree):
            name = called(node)
            if isinstance(node, ast.Call) and name in CODE_AT and len(node.args) > CODE_AT[name]:
                told = node.args[CODE_AT[name]]
                options = [told.body, told.orelse] if isinstance(told, ast.IfExp) else [told]
                codes = [one.value for one in options if isinstance(one, ast.Constant) and isinstance(one.value, str)]
                found += [(f"{file.relative_to(ROOT)}:{node.lineno}", code, node) for code in codes]
    return found


def test_every_code_that_is_made_is_known_and_gets_its_values() -> None:
    wrong = []
    for place, code, call in made():
        if code not in table():
            wrong.append(f"{place}: {code} is not in the table")
            continue
        given = {keyword.arg for keyword in call.keywords}
        lacking = {name for name, _ in places(table()[code].en)} - given
        if lacking and None not in given:
            wrong.append(f"{place}: {code} gets no {lacking}")
    assert wrong == []
    assert len(made()) > 600


SAID_BY_OTHERS = ("words.", "bounded.toml.", "command.usage.")
"""Words of values, and what libraries say: ``test_parsers.py`` holds these against their sources."""


def test_every_sentence_of_the_table_is_made_somewhere() -> None:
    """A sentence that nobody makes any more would be translated for ever."""
    text = "\n".join(file.read_text(encoding="utf-8") for file in modules())
    unmade = []
    for code in table():
        name = code.removeprefix("finding.")
        begin = name.rpartition(".")[0]
        is_made = f'"{name}"' in text or (f'"{begin}' in text and "." in begin) or name != code
        if not is_made and not code.startswith(SAID_BY_OTHERS):
            unmade.append(code)
    assert unmade == []


TOLD = {"reason", "reasons", "said", "text", "texts", "message", "sentence", "notes", "note", "told"}


def words_asked(tree: ast.Module) -> Iterator[int]:
    """Lines on which a sentence is compared with a text, or asked what it holds, begins or ends with."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            literals = [side for side in sides if is_words(side)]
            if literals and any(is_told(side) for side in sides):
                yield node.lineno
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            asks = node.func.attr in {"startswith", "endswith", "removeprefix", "removesuffix", "partition", "find"}
            if asks and any(map(is_words, node.args)) and is_told(node.func.value):
                yield node.lineno


def is_words(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str) and bool(re.search("[a-z]{3}", node.value))


def is_told(node: ast.expr) -> bool:
    """Whether something is called as sentences are, or is the text of an error."""
    if isinstance(node, ast.Call):
        is_text = isinstance(node.func, ast.Name) and node.func.id == "str"
        return is_text and any(isinstance(one, ast.Name) and one.id == "error" for one in node.args)
    if isinstance(node, ast.Subscript):
        return isinstance(node.slice, ast.Constant) and node.slice.value in TOLD
    return (isinstance(node, ast.Name) and node.id in TOLD) or (isinstance(node, ast.Attribute) and node.attr in TOLD)


OTHERS_TEXTS = {
    "aadm_workbench/design/ifc/text/",  # lines of an IFC file
    "aadm_workbench/report/bcf/",  # labels of topics that other programs wrote
    "aadm_workbench/scan/formats/",  # headers and rows of scans
}
"""Where what is called a text, or a message, was written by other programs."""


def test_nothing_is_decided_by_words() -> None:
    wrong = [f"{file.relative_to(ROOT)}:{line}" for file, tree in modules().items() for line in words_asked(tree)]
    assert [place for place in wrong if not place.startswith(tuple(OTHERS_TEXTS))] == []


@pytest.mark.parametrize(
    ("code", "asks"),
    [
        ('cure = "open" if "plugged" in point["reason"] else ""', True),
        ('kept = [reason for reason in report.reasons if "not measured" not in reason]', True),
        ('reason.startswith("not measured: ")', True),
        ('notes = [text for text in scan.notes if not text.startswith("the unit of the file")]', True),
        ('words = str(error).removeprefix("has no ")', True),
        ('cure = "open" if "extract.plugged" in codes_of(reason) else ""', False),
        ('if verdict == "pass" and name.startswith("S"): pass', False),
    ],
)
def test_what_is_noticed_of_words(code: str, asks: bool) -> None:
    assert any(words_asked(ast.parse(code))) is asks


SENTENCES_OF = {"advice", "conclusion", "note", "notes", "reason", "reasons", "text", "why"}
WITHOUT = {"NoFace", "NoFit", "NoFrame", "NoMatch"}
"""What is returned where something was not found: its only argument says why."""


def bare_reasons(tree: ast.Module) -> Iterator[int]:
    """Lines on which a sentence of a report is made of an English text that no table knows."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            name = called(node)
            given = [one.value for one in node.keywords if one.arg in SENTENCES_OF] if name != "Reason" else []
            given += node.args[:1] if name in WITHOUT else []
            parts = [part for one in given for part in (one.elts if isinstance(one, ast.Tuple | ast.List) else [one])]
            if any(is_sentence(part) for part in parts):
                yield node.lineno


def is_sentence(node: ast.expr) -> bool:
    if isinstance(node, ast.JoinedStr):
        return any(is_sentence(part) for part in node.values)
    return isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value.strip()


STAGES = ("extract", "assembly", "hoisting", "design", "scan", "inspection")


def test_no_sentence_of_a_report_is_a_bare_text() -> None:
    folders = tuple(f"aadm_workbench/{stage}/" for stage in STAGES)
    wrong = [f"{file.relative_to(ROOT)}:{line}" for file, tree in modules().items() for line in bare_reasons(tree)]
    assert [place for place in wrong if place.startswith(folders)] == []
    assert list(bare_reasons(ast.parse('f(reasons=(f"{label} is far away",))'))) == [1]
    assert list(bare_reasons(ast.parse("NoFit('two points coincide')"))) == [1]


WORDS = [code.removeprefix("words.") for code in table() if code.startswith("words.")]


def filled(code: str, depth: int = 0) -> Reason:
    """A reason with a value for every place, another for each."""
    values: dict[str, object] = {}
    for number, (name, form) in enumerate(places(table()[code].en)):
        if form == "word":
            values[name] = WORDS[(number + len(code)) % len(WORDS)]
        elif form in {"", "and", ".", ";"}:
            values[name] = f"{name}{number}.tiff"
        else:
            values[name] = number + (3 if form.endswith("d") else 1.25)
    return Reason(code, **values)


ALIASES = {"hoisting.resting": "hoisting.not_seen"}
"""The same but for how two labels are joined."""

SHORT = ("geometry.item", "ifc.counted", "bounded.toml", "command.usage")
"""Hardly more than places: parts of sentences, of which alone nobody could tell what they are."""

AMID = {
    "design.selector_pattern",
    "finding.swapped",
    "hoisting.not_seen",
    "hoisting.resting",
    "ifc.sleeve_shape",
    "points.ply_line",
    "run.folder_held",
    "run.folder_link",
    "run.folder_shut",
    "scan.taken_without",
    "scan.unit_of_job",
}
"""Beside others these read like the beginning of another sentence."""


IN_NO_REPORT = {"command", "document", "jobfile", "report"}
"""Errors that end a command: nothing else is said beside them."""


@pytest.mark.parametrize("room", [room for room in ROOMS if room not in {"said", "words"}])
def test_a_sentence_of_a_report_is_read_back_as_the_reason_that_it_was(room: str) -> None:
    for code in codes_in(room):
        reason = filled(code)
        english, known = str(reason), ALIASES.get(code, code)
        if code.startswith(SHORT):
            continue
        again = recognised(english)
        assert isinstance(again, Reason), code
        assert (again.code, str(again)) == (known, english)
        assert in_both_languages(english).zh == reason.in_language("zh"), code
        if code not in AMID and room not in IN_NO_REPORT:
            beside = recognised(
                f"floor/C-1.tiff: {english}; S1 not measured: no opening: the mouth is plugged or covered"
            )
            assert {known, "extract.plugged"} <= codes_of(beside)
            assert str(beside).startswith("floor/C-1.tiff: ")


def test_what_no_table_knows_stays_and_takes_no_time() -> None:
    for text in ("the moon is full", "", "柱", "; " * 490, ": " * 490, "a; b: c" * 140, "S1 not measured: " * 60):
        assert str(recognised(text)) == text
        assert str(in_both_languages(text).en) == text


def test_a_reason_is_a_text_that_keeps_what_it_is_made_of() -> None:
    plugged = Reason("extract.plugged")
    reason = Reason("assembly.not_measured", label="S7", why=plugged)
    assert reason == "S7 not measured: no opening: the mouth is plugged or covered"
    assert codes_of(reason) == {"assembly.not_measured", "extract.plugged"}
    assert codes_of(str(reason)) == frozenset()
    assert reason.in_language("zh") == "S7 未测得：没有开口：套筒口被堵塞或遮盖"
    assert in_one([reason, reason]) is reason
    assert in_one([]) == ""
    assert in_one([reason, plugged]).startswith("S7 not measured: ")
    with pytest.raises(AttributeError):
        reason.code = "extract.no_bar"  # type: ignore[misc]
    with pytest.raises(KeyError):
        Reason("assembly.not_measured", label="S7")
    with pytest.raises(KeyError):
        Reason("extract.full_of_water")


def test_a_reason_travels_between_processes() -> None:
    reason = Reason("assembly.missing", labels=["S7", Reason("assembly.rebar_of", sleeve="S8")])
    again = copy.deepcopy(reason)
    assert (again, again.code, again.in_language("zh")) == (reason, reason.code, "未测得：S7、S8 的钢筋")
    assert isinstance(again.values["labels"][1], Reason)


def test_a_file_is_renamed_within_a_reason() -> None:
    error = AadmError.about("/home/site/scans/a.ply", "scan.is_empty")
    named = renamed(reason_of(error), "/home/site/scans/a.ply", "scans/a.ply")
    assert named.startswith("scans/a.ply: is empty (0 bytes)")
    assert codes_of(named) == {"said.of_file", "scan.is_empty"}
    assert renamed("/home/x is odd", "/home/x", "x") == "x is odd"
