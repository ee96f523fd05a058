"""What attributes of an element say against what is drawn: geometry is believed, and the contradiction is named."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from aadm_workbench.design.ifc.names import properties, text_of
from aadm_workbench.design.ifc.text.file import OpenedIfc
from aadm_workbench.design.recognise.pattern import nominal_of_over_ribs
from aadm_workbench.model import Reason
from aadm_workbench.model.reason import listed

_LENGTHS_MM = {"feet": 304.8, "inches": 25.4, "metres": 1000.0, "centimetres": 10.0, "millimetres": 1.0}
_AREAS_MM2 = {"cm²": 100.0, "m²": 1e6, "mm²": 1.0, "square inches": 645.16, "square feet": 92903.04}
_DIAMETER = re.compile(
    r"(nominal|bar|rebar)?[ _-]?(bar)?[ _-]?(diameter|size)|(公称|公稱|钢筋)?直[径徑]|呼び径|鉄筋径|Durchmesser",
    re.IGNORECASE,
)
_SAME_RATIO = 0.01  # of a unit that was taken for another: those differ tenfold at least
_SAME_LENGTH_RATIO = 0.02  # cut, bent and rounded lengths differ by less
_SAME_AREA_RATIO = 0.04
"""Tables round the areas of bars to two or three digits."""

_SAME_DIAMETER_MM = 0.1  # sizes are whole millimetres, or tenths in catalogues
_SHOWN_KINDS = 8  # kinds of contradictions: more fill a screen and say no more
_SHOWN_ELEMENTS = 12  # of a kind: a ring of twelve


@dataclass(frozen=True, eq=False)
class Contradictions:
    """Attributes that contradict the geometry, each with the elements that have it."""

    opened: OpenedIfc
    _found: dict[str, list[Any]] = field(default_factory=dict, repr=False)

    def compare_bar(
        self, element: Any, drawn_mm: float, lengths_mm: Sequence[float]
    ) -> tuple[float, float | None, tuple[str, ...]]:
        """Nominal diameter of a bar and, where the model gives it, the one over its ribs, mm; and what was noted.

        The drawn diameter is believed, not the attribute; only where what is drawn is the diameter over the ribs of
        the very size that the attribute names, that size is nominal. A BarLength may be that of one of the
        element's bars or of all together.
        """
        nominal_mm, over_ribs_mm, notes = self._diameter(element, drawn_mm)
        notes += self._area(element, nominal_mm)
        notes += self._length(element, "BarLength", lengths_mm)
        for note in notes:
            self._note(note, element)
        return nominal_mm, over_ribs_mm, tuple(notes)

    def compare_sleeve(self, element: Any, diameters_mm: Sequence[float], length_mm: float) -> None:
        """Note sizes of a fastener that were written in another unit than the file's.

        Its NominalDiameter may be that of its outside, of its bore, or of the bar that goes in: anything less is
        no contradiction.
        """
        notes = self._length(element, "NominalLength", [length_mm])
        written = self.opened.naming.attribute(element, "NominalDiameter")
        if written and not any(abs(written * self.opened.mm - d) < _SAME_DIAMETER_MM for d in diameters_mm):
            slips = [(slip, drawn_mm) for drawn_mm in diameters_mm if (slip := self._slip(written, drawn_mm))]
            if slips:
                written_mm = written * self.opened.mm
                slip, drawn_mm = slips[0]
                notes += [_believed("NominalDiameter", f"{written_mm:.4g}", slip, f"{drawn_mm:g}")]
        for note in notes:
            self._note(note, element)

    def lines(self) -> list[str]:
        """One line for each contradiction, the most frequent first, with the elements that have it."""
        ranked = sorted(self._found.items(), key=lambda item: -len(item[1]))
        lines: list[str] = [
            Reason("said.of", what=_listed(elements), why=note) for note, elements in ranked[:_SHOWN_KINDS]
        ]
        rest = sum(len(elements) for _, elements in ranked[_SHOWN_KINDS:])
        return [*lines, Reason("ifc.more_attributes", count=rest)] if rest else lines

    def _note(self, note: str, element: Any) -> None:
        elements = self._found.setdefault(note, [])
        if not elements or elements[-1].id() != element.id():
            elements.append(element)

    def _diameter(self, element: Any, drawn_mm: float) -> tuple[float, float | None, list[str]]:
        written = self.opened.naming.attribute(element, "NominalDiameter")
        if written is None or abs(written * self.opened.mm - drawn_mm) < _SAME_DIAMETER_MM:
            return drawn_mm, None, []
        written_mm = round(written * self.opened.mm, 6)
        if nominal_of_over_ribs(drawn_mm) == round(written_mm, 3):
            note = Reason("ifc.drawn_over_ribs", drawn_mm=drawn_mm, written_mm=written_mm)
            return written_mm, drawn_mm, [note]
        over_ribs = nominal_of_over_ribs(written_mm) == round(drawn_mm, 3)
        slip = "over the ribs" if over_ribs else self._slip(written, drawn_mm)
        note = _believed("NominalDiameter", f"{written_mm:g}", slip, f"{drawn_mm:g}")
        return drawn_mm, written_mm if over_ribs else None, [note]

    def _length(self, element: Any, name: str, lengths_mm: Sequence[float]) -> list[str]:
        written = self.opened.naming.attribute(element, name)
        if written is None or not lengths_mm:
            return []
        written_mm = written * self.opened.mm
        whole_mm = [*lengths_mm, sum(lengths_mm)]
        if any(abs(written_mm - drawn) < max(_SAME_LENGTH_RATIO * drawn, 1.0) for drawn in whole_mm):
            return []
        slip = next((slip for drawn in whole_mm if (slip := self._slip(written, drawn))), "")
        return [_believed(name, f"{written_mm:.4g}", slip, f"{lengths_mm[0]:.1f}")]

    def _area(self, element: Any, diameter_mm: float) -> list[str]:
        written, unit_mm2 = self.opened.naming.attribute(element, "CrossSectionArea"), self.opened.mm2
        if written is None or unit_mm2 is None:
            return []
        drawn_mm2 = math.pi * diameter_mm**2 / 4.0
        if _near(written * unit_mm2, drawn_mm2, _SAME_AREA_RATIO):
            return []
        units = (name for name, unit in _AREAS_MM2.items() if _near(written * unit, drawn_mm2, _SAME_AREA_RATIO))
        sizes = {"written_mm2": written * unit_mm2, "diameter_mm": diameter_mm, "drawn_mm2": drawn_mm2}
        unit = next(units, "")
        return [Reason("ifc.area_slip" if unit else "ifc.area", unit=unit, **sizes)]

    def _slip(self, written: float, drawn_mm: float) -> str:
        """The unit in which an attribute must have been written to mean what is drawn, in words."""
        for name, unit_mm in _LENGTHS_MM.items():
            if unit_mm != self.opened.mm and _near(written * unit_mm, drawn_mm, _SAME_RATIO):
                return Reason("ifc.it_is_in", unit=name)
            if unit_mm > 1.0 and _near(written * self.opened.mm * unit_mm, drawn_mm, _SAME_RATIO):
                return Reason("ifc.it_is_in", unit=name)
        return ""


def written_diameter_mm(opened: OpenedIfc, element: Any) -> float | None:
    """Diameter that a bar's attributes give, or its type's, or a property; None where nothing does."""
    written = opened.naming.attribute(element, "NominalDiameter")
    if written is None:
        named = (
            v for name, v in properties(element) if _DIAMETER.fullmatch(name.strip()) and isinstance(v, int | float)
        )
        written = next((value for value in named if value > 0), None)
    if written is not None:
        return round(float(written) * opened.mm, 6)
    area = opened.naming.attribute(element, "CrossSectionArea")
    if area is None or opened.mm2 is None:
        return None
    return round(math.sqrt(4.0 * float(area) * opened.mm2 / math.pi), 3)


def _near(value: float, other: float, within_ratio: float) -> bool:
    return abs(value - other) <= within_ratio * abs(other)


def _believed(name: str, written_mm: str, slip: str, drawn_mm: str) -> Reason:
    """That an attribute and the drawing differ; ``slip`` is how it was meant, where that is known."""
    code = "ifc.believed_slip" if slip else "ifc.believed"
    return Reason(code, name=name, written_mm=written_mm, slip=slip, drawn_mm=drawn_mm)


def _listed(elements: Sequence[Any]) -> str:
    first = elements[0]
    if len(elements) == 1:
        called = f' "{name}"' if (name := text_of(first.Name)) else ""
        return f"{first.is_a()} {first.GlobalId}{called}"
    shown = listed([element.GlobalId for element in elements], _SHOWN_ELEMENTS)
    return Reason("ifc.several", count=len(elements), type=first.is_a(), shown=shown)
