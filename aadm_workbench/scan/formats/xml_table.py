"""XML files of intrinsics as nested tables, the form in which JSON and TOML files already come."""

from __future__ import annotations

import re
from xml.etree import ElementTree

from aadm_workbench.errors import CameraError
from aadm_workbench.model import Json, Reason

_DECLARATION = re.compile("<!(?:DOCTYPE|ENTITY)", re.IGNORECASE)
_DEEPEST_XML = 50  # the files of OpenCV nest three deep


def parse_xml(text: str) -> dict[str, Json]:
    """Return the elements of an XML text by their tags: tables, lists of numbers, numbers or words.

    Raises
    ------
    CameraError
        For text that is no XML, declares entities, or is nested deeper than any file of intrinsics.
    """
    if _DECLARATION.search(text):
        raise CameraError(Reason("scan.xml_doctype"))
    try:
        root = ElementTree.fromstring(text.strip())
    except (ElementTree.ParseError, ValueError) as error:
        raise CameraError(Reason("scan.no_xml", why=error)) from error
    return {root.tag: _value(root, _DEEPEST_XML)}


def _value(element: ElementTree.Element, deepest: int) -> Json:
    if deepest == 0:
        raise CameraError(Reason("scan.xml_deep", most=_DEEPEST_XML))
    table: dict[str, Json] = {name: _plain(text) for name, text in element.attrib.items()}
    for child in element:
        value = _value(child, deepest - 1)
        # Rows of a matrix may share a tag.
        table[child.tag] = [table[child.tag], value] if child.tag in table else value
    text = element.text or ""
    if not table:
        return _plain(text)
    if text.strip():
        table["data"] = _plain(text)
    return table


def _plain(text: str) -> Json:
    """Return a whole number, a number, a list of numbers, or the text itself."""
    words = re.split(r"[\s,;]+", text.strip(" \t\r\n[](),;"))
    try:
        numbers: list[Json] = [int(word) if re.fullmatch("[-+]?[0-9]{1,15}", word) else float(word) for word in words]
    except ValueError:
        return text.strip()
    return numbers[0] if len(numbers) == 1 else numbers
