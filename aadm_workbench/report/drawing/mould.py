"""Capability of each sleeve of a mould: Cpk along x and y as bars, against 1 and 1.33."""

from __future__ import annotations

from aadm_workbench.model import MouldDrift
from aadm_workbench.report.drawing.sketch import Label, Polyline, Shape, Sketch, rectangle

# the usual bounds of process capability (ISO 22514-2): not capable, capable; where bars end
_LOW_CPK, _GOOD_CPK, _END_CPK = 1.0, 1.33, 3.0
_ROW = 15.0  # a line of letters
_LEFT, _RIGHT = 40.0, 380.0  # room for a label on the left, and for a number on the right


def mould_sketch(mould: MouldDrift) -> Sketch:
    """One row a sleeve, two bars a row; a Cpk above 3 ends at the edge."""
    rows = [(sleeve.label, {item.axis: item.cpk for item in sleeve.capability}) for sleeve in mould.sleeves]
    height = _ROW * len(rows) + 24.0
    shapes: list[Shape] = []
    for value, style in ((_LOW_CPK, "fail"), (_GOOD_CPK, "pass")):
        x = _place(value)
        shapes += [
            Polyline(((x, 12.0), (x, height - 10.0)), "axis"),
            Label((x, 6.0), f"{value:g}", 8.0, "text-fail" if style == "fail" else "text-faint"),
        ]
    shapes.append(Label((_LEFT - 6.0, 6.0), "Cpk", 8.0, "text-faint", "end"))
    for k, (label, values) in enumerate(rows):
        top = height - 10.0 - _ROW * k
        shapes.append(Label((_LEFT - 6.0, top - _ROW / 2), label, 8.5, anchor="end", bold=True))
        for axis, low in (("x", top - 7.0), ("y", top - 13.0)):
            cpk = values.get(axis)
            if cpk is not None:
                style = "fill-fail" if cpk < _LOW_CPK else "fill-inconclusive" if cpk < _GOOD_CPK else "fill-pass"
                end = _place(min(max(cpk, 0.02), _END_CPK))
                shapes.append(rectangle((_LEFT, low), (end, low + 5.0), style))
                shapes.append(Label((end + 4.0, low + 2.5), f"{axis} {cpk:.2f}", 6.0, "text-faint", "start"))
    return Sketch(_RIGHT + 50.0, height, tuple(shapes))


def _place(cpk: float) -> float:
    return _LEFT + (_RIGHT - _LEFT) * cpk / _END_CPK
