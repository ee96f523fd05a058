"""The fuzzer of containers in small: the first inputs of its seed, and that it notices what it looks for."""

from pathlib import Path

import numpy as np
import pytest

from .containers import CONTAINERS, SEED, Container, fuzz


@pytest.mark.parametrize("name", CONTAINERS)
def test_no_container_breaks_its_reader(name: str) -> None:
    tally = fuzz(name, np.random.default_rng(SEED), lambda tally: tally.inputs < 60)
    assert tally.failed == ""
    assert tally.inputs == 60
    assert 0 < tally.refused <= 60 or name == "journal"


def test_it_notices_a_reader_that_breaks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def read(path: Path) -> None:
        if path.stat().st_size % 2:
            raise KeyError("oops")

    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(CONTAINERS, "bcf", lambda: Container(".bcf", lambda rng: bytes(int(rng.integers(9))), read))
    tally = fuzz("bcf", np.random.default_rng(SEED), lambda tally: tally.inputs < 60)
    assert tally.failed == "KeyError: 'oops'"
    assert len((tmp_path / "crash-bcf.bcf").read_bytes()) % 2
