"""Numbers as people read them: what can be off to either side says to which, and no zero has a minus."""

from typing import get_args

import numpy as np
import pytest

from aadm_workbench.report.sheets.numbers import is_number, number_text, number_texts
from aadm_workbench.report.sheets.tables import ABSOLUTE, HOISTING, PAIRS, POINTS, SPACING, CellKind


@pytest.mark.parametrize(("value", "said"), [(0.314, "+0.31"), (-0.314, "-0.31"), (0.0, "+0.00"), (-0.004, "+0.00")])
def test_offsets_have_their_sign(value: float, said: str) -> None:
    assert number_text(value, "mm_signed") == said
    assert number_text(value, "mm") == said.removeprefix("+")


def test_every_table_shows_the_sign_of_what_has_one() -> None:
    for headings in (POINTS, PAIRS, ABSOLUTE, HOISTING):
        signed = [heading.name.en for heading in headings if heading.kind == "mm_signed"]
        assert {"dx", "dy"} <= set(signed)
    assert [heading.kind for heading in SPACING if heading.name.en == "Deviation"] == ["mm_signed"]


@pytest.mark.parametrize("kind", [kind for kind in get_args(CellKind) if is_number(kind)])
def test_a_column_of_numbers_is_written_as_each_of_them(kind: CellKind) -> None:
    """Two ways to the same text: on a page a column at once, in a sentence one alone."""
    values = [*np.random.default_rng(7).normal(0.0, 0.02, 400).tolist(), 0.0, -0.0, -0.0004, -0.4, 1234.5, None, "", 3]
    expected = ["" if value is None or value == "" else number_text(value, kind) for value in values]
    assert number_texts(values, kind) == expected
    assert number_texts([value for value in values if value != ""], kind) == [
        text for text, value in zip(expected, values, strict=True) if value != ""
    ]
    zeros = [text for text in expected if text.strip("+-0. %") == "" and text]
    assert zeros
    assert not any(text.startswith("-") for text in zeros if kind != "share")
