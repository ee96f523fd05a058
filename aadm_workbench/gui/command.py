"""What all commands share: texts, when they can run, and that whatever goes wrong becomes a sentence."""

from __future__ import annotations

from typing import Any

import FreeCAD

from aadm_workbench.gui.resources import icon_path
from aadm_workbench.gui.sentences import sentences

translate = FreeCAD.Qt.translate


class Command:
    """A command of FreeCAD; ``TEXT`` and ``TOOLTIP`` are translated in the context ``NAME``."""

    NAME = ""
    ICON = "aadm"
    TEXT = ""
    TOOLTIP = ""
    SHORTCUT = ""

    def GetResources(self) -> dict[str, Any]:
        """Icon and texts of the menu entry, in the context that FreeCAD translates them in."""
        found = {
            "Pixmap": icon_path(self.ICON),
            "MenuText": self.TEXT,
            "ToolTip": self.TOOLTIP,
            "WhatsThis": self.NAME,
            # Available while a panel is open, too: ours give way to each other. Each opens its own transaction.
            "CmdType": "ForEdit,NoTransaction",
        }
        return found | ({"Accel": self.SHORTCUT} if self.SHORTCUT else {})

    def IsActive(self) -> bool:
        """Whether there is something to work on; asked often, so it must be quick."""
        return True

    def Activated(self) -> None:
        """Run it."""
        with sentences(translate(self.NAME, self.TEXT)):
            self.run()

    def run(self) -> None:
        """What the command does."""
        raise NotImplementedError


def has_document() -> bool:
    """Whether a document is open."""
    return FreeCAD.ActiveDocument is not None
