"""Numbers as people read them: what can be off to either side says to which, and no zero has a minus."""

import pytest

from aadm_workbench.report.sheets.numbers import number_text
from aadm_workbench.report.sheets.tables import ABSOLUTE, HOISTING, PAIRS, POINTS, SPACING


@pytest.mark.parametrize(("value", "said"), [(0.314, "+0.31"), (-0.314, "-0.31"), (0.0, "+0.00"), (-0.004, "+0.00")])
def test_offsets_have_their_sign(value: float, said: str) -> None:
    assert number_text(value, "mm_signed") == said
    assert number_text(value, "mm") == said.removeprefix("+")


def test_every_table_shows_the_sign_of_what_has_one() -> None:
    for headings in (POINTS, PAIRS, ABSOLUTE, HOISTING):
        signed = [heading.name.en for heading in headings if heading.kind == "mm_signed"]
        assert {"dx", "dy"} <= set(signed)
    assert [heading.kind for heading in SPACING if heading.name.en == "Deviation"] == ["mm_signed"]
