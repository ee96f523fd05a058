"""The addon in the real FreeCAD, as the Addon Manager would have installed it."""

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import cv2
import numpy as np
import pytest

from aadm_workbench import __version__

pytestmark = pytest.mark.freecad

NAMESPACE = "{https://wiki.freecad.org/Package_Metadata}"


def test_package_is_importable_without_a_screen(freecad, repository: Path) -> None:
    result = freecad.run(
        "import sys, aadm_workbench, aadm_workbench.errors\n"
        "result['version'] = aadm_workbench.__version__\n"
        "result['file'] = aadm_workbench.__file__\n"
        "result['heavy'] = sorted({'cv2', 'ifcopenshell', 'numpy', 'open3d', 'scipy'} & set(sys.modules))\n"
    )
    assert result["version"] == __version__
    assert Path(result["file"]).resolve() == repository / "aadm_workbench" / "__init__.py"
    assert result["heavy"] == [], "Init.py must not slow down everybody's start"
    assert "Traceback" not in result["printed"]
    assert "During initialization the error" not in result["printed"]


def test_freecad_reads_package_xml(freecad, repository: Path) -> None:
    result = freecad.run(
        "import FreeCAD\n"
        f"package = FreeCAD.Metadata({str(repository / 'package.xml')!r})\n"
        "workbench, = package.Content['workbench']\n"
        "result.update(name=package.Name, version=package.Version, license=package.License[0]['name'])\n"
        "result.update(folder=workbench.Subdirectory, classname=workbench.Classname, minimum=workbench.FreeCADMin)\n"
        "result['needs'] = sorted(need['package'] for need in workbench.Depend)\n"
    )
    assert result["name"] == "AADM"
    assert result["version"] == __version__
    assert result["license"] == "LGPL-2.1-or-later"
    assert result["folder"] == "./", "without it FreeCAD skips Init.py and InitGui.py"
    assert result["classname"] == "AADMWorkbench"
    assert result["minimum"].startswith("0.20")
    assert result["needs"] == ["numpy", "scipy"]


def test_icons_named_in_package_xml_exist(repository: Path) -> None:
    icons = [element.text or "" for element in ElementTree.parse(repository / "package.xml").iter(f"{NAMESPACE}icon")]
    assert icons
    assert all((repository / icon).is_file() for icon in icons)


def test_workbench_opens_in_a_window(freecad_window) -> None:
    result = freecad_window.run(
        "import sys, FreeCAD, FreeCADGui as Gui\n"
        "result['listed'] = 'AADMWorkbench' in Gui.listWorkbenches()\n"
        "result['loaded_early'] = 'aadm_workbench.gui.about' in sys.modules\n"
        "Gui.activateWorkbench('AADMWorkbench')\n"
        "active = Gui.activeWorkbench()\n"
        "result.update(name=active.MenuText, tooltip=active.ToolTip)\n"
        "result['commands'] = [name for name in Gui.listCommands() if name.startswith('AADM_')]\n"
        "from PySide import QtGui\n"
        "window = Gui.getMainWindow()\n"
        "result['toolbars'] = [bar.windowTitle() for bar in window.findChildren(QtGui.QToolBar) if bar.isVisible()]\n"
        "icon = Gui.getIcon(active.Icon)\n"
        "result['icon_is_drawn'] = icon is not None and not icon.pixmap(64, 64).isNull()\n"
        "Gui.runCommand('AADM_About')\n"
        "Gui.updateGui()\n"
        "about = window.findChild(QtGui.QMessageBox, 'AADM_About')\n"
        "result['about'] = about.text()\n"
        "about.grab().save(str(folder / 'about.png'))\n"
        "about.close()\n"
        "window.grab().save(str(folder / 'window.png'))\n"
    )
    assert result["listed"]
    assert not result["loaded_early"], "commands are loaded when the workbench is first opened"
    assert result["name"] == "AADM"
    assert "precast" in result["tooltip"]
    assert result["commands"] == ["AADM_About"]
    assert "AADM" in result["toolbars"]
    assert result["icon_is_drawn"]
    assert result["about"].startswith(f"AADM {__version__}\nFreeCAD ")
    assert "Traceback" not in result["printed"]
    for name in ("about.png", "window.png"):
        picture = cv2.imread(str(freecad_window.folder / name))
        assert picture is not None, f"{name} was not written"
        colours = picture.reshape(-1, 3)
        assert len(np.unique(colours, axis=0)) > 20, f"{name} shows nothing"
