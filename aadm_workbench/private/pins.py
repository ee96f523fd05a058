"""What the private environment holds: the pins that ship with the addon, and where environments lie."""

from __future__ import annotations

import hashlib
import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
"""The addon's folder, that of package.xml."""

_PINS = ROOT / "requirements" / "freecad.txt"
_NAMED = "AADM_ENVIRONMENTS"
"""Variable that names another folder for environments."""

_HASH_LENGTH = 10  # of the pins; a collision of two versions of this product is out of question


def pins_file() -> Path:
    """The closure that is installed, each package with its version."""
    return _PINS


def pip_wheel() -> Path:
    """The pip that installs it, since FreeCAD's Python may have none.

    Raises
    ------
    FileNotFoundError
        Where the addon's folder is not whole.
    """
    found = sorted(_PINS.parent.glob("pip-*.whl"))
    if not found:
        raise FileNotFoundError(f"{_PINS.parent}: holds no pip-*.whl; install the addon again")
    return found[-1]


def pinned(pins: Path) -> dict[str, str]:
    """Version of each package that a file of pins names."""
    lines = pins.read_text(encoding="utf-8").splitlines()
    found = [re.match(r"([A-Za-z0-9._-]+)==(\S+)", line) for line in lines]
    return {one[1]: one[2] for one in found if one}


def markers(pins: Path) -> dict[str, str]:
    """For which systems each package of a file of pins is meant, as pip reads it; empty for all."""
    lines = pins.read_text(encoding="utf-8").splitlines()
    found = [re.match(r"([A-Za-z0-9._-]+)==\S+\s*(?:;\s*(.*))?$", line) for line in lines]
    return {one[1]: (one[2] or "").strip() for one in found if one}


def environments_folder() -> Path:
    """The folder of all environments of this user: FreeCADs of several versions and the command share them."""
    named = os.environ.get(_NAMED)
    if named:
        return Path(named)
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or home / "AppData" / "Local") / "AADM" / "environments"
    if sys.platform == "darwin":
        return home / "Library" / "Application Support" / "AADM" / "environments"
    return Path(os.environ.get("XDG_DATA_HOME") or home / ".local" / "share") / "aadm" / "environments"


def environment_name(version: tuple[int, int], pins: Path) -> str:
    """Name of the folder for a Python and pins: other pins are another folder, nothing is changed under a check."""
    content = pins.read_bytes().replace(b"\r\n", b"\n")
    return f"py{version[0]}{version[1]}-{hashlib.sha256(content).hexdigest()[:_HASH_LENGTH]}"
