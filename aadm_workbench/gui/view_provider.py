"""What the view providers of this workbench share: a scene that is built anew when what it shows has changed.

The nodes live on the proxy; what a file keeps is in properties.
"""

from __future__ import annotations

from typing import Any

import FreeCAD
from pivy import coin

from aadm_workbench.document.display.messages import complain
from aadm_workbench.document.properties import Property, apply_properties
from aadm_workbench.document.stateless import Stateless
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.resources import icon, icon_path

_MODE = "Marks"


class MarksView(Stateless):
    """A view provider that draws marks."""

    PROPERTIES: tuple[Property, ...] = ()
    REDRAWN_BY: frozenset[str] = frozenset()
    """Properties of the object that change what is drawn."""

    def __init__(self, vobj: Any) -> None:
        apply_properties(vobj, self.PROPERTIES)
        vobj.Proxy = self

    def attach(self, vobj: Any) -> None:
        """Set up the scene; FreeCAD then tells of every property, and with that it is drawn."""
        apply_properties(vobj, self.PROPERTIES)
        self.Object = vobj.Object
        self.root = coin.SoSeparator()
        vobj.addDisplayMode(self.root, _MODE)

    def redraw(self) -> None:
        """Draw what the object holds now; what cannot be drawn is said, and leaves the rest of the document alone."""
        if not hasattr(self, "root"):
            return
        self.root.removeAllChildren()
        try:
            self.draw(self.Object, self.Object.ViewObject, self.root)
        except (AadmError, KeyError, TypeError, ValueError) as error:
            label = self.Object.Label
            complain(
                FreeCAD.Qt.translate("AADM", "{label} cannot be drawn ({reason}); check its column again").format(
                    label=label, reason=error
                )
            )

    def draw(self, obj: Any, vobj: Any, root: Any) -> None:
        """Fill the scene."""

    def updateData(self, obj: Any, prop: str) -> None:
        """The object has changed."""
        if prop in self.REDRAWN_BY:
            self.redraw()

    def onChanged(self, vobj: Any, prop: str) -> None:
        """A setting of the view has changed."""
        if any(prop == one.name for one in self.PROPERTIES):
            self.redraw()

    def getDisplayModes(self, vobj: Any) -> list[str]:
        """There is one."""
        return [_MODE]

    def getDefaultDisplayMode(self) -> str:
        """There is one."""
        return _MODE

    def setDisplayMode(self, mode: str) -> str:
        """Whatever a file asks for, there is one."""
        return _MODE

    def icon_name(self, obj: Any) -> str:
        """Name of the object's icon."""
        return "aadm"

    def getIcon(self) -> str:
        """Path of the icon in the tree."""
        name = self.icon_name(self.Object) if hasattr(self, "Object") else "aadm"
        icon(name)  # FreeCAD 1.1 shows in the tree what it has drawn before; Qt alone may not draw SVG
        return icon_path(name)
