"""Whether what a panel says can be read: measured on its pixels and on its layout. Runs inside FreeCAD.

``faults_in(form)`` gives sentences about what is cut, covers something else, sticks out, or hardly stands out.
"""

from itertools import combinations

import numpy as np
from PySide import QtCore, QtGui

LEAST_CONTRAST = 3.0
"""WCAG 2.2, 1.4.11 and, for large text, 1.4.3: below it people with poor eyesight lose it. Strokes of small text are
thinner than a pixel and reach less than their colour would, so that 4.5 would turn away black on white."""
_LEAST_INK = 4  # pixels: a dot is no text
_SPARE_PX = 2  # styles round

NO_TEXT = (QtGui.QProgressBar, QtGui.QAbstractSpinBox, QtGui.QLineEdit, QtGui.QPlainTextEdit, QtGui.QAbstractScrollArea)
LEAVES = (QtGui.QLabel, QtGui.QAbstractButton, QtGui.QComboBox, *NO_TEXT)


def luminance(colours):
    """Relative luminance (n,) of sRGB colours (n, 3) 0..255, WCAG 2.2."""
    value = np.asarray(colours, dtype=np.float64) / 255.0
    linear = np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
    return linear @ np.array([0.2126, 0.7152, 0.0722])


class Screen:
    """What the screen shows now: colours (h, w, 3) 0..255, and how many of its pixels one of Qt's is."""

    def __init__(self):
        picture, buffer = QtGui.QApplication.primaryScreen().grabWindow(0).toImage(), QtCore.QBuffer()
        buffer.open(QtCore.QIODevice.WriteOnly)
        picture.save(buffer, "PPM")
        _, size, _, pixels = bytes(buffer.data()).split(b"\n", 3)  # three lines of words, then a byte for each colour
        width, height = map(int, size.split())
        self.colours = np.frombuffer(pixels, dtype=np.uint8).reshape(height, width, 3)
        self.ratio = picture.devicePixelRatio()  # a screen of 100 dots an inch has 1.04

    def part(self, rect):
        """Colours (n, 3) of a part in Qt's frame of the screen."""
        edges = ((rect.top(), rect.bottom() + 1), (rect.left(), rect.right() + 1))
        return self.colours[tuple(slice(*(max(0, round(edge * self.ratio)) for edge in two)) for two in edges)].reshape(
            -1, 3
        )


def on_screen(widget, rect=None):
    """A part of a widget, or all of it, in the frame of the screen."""
    return (rect or widget.rect()).translated(widget.mapToGlobal(QtCore.QPoint(0, 0)))


def seen_rect(widget):
    """The part of a widget that no area around it has scrolled away, in the frame of the screen."""
    rect, around = on_screen(widget), widget.parentWidget()
    while around is not None:
        rect &= on_screen(around)
        around = None if around.isWindow() else around.parentWidget()
    return rect


def contrast_in(picture, rect):
    """The strongest contrast with the background that a few pixels of a part have; the background is most of it."""
    pixels = picture.part(rect)
    if not len(pixels):
        return 1.0
    _, places, counts = np.unique(
        pixels @ np.array([65536, 256, 1]), return_index=True, return_counts=True
    )  # a colour as one number
    behind = luminance(pixels[places[np.argmax(counts)]][None])[0]
    shades = np.repeat(luminance(pixels[places]), counts)
    contrasts = (np.maximum(shades, behind) + 0.05) / (np.minimum(shades, behind) + 0.05)
    return float(np.sort(contrasts)[-min(_LEAST_INK, len(contrasts))])


def text_rect(widget):
    """Where a widget writes, in its own frame; None where it writes nothing."""
    style = widget.style()
    if isinstance(widget, QtGui.QComboBox):
        option = QtGui.QStyleOptionComboBox()
        widget.initStyleOption(option)
        return style.subControlRect(QtGui.QStyle.CC_ComboBox, option, QtGui.QStyle.SC_ComboBoxEditField, widget)
    if isinstance(widget, QtGui.QCheckBox):
        option = QtGui.QStyleOptionButton()
        widget.initStyleOption(option)
        return style.subElementRect(QtGui.QStyle.SE_CheckBoxContents, option, widget)
    return widget.contentsRect()


def is_inside(widget):
    """A part of another widget that is looked at as a whole, such as the line of a combo box."""
    parent = widget.parentWidget()
    while parent is not None:
        if isinstance(parent, (QtGui.QComboBox, QtGui.QAbstractSpinBox, QtGui.QAbstractScrollArea)):
            return True
        if isinstance(parent, QtGui.QWidget) and parent.objectName() == "qt_scrollarea_viewport":
            return False
        parent = parent.parentWidget()
    return False


