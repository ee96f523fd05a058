"""Whether centres of a plate are still found by the laws whose number profiles carry: where they move, it has to rise.

The captures are of the ray caster with other parts than those of any test of accuracy: without a filter and with one
ring dropped. ``laws.json`` holds, for each number, how the centres' errors looked: renew the line of the new number, by
``python -m tests.calibration.test_laws``, and leave the others.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.calibration.learn.capture import captured_plate
from aadm_workbench.calibration.learn.stretch import one_capture
from aadm_workbench.calibration.plate.plate import Plate, drawn_plate
from aadm_workbench.extract.edges.learned_edges import EDGE_LAWS
from aadm_workbench.model import Kind
from aadm_workbench.twin.filters import filters_of
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.pair import Taken
from aadm_workbench.twin.plate import made_plate, plate_captures

KNOWN = Path(__file__).with_name("laws.json")
FILTERS = ("", "rings=1")
MOVED = 4e-5
"""Of a stretch: 0.01 mm over a plate of 480 mm, a fifth of what a check is to be right to."""


def stretches(words: str) -> list[float]:
    """Of holes and of pins, as one capture shows them."""
    rng = np.random.default_rng(1105)
    made = made_plate(drawn_plate(12, 34.0, 150.0, 18.0), rng)
    taken = Taken("ray", filters_of([words] if words else []))
    (shot,) = plate_captures(made, 1, CameraNoise(depth_at_1m=0.05), taken, rng)
    plate: Plate = made.measured
    found = one_capture(captured_plate(shot.scan("plate.tiff"), plate), plate).mean
    return [found[kind] for kind in Kind]


@pytest.mark.parametrize("words", FILTERS)
def test_the_number_of_the_laws_rises_where_centres_move(words: str) -> None:
    known = json.loads(KNOWN.read_text(encoding="utf-8"))
    assert str(EDGE_LAWS) in known, "a new number: run this file, and commit laws.json"
    told = known[str(EDGE_LAWS)][words]
    assert stretches(words) == pytest.approx(told, abs=MOVED), "raise EDGE_LAWS, and run this file"


def test_each_number_stands_for_other_centres() -> None:
    every = [tuple(each[words]) for each in json.loads(KNOWN.read_text(encoding="utf-8")).values() for words in FILTERS]
    assert len(set(every)) == len(every)


if __name__ == "__main__":
    before = json.loads(KNOWN.read_text(encoding="utf-8")) if KNOWN.exists() else {}
    before[str(EDGE_LAWS)] = {words: [round(value, 6) for value in stretches(words)] for words in FILTERS}
    KNOWN.write_text(json.dumps(before, indent=1) + "\n", encoding="utf-8")
