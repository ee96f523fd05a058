"""The addon in the real FreeCAD, as the Addon Manager would have installed it."""

import xml.etree.ElementTree as ElementTree
from pathlib import Path

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
        "result['runs_here'] = package.supportsCurrentFreeCAD() and workbench.supportsCurrentFreeCAD()\n"
        "result['urls'] = [[url['type'], url['location'], url.get('branch', '')] for url in package.Urls]\n"
        "result['people'] = [[one['name'], one['email']] for one in package.Maintainer]\n"
        # As the Addon Manager itself reads it.
        "import pathlib, sys\n"
        "homes = [FreeCAD.getHomePath(), '/usr/share/freecad']\n"
        "sys.path[:0] = [str(pathlib.Path(home, 'Mod', 'AddonManager')) for home in homes]\n"
        "from Addon import Addon\n"
        "addon = Addon('AADM', 'https://example.org/given/by/its/user', Addon.Status.NOT_INSTALLED, 'theirs')\n"
        f"addon.load_metadata_file({str(repository / 'package.xml')!r})\n"
        "result['addon'] = [addon.display_name, addon.url, addon.branch, str(addon.repo_type), sorted(addon.tags)]\n"
        "result['python'] = sorted({*addon.python_requires, *addon.python_optional, *addon.requires})\n"
    )
    assert result["name"] == "AADM"
    assert result["version"] == __version__
    assert result["license"] == "LGPL-2.1-or-later"
    assert result["folder"] == "./", "without it FreeCAD skips Init.py and InitGui.py"
    assert result["classname"] == "AADMWorkbench"
    assert result["minimum"].startswith("0.20")
    assert result["runs_here"]
    assert all(location.startswith("https://") for _, location, _ in result["urls"])
    assert all(branch for kind, _, branch in result["urls"] if kind == "repository")
    assert all(name and ("@" in email or not email) for name, email in result["people"])
    name, url, branch, kind, tags = result["addon"]
    assert name == "AADM"
    assert result["urls"] or (url, branch) == ("https://example.org/given/by/its/user", "theirs")
    assert kind.upper().endswith("PACKAGE")
    assert "precast" in tags
    assert result["python"] == [], "what the Addon Manager installs goes into FreeCAD's own interpreter"
    assert result["needs"] == [], "what the Addon Manager installs goes into FreeCAD's own interpreter"


def test_icons_named_in_package_xml_exist(repository: Path) -> None:
    icons = [element.text or "" for element in ElementTree.parse(repository / "package.xml").iter(f"{NAMESPACE}icon")]
    assert icons
    assert all((repository / icon).is_file() for icon in icons)