def called(widget):
    said = widget.currentText() if isinstance(widget, QtGui.QComboBox) else getattr(widget, "text", str)()
    return f"{type(widget).__name__} {said[:40]!r}"


def is_cut(widget):
    """Whether a widget has less room than its text takes."""
    if isinstance(widget, QtGui.QLabel):
        if widget.wordWrap():
            return widget.heightForWidth(widget.width()) > widget.height() + _SPARE_PX
        return widget.sizeHint().width() > widget.width() + _SPARE_PX
    if isinstance(widget, QtGui.QComboBox):
        needed = widget.fontMetrics().horizontalAdvance(widget.currentText())
        return needed > text_rect(widget).width() + _SPARE_PX
    if isinstance(widget, QtGui.QAbstractButton):
        return bool(widget.text()) and widget.sizeHint().width() > widget.width() + _SPARE_PX
    return False


def writes(widget):
    if isinstance(widget, QtGui.QComboBox):
        return bool(widget.currentText())
    return isinstance(widget, (QtGui.QLabel, QtGui.QAbstractButton)) and bool(widget.text())


def faults_of_table(table, picture):
    """Cells and headings that are cut or hardly stand out, in what is seen without scrolling."""
    found = []
    metrics, header = table.fontMetrics(), table.horizontalHeader()
    shown = table.viewport().rect()
    for column in range(table.columnCount()):
        place = header.sectionViewportPosition(column)
        if place >= shown.width():
            continue
        heading = table.horizontalHeaderItem(column)
        if heading is not None and header.fontMetrics().horizontalAdvance(heading.text()) > table.columnWidth(column):
            found.append(f"heading {heading.text()!r} is cut")
    for row in range(table.rowCount()):
        for column in range(table.columnCount()):
            item = table.item(row, column)
            rect = table.visualItemRect(item) if item is not None else QtCore.QRect()
            if item is None or not item.text() or not shown.contains(rect):
                continue
            if metrics.horizontalAdvance(item.text()) > rect.width() + _SPARE_PX and not item.toolTip():
                found.append(f"cell {item.text()!r} is cut, and no tooltip has it")
            seen = on_screen(table.viewport(), rect) & seen_rect(table.viewport())
            if 2 * seen.height() <= rect.height():
                continue
            contrast = contrast_in(picture, seen)
            if contrast < LEAST_CONTRAST:
                found.append(f"cell {item.text()!r} hardly stands out: {contrast:.2f}")
    return found


def places_in(form):
    """Where everything in a panel stands now."""
    return [on_screen(one).getRect() for one in form.findChildren(QtGui.QWidget) if one.isVisible()]


def faults_in(form):
    """What cannot be read in a panel or a window, in sentences; nothing where all can."""
    area, found = form.parentWidget(), []
    while area is not None and not isinstance(area, QtGui.QScrollArea):
        area = area.parentWidget()
    if area is not None and not form.isWindow() and form.width() > area.viewport().width() + _SPARE_PX:
        found.append(f"the panel is {form.width()} px wide, {area.viewport().width()} are seen")
    picture = Screen()
    leaves = [one for one in form.findChildren(QtGui.QWidget) if isinstance(one, LEAVES) and one.isVisible()]
    leaves = [one for one in leaves if not is_inside(one) and one.width() > 0]
    rects = {one: seen_rect(one) for one in leaves}
    # What is scrolled away, or half of it, is not to be read now.
    leaves = [one for one in leaves if 2 * rects[one].height() > one.height() and 2 * rects[one].width() > one.width()]
    for one in leaves:
        if is_cut(one):
            found.append(f"{called(one)} is cut")
        if writes(one) and one.isEnabled():
            contrast = contrast_in(picture, on_screen(one, text_rect(one)) & rects[one])
            if contrast < LEAST_CONTRAST:
                found.append(f"{called(one)} hardly stands out: {contrast:.2f}")
        if isinstance(one, QtGui.QTableWidget):
            found += faults_of_table(one, picture)
    for one, other in combinations(leaves, 2):
        both = rects[one].intersected(rects[other])
        if both.width() > _SPARE_PX and both.height() > _SPARE_PX and not one.isAncestorOf(other):
            found.append(f"{called(one)} covers {called(other)}")
    return found


def faults_of_icons(bar):
    """Buttons of a toolbar whose picture is missing or hardly stands out from the bar."""
    picture, found = Screen(), []
    for button in bar.findChildren(QtGui.QToolButton):
        if button.isVisible() and button.defaultAction() is not None and button.isEnabled():
            name = button.defaultAction().objectName() or button.defaultAction().text()
            contrast = contrast_in(picture, on_screen(button, button.rect().adjusted(2, 2, -2, -2)))
            if button.icon().isNull() or contrast < LEAST_CONTRAST:
                found.append(f"the icon of {name} hardly stands out: {contrast:.2f}")
    return found
