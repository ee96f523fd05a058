"""What is fuzzed of models: each kind as a function of a random generator, and what must hold of whatever is read."""

from __future__ import annotations

import json
import tempfile
import warnings
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.design.element_json import from_json, to_json
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.read import read_model
from aadm_workbench.design.recognise.columns import Origin, recognise
from aadm_workbench.errors import AadmError
from tests.fuzz.dice import Dice
from tests.fuzz.ifc_mutations import mutated
from tests.fuzz.ifc_seeds import packed, seeds


def plain(rng: Dice) -> bytes:
    return mutated(rng.choice(seeds()), rng)


def ifczip(rng: Dice) -> bytes:
    """A mutated model in an archive, or a valid one in an archive of damaged bytes."""
    if rng.number() < 0.7:
        return packed(plain(rng))
    held = bytearray(packed(seeds()[0]))
    for _ in range(1 + rng.below(6)):
        held[rng.below(len(held))] = rng.below(256)
    return bytes(held[: rng.below(len(held))]) if rng.number() < 0.3 else bytes(held)


def elements(rng: Dice) -> bytes:
    """What FreeCAD's process hands over of a small yard, with numbers and lists that make no sense."""
    document = json.loads(_yard_of_elements())
    for _ in range(1 + rng.below(4)):
        element = rng.choice(document)
        _spoil(element if rng.number() < 0.1 else element["solids"], rng)
    return json.dumps(document).encode()


@cache
def _yard_of_elements() -> str:
    from tests.design.test_elements import BARS, RING, column, element, hole

    sleeves = [element(f"灌浆套筒 {k}", [hole(x, y)]) for k, (x, y) in enumerate(RING)]
    return json.dumps(to_json([column("C-1", "IfcColumn"), column("Body"), *sleeves, *BARS]))


def _spoil(value: Any, rng: Dice) -> None:
    """Replace something deep in what is drawn of an element; its names are texts, whatever they say."""
    while isinstance(value, dict | list) and value:
        drawn = ("solids", "T_model_element", "tubes", "bars", "edges")
        keys = [key for key in value if key in drawn] if isinstance(value, dict) else list(range(len(value)))
        key = rng.choice(keys)
        if not isinstance(value[key], dict | list) or rng.number() < 0.1:
            value[key] = rng.choice(_SPOILT)
            return
        value = value[key]


_SPOILT: tuple[Any, ...] = (0.0, -1.0, 1e308, float("nan"), float("inf"), None, [], "", {}, 1e-320, 7)


KINDS: dict[str, Callable[[Dice], bytes]] = {"plain": plain, "ifczip": ifczip, "elements": elements}
_SUFFIXES = {"plain": ".ifc", "ifczip": ".ifczip"}


def tried(kind: str, content: bytes) -> str:
    """``read``, ``refused``, or what came out that must not: an error of another kind, a number that is none."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            found = _recognised(content) if kind == "elements" else read_bytes(content, _SUFFIXES[kind])
        except AadmError as error:
            return "refused" if str(error).strip() else "refused without a word"
        except Exception as error:  # noqa: BLE001 - that is what is looked for
            return f"{type(error).__name__}: {error}"
    return "read" if _makes_sense(found) else "numbers that are none came through"


def read_bytes(content: bytes, suffix: str) -> ModelDesign:
    folder = Path("/dev/shm")
    with tempfile.NamedTemporaryFile(dir=folder if folder.is_dir() else None, suffix=suffix) as stream:
        stream.write(content)
        stream.flush()
        return read_model(stream.name)


def _recognised(content: bytes) -> ModelDesign:
    try:
        given = from_json(json.loads(content))
    except (LookupError, TypeError, ValueError) as error:
        raise AadmError(str(error) or "no elements") from error  # as the reader says it
    return recognise(given, Origin("model", "", ""))


def _makes_sense(model: ModelDesign) -> bool:
    points = [point for column in model.columns for point in (*column.sleeves, *column.rebars)]
    points += [*model.loose_sleeves, *model.loose_rebars]
    numbers = [value for point in points for value in (*point.centre, *point.axis, point.diameter_mm)]
    numbers += [value for column in model.columns for value in np.ravel(column.T_model_column)]
    return bool(np.isfinite(np.array(numbers, dtype=np.float64)).all()) and all(p.diameter_mm > 0.0 for p in points)
