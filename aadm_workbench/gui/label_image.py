"""A label as a picture: a text on a light plate with an edge in the colour of its verdict.

Qt draws it, with the user's fonts: Coin's own texts have no plate behind them, and no Chinese.
"""

from __future__ import annotations

from dataclasses import dataclass

from pivy import coin
from PySide import QtCore, QtGui

from aadm_workbench.document.display.colours import Rgb

_MARGIN_PX = 5  # a text does not touch the edge of its plate


@dataclass(frozen=True, eq=False)
class LabelImage:
    """The picture as Coin takes it, and its size in pixels."""

    node: coin.SoImage
    width: int
    height: int


def label_image(text: str, colour: Rgb, size_pt: int, *, bold: bool = False) -> LabelImage:
    """Draw a label."""
    font = QtGui.QFont()
    font.setPointSize(size_pt)
    font.setBold(bold)
    metrics = QtGui.QFontMetrics(font)
    width = metrics.boundingRect(text).width() + 2 * _MARGIN_PX + 8
    height = metrics.height() + _MARGIN_PX
    picture = QtGui.QImage(width, height, QtGui.QImage.Format_RGBA8888)
    picture.fill(QtCore.Qt.transparent)
    painter = QtGui.QPainter(picture)
    painter.setRenderHint(QtGui.QPainter.Antialiasing)
    painter.setRenderHint(QtGui.QPainter.TextAntialiasing)
    edge = QtGui.QColor.fromRgbF(*colour)
    painter.setPen(QtGui.QPen(edge, 2))
    painter.setBrush(QtGui.QColor(255, 255, 255, 235))
    painter.drawRoundedRect(QtCore.QRectF(1, 1, width - 2, height - 2), 3, 3)
    painter.fillRect(QtCore.QRectF(1, 1, 5, height - 2), edge)
    painter.setFont(font)
    painter.setPen(QtGui.QColor(20, 20, 20))
    painter.drawText(QtCore.QRectF(6, 0, width - 6, height), QtCore.Qt.AlignCenter, text)
    painter.end()
    # Coin's first row is the lowest.
    flipped = picture.mirrored(False, True)
    node = coin.SoImage()
    content = bytes(flipped.constBits())[: width * height * 4]
    node.image.setValue(coin.SbVec2s(width, height), 4, content)
    return LabelImage(node, width, height)
