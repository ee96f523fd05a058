"""Functions hand back codes of the table of sentences, or reasons made of them: no sentence of their own."""

import ast
import re
from collections.abc import Iterator

from tests.report.words.test_sentences import ROOT, modules


def returned_texts() -> Iterator[tuple[str, str]]:
    """What functions hand back that is written there: its place, and its text with ``{}`` for what is filled in."""
    for file, tree in modules().items():
        for node in ast.walk(tree):
            if isinstance(node, ast.Return) and node.value is not None:
                for one in ast.walk(node.value):
                    parts = one.values if isinstance(one, ast.JoinedStr) else [one]
                    texts = [part.value if isinstance(part, ast.Constant) else "{}" for part in parts]
                    if all(isinstance(text, str) for text in texts):
                        yield f"{file.relative_to(ROOT)}:{node.lineno}", "".join(map(str, texts))


SPOKEN = re.compile(r"\b[a-z]{2,} (?:[a-z]{2,}|\{\}) [a-z]{2,}")
NOT_FOR_THE_TABLE = {
    "aadm_workbench/twin": "truth of virtual scans, in English as their files are",
    "aadm_workbench/resources": "a generator of pictures",
    "aadm_workbench/gui": "in the tables of Qt, which their own tests hold",
    "aadm_workbench/document/display": "in the tables of Qt, which their own tests hold",
    "aadm_workbench/report/directions.py": "both languages are made there, word by word",
    "aadm_workbench/private/pythons.py": "what the log of an installation says of the programs that were looked at",
    "aadm_workbench/extract/published": "names of planes in figures",
    "batch/job/inputs.py": "compared with a hash, never shown",
    "batch/commands": "held by the tests of the command's output",
    "batch/shown": "held by the tests of the command's output",
    "batch/link": "a double of a controller says what it does into its own log",
}


def test_no_function_hands_back_a_sentence_of_its_own() -> None:
    own = [
        (place, text)
        for place, text in returned_texts()
        if SPOKEN.search(text) and not place.startswith(tuple(NOT_FOR_THE_TABLE))
    ]
    assert own == []
