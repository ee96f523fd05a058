"""The picture of the hoisting window: traffic light, arrows, numbers, drawn as large as the window lets them be."""

from __future__ import annotations

import math
from typing import Any

import FreeCAD
from PySide import QtCore, QtGui

from aadm_workbench.document.display.colours import of_verdict
from aadm_workbench.document.hoisting_state import Guidance
from aadm_workbench.gui.language import in_language

translate = FreeCAD.Qt.translate

_BACK = QtGui.QColor(18, 22, 26)  # dark: read at night, and in the sun
_FRONT = QtGui.QColor(245, 245, 245)  # 17 : 1 on it
_DIM = QtGui.QColor(70, 76, 82)  # seen to be there, and to be off
_LAMPS = (("push", "fail", "✕"), ("hold", "inconclusive", "?"), ("go", "pass", "✓"))
_BIG = QtCore.Qt.AlignCenter


class HoistingPicture(QtGui.QWidget):
    """Light letters on dark: it is read under the open sky and in the dark of a hall."""

    def __init__(self) -> None:
        super().__init__()
        self.setMinimumSize(480, 320)
        self._guidance: Guidance | None = None
        self._text = ""
        self._caption = ""

    def show_text(self, text: str) -> None:
        """Show a sentence instead of a measurement."""
        self._guidance, self._text, self._caption = None, text, ""
        self.update()

    def show_guidance(self, guidance: Guidance, caption: str) -> None:
        """Show what to do; nothing is green but what may be lowered."""
        self._guidance, self._caption = guidance, caption
        self.update()

    def paintEvent(self, event: Any) -> None:
        """Draw it."""
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.Antialiasing)
        painter.fillRect(self.rect(), _BACK)
        width, height = float(self.width()), float(self.height())
        if self._guidance is None:
            _write(painter, QtCore.QRectF(0, 0, width, height), self._text, height / 16, _FRONT)
            return
        lamp_width = min(height / 3.2, width / 5)
        self._draw_lamps(painter, QtCore.QRectF(0, 0, lamp_width, height * 0.9))
        middle = QtCore.QRectF(lamp_width, 0, (width - lamp_width) * 0.62, height * 0.9)
        right = QtCore.QRectF(middle.right(), 0, width - middle.right(), height * 0.9)
        self._draw_push(painter, middle)
        self._draw_turn(painter, right)
        foot = QtCore.QRectF(0, height * 0.9, width, height * 0.1)
        _write(painter, foot, self._caption, height / 26, _FRONT if self._light() == "go" else _colour("hold"))

    def _light(self) -> str:
        guidance: Any = self._guidance
        return str(guidance.light)

    def _draw_lamps(self, painter: Any, place: Any) -> None:
        size = min(place.width() * 0.8, place.height() / 3.3)
        for number, (name, verdict, sign) in enumerate(_LAMPS):
            is_on = name == self._light()
            box = QtCore.QRectF(0, 0, size, size)
            box.moveCenter(QtCore.QPointF(place.center().x(), place.height() * (2 * number + 1) / 6))
            painter.setPen(QtCore.Qt.NoPen)
            painter.setBrush(QtGui.QColor.fromRgbF(*of_verdict(verdict)) if is_on else QtGui.QColor(40, 45, 50))
            painter.drawEllipse(box)
            front = QtGui.QColor(255, 255, 255) if is_on else _DIM
            upper, lower = box.adjusted(0, 0, 0, -size * 0.3), box.adjusted(0, size * 0.58, 0, -size * 0.14)
            _write(painter, upper, sign, size * 0.46, front)
            _write(painter, lower, _word(name), size * 0.2, front)

    def _draw_push(self, painter: Any, place: Any) -> None:
        """An arrow as seen by the reader: ahead is up. Beside it the two parts, in mm."""
        guidance: Any = self._guidance
        upper = QtCore.QRectF(place.left(), place.top(), place.width(), place.height() * 0.66)
        lower = QtCore.QRectF(place.left(), upper.bottom(), place.width(), place.height() * 0.34)
        if guidance.right_mm is None or guidance.ahead_mm is None:
            _write(
                painter,
                place,
                in_language(guidance.reason) or translate("AADM_Hoisting", "not measured"),
                place.height() / 14,
                _FRONT,
            )
            return
        if guidance.is_still:
            _write(painter, upper, "●", upper.height() * 0.4, _colour(guidance.light))
            _write(painter, lower, translate("AADM_Hoisting", "hold here"), lower.height() * 0.4, _FRONT)
            return
        reach = 0.42 * min(upper.width(), upper.height()) * guidance.arrow_share
        _draw_arrow(painter, upper.center(), (guidance.right_mm, -guidance.ahead_mm), reach)
        sideways, along = ("→" if guidance.right_mm >= 0 else "←"), ("↑" if guidance.ahead_mm >= 0 else "↓")
        left_half = QtCore.QRectF(lower.left(), lower.top(), lower.width() / 2, lower.height())
        right_half = QtCore.QRectF(lower.center().x(), lower.top(), lower.width() / 2, lower.height())
        size = min(lower.height() * 0.5, lower.width() / 12)
        _write(painter, left_half, f"{sideways} {abs(guidance.right_mm):.1f} mm", size, _FRONT)
        _write(painter, right_half, f"{along} {abs(guidance.ahead_mm):.1f} mm", size, _FRONT)

    def _draw_turn(self, painter: Any, place: Any) -> None:
        guidance: Any = self._guidance
        third = place.height() / 3
        top = QtCore.QRectF(place.left(), place.top(), place.width(), third)
        middle = QtCore.QRectF(place.left(), place.top() + third, place.width(), third)
        bottom = QtCore.QRectF(place.left(), place.top() + 2 * third, place.width(), third)
        size = min(third * 0.34, place.width() / 7)
        turn = guidance.turn_deg
        if turn is not None and not guidance.is_still:
            _write(painter, top, "↺" if turn >= 0 else "↻", third * 0.8, _FRONT)
            _write(painter, middle, f"{abs(turn):.2f}°", size * 1.3, _FRONT)
        margin = guidance.margin_mm
        if margin is not None:
            said = translate("AADM_Hoisting", "margin")
            colour = _colour(guidance.margin_light).lighter(140)
            _write(painter, bottom, f"{said}\n{margin:+.1f} mm", size, colour)


