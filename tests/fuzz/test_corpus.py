"""The fuzzers' corpus, replayed: seeds of every format, and what once broke a reader."""

import warnings
from pathlib import Path

import pytest

from .targets import TARGETS

CORPUS = Path(__file__).resolve().parent / "corpus"
LARGEST_CORPUS_BYTES = 300_000


@pytest.mark.parametrize("name", TARGETS)
def test_no_reader_breaks_on_its_corpus(name: str) -> None:
    seeds = sorted((CORPUS / name).iterdir())
    assert seeds, "no corpus"
    for seed in seeds:
        content = seed.read_bytes()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            TARGETS[name](content)
            for length in range(0, len(content), max(1, len(content) // 23)):
                TARGETS[name](content[:length])


def test_the_corpus_stays_small() -> None:
    assert sum(path.stat().st_size for path in CORPUS.rglob("*") if path.is_file()) < LARGEST_CORPUS_BYTES
