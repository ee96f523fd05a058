"""GuiDocument.xml, the half of a .FCStd file that says how objects are shown; FreeCAD without a screen leaves it out.

Without it everything opens hidden, and the colours that the model's author has given it are gone. So the model's own
half is carried over, and our objects are added to it, visible and with their view providers.
"""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path
from typing import Any

_NAME = "GuiDocument.xml"
VIEWS = {
    "AADM::Column": ("aadm_workbench.gui.column_view", "ColumnView"),
    "AADM::Scan": ("aadm_workbench.gui.scan_view", "ScanView"),
    "AADM::Result": ("aadm_workbench.gui.result_view", "ResultView"),
}
"""View provider of each of our objects, by the type of its proxy: module and class, as files name them."""


def complete(file: Path, model: Path | None, document: Any) -> None:
    """Give a .FCStd file that was saved without a screen what shows it; one that has it stays as it is.

    Parameters
    ----------
    file
        What was saved.
    model
        The file that the document was opened from; what that says of its own objects is kept.
    document
        The document that was saved.

    Raises
    ------
    OSError
        Where the file cannot be written.
    """
    with zipfile.ZipFile(file) as saved:
        names = set(saved.namelist())
        if _NAME in names:
            return
    root, carried = _of_model(model)
    providers = root.find("ViewProviderData")
    assert providers is not None
    known = {entry.get("name") for entry in providers}
    for obj in document.Objects:
        if obj.Name not in known:
            providers.append(_provider(obj))
    providers.set("Count", str(len(providers)))
    with zipfile.ZipFile(file, "a", zipfile.ZIP_DEFLATED) as saved:
        # FreeCAD reads the files of the half in the order in which the text names them.
        saved.writestr(_NAME, ElementTree.tostring(root, encoding="utf-8", xml_declaration=True))
        for name, content in carried.items():
            if name not in names:
                saved.writestr(name, content)


def _of_model(model: Path | None) -> tuple[ElementTree.Element, dict[str, bytes]]:
    """The text of the model's half and the files that it names, in their order; an empty half without a model."""
    if model is not None and zipfile.is_zipfile(model):
        with zipfile.ZipFile(model) as opened:
            if _NAME in opened.namelist():
                root = ElementTree.fromstring(opened.read(_NAME))
                named = [entry.get("file") for entry in root.iter() if entry.get("file")]
                present = set(opened.namelist())
                carried = {name: opened.read(name) for name in named if name is not None and name in present}
                if root.find("ViewProviderData") is not None:
                    return root, carried
    root = ElementTree.Element("Document", {"SchemaVersion": "1"})
    ElementTree.SubElement(root, "ViewProviderData", {"Count": "0"})
    ElementTree.SubElement(root, "Camera", {"settings": ""})
    return root, {}


def _provider(obj: Any) -> ElementTree.Element:
    entry = ElementTree.Element("ViewProvider", {"name": obj.Name, "expanded": "0"})
    view = VIEWS.get(getattr(getattr(obj, "Proxy", None), "Type", ""))
    properties = ElementTree.SubElement(entry, "Properties", {"Count": "2" if view else "1", "TransientCount": "0"})
    if view is not None:
        proxy = ElementTree.SubElement(properties, "Property", {"name": "Proxy", "type": "App::PropertyPythonObject"})
        # The text of a proxy without state: null, in Base64.
        state = {"value": "bnVsbA==", "encoded": "yes", "module": view[0], "class": view[1]}
        ElementTree.SubElement(proxy, "Python", state)
    visible = ElementTree.SubElement(properties, "Property", {"name": "Visibility", "type": "App::PropertyBool"})
    ElementTree.SubElement(visible, "Bool", {"value": "true"})
    return entry