def _word(light: str) -> str:
    """What a lamp says, for whom its colour and its sign tell nothing."""
    if light == "go":
        return str(translate("AADM_Hoisting", "LOWER"))
    return str(translate("AADM_Hoisting", "PUSH") if light == "push" else translate("AADM_Hoisting", "WAIT"))


def _colour(light: str) -> Any:
    verdict = next(verdict for name, verdict, _ in _LAMPS if name == light)
    return QtGui.QColor.fromRgbF(*of_verdict(verdict))


def _draw_arrow(painter: Any, centre: Any, direction: tuple[float, float], reach: float) -> None:
    angle = math.degrees(math.atan2(direction[1], direction[0]))
    painter.save()
    painter.translate(centre)
    painter.rotate(angle)
    width = reach * 0.34
    corners = [
        (-reach, -width / 2),
        (reach * 0.15, -width / 2),
        (reach * 0.15, -width * 1.25),
        (reach, 0.0),
        (reach * 0.15, width * 1.25),
        (reach * 0.15, width / 2),
        (-reach, width / 2),
    ]
    painter.setPen(QtCore.Qt.NoPen)
    painter.setBrush(QtGui.QColor(255, 205, 60))
    painter.drawPolygon(QtGui.QPolygonF([QtCore.QPointF(x, y) for x, y in corners]))
    painter.restore()


def _write(painter: Any, box: Any, text: str, size_px: float, colour: Any) -> None:
    flags = int(getattr(_BIG, "value", _BIG)) | _wrap()
    font = QtGui.QFont()
    font.setBold(True)
    for size in range(max(8, int(size_px)), 7, -1):  # a long sentence is smaller, and not cut off
        font.setPixelSize(size)
        painter.setFont(font)
        if painter.boundingRect(box, flags, text).height() <= box.height():
            break
    painter.setPen(colour)
    painter.drawText(box, flags, text)


def _wrap() -> int:
    flag = QtCore.Qt.TextWordWrap
    return int(getattr(flag, "value", flag))
