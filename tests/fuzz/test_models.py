"""A short, seeded slice of the fuzzing of models; the long runs are those of fuzz_models.py."""

import pytest

from tests.fuzz.dice import Dice
from tests.fuzz.ifc_seeds import seeds
from tests.fuzz.model_targets import KINDS, read_bytes, tried

SLICE = {"plain": 24, "ifczip": 10, "elements": 120}


@pytest.mark.parametrize("kind", KINDS)
def test_mutated_models_are_read_or_refused(kind: str) -> None:
    outcomes = {}
    for number in range(SLICE[kind]):
        outcome = tried(kind, KINDS[kind](Dice(number)))
        outcomes[outcome] = outcomes.get(outcome, 0) + 1
    assert set(outcomes) == {"read", "refused"}, outcomes


def test_unmutated_seeds_hold_a_whole_column() -> None:
    for seed in seeds():
        (column,) = read_bytes(seed, ".ifc").columns
        assert len(column.sleeves) == len(column.rebars) == 4
