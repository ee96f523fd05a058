"""Which Python is taken: on the folder layouts of FreeCAD's packages, and where it has moved since."""

import json
import os
import sys
from pathlib import Path

import pytest

from aadm_workbench import __version__
from aadm_workbench.private import pins
from aadm_workbench.private.environment import environment_folder, find_environment, left_over, remove_folder
from aadm_workbench.private.own_program import program_on_path
from aadm_workbench.private.pythons import Around, candidates, examined, find_python, plain_environment

VERSION = sys.version_info[:2]


def program(path: Path, text: str = "") -> Path:
    """A program that is this Python, or does what a shell says."""
    path.parent.mkdir(parents=True, exist_ok=True)
    text = text or f'exec {sys.executable} "$@"'
    path.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
    path.chmod(0o755)
    return path


LAYOUTS = {
    # sys.prefix, sys.executable, the Python: as the packages of FreeCAD lay them out.
    "debian": ("usr", "usr/lib/freecad/bin/freecad", "usr/bin/python3"),
    "appimage": ("mount/usr", "mount/usr/bin/freecad", "mount/usr/bin/python"),
    "conda": ("env", "env/bin/FreeCAD", "env/bin/python3.11"),
    "windows": ("FreeCAD 1.0/bin", "FreeCAD 1.0/bin/freecad.exe", "FreeCAD 1.0/bin/python.exe"),
    "windows, prefix above": ("FreeCAD 0.21", "FreeCAD 0.21/bin/FreeCAD.exe", "FreeCAD 0.21/bin/python.exe"),
    "macos": ("no", "FreeCAD.app/Contents/MacOS/FreeCAD", "FreeCAD.app/Contents/Resources/bin/python"),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_python_beside_freecad_goes_before_others(tmp_path: Path, layout: str) -> None:
    prefix, executable, python = (tmp_path / part for part in LAYOUTS[layout])
    program(executable)
    program(python)
    elsewhere = program(tmp_path / "elsewhere" / "python3")
    around = Around(prefix, executable, (3, 11))
    found = list(candidates("", around, str(elsewhere.parent)))
    assert found[0] == python
    assert elsewhere in found


def test_freecads_own_folders_on_the_path_are_left_out(tmp_path: Path) -> None:
    own = program(tmp_path / "freecad" / "bin" / "python3")
    addon = program(tmp_path / "home" / "Mod" / "Other" / "python3")
    system = program(tmp_path / "usr" / "bin" / "python3")
    around = Around(tmp_path / "no", tmp_path / "no" / "freecad", (3, 11), (tmp_path / "freecad", tmp_path / "home"))
    path = os.pathsep.join(map(str, (own.parent, addon.parent, "", system.parent)))
    assert list(candidates("", around, path)) == [system]


def test_only_the_one_that_was_named(tmp_path: Path) -> None:
    program(tmp_path / "usr" / "bin" / "python3")
    around = Around(tmp_path / "usr", tmp_path / "usr" / "bin" / "freecad", (3, 11))
    assert list(candidates("/opt/python", around, "")) == [Path("/opt/python")]


ANSWERS = {
    "an old one": ("echo '[3, 10, true, \"\"]'", "3.10"),
    "one that has no wheels yet": ("echo '[3, 99, true, \"\"]'", "3.99"),
    "32 bits": ("echo '[3, 12, false, \"\"]'", "32 bits"),
    "the stub of a store": ("echo 'Python was not found; run without arguments to install'; exit 9", "does not answer"),
    "FreeCAD itself": ("exit 0", "does not answer"),
    "words that are JSON": ("echo '{}'", "does not answer"),
}


@pytest.mark.parametrize("which", ANSWERS)
def test_one_that_will_not_do_is_passed_over_with_its_reason(tmp_path: Path, which: str) -> None:
    text, reason = ANSWERS[which]
    bad, good = program(tmp_path / "bad", text), program(tmp_path / "good")
    found, refused = find_python([tmp_path / "not there", bad, good])
    assert found is not None
    assert found.version == VERSION
    assert reason in refused[1].problem
    assert find_python([bad])[0] is None


def test_bundles_keep_their_libraries_for_themselves() -> None:
    given = {"APPDIR": "/tmp/.mount_x", "LD_LIBRARY_PATH": "/tmp/.mount_x/usr/lib", "PYTHONHOME": "/tmp/.mount_x/usr"}
    given |= {"SSL_CERT_FILE": "/etc/ssl/company.pem", "PIP_INDEX_URL": "https://mirror", "QT_PLUGIN_PATH": "/x"}
    kept = plain_environment(given)
    assert kept.keys() == {"APPDIR", "SSL_CERT_FILE", "PIP_INDEX_URL"}, "a company's own certificate stays"


@pytest.fixture
def made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An environment of this Python, made by one that lay in a bundle."""
    monkeypatch.setenv("AADM_ENVIRONMENTS", str(tmp_path / "environments"))
    folder = environment_folder((VERSION[0], VERSION[1]))
    (folder / "site").mkdir(parents=True)
    (folder / "in-use").touch()
    python = program(tmp_path / "mount-1" / "usr" / "bin" / "python")
    (folder / "made.json").write_text(json.dumps({"python": str(python), "version": VERSION}), encoding="utf-8")
    return folder


def test_bundle_that_is_mounted_elsewhere_finds_its_environment(tmp_path: Path, made: Path) -> None:
    first = Around(tmp_path / "mount-1" / "usr", tmp_path / "mount-1" / "usr" / "bin" / "freecad", VERSION)
    found = find_environment("", first, "")
    assert found is not None
    assert found.python == tmp_path / "mount-1" / "usr" / "bin" / "python"
    (tmp_path / "mount-1").rename(tmp_path / "mount-2")
    second = Around(tmp_path / "mount-2" / "usr", tmp_path / "mount-2" / "usr" / "bin" / "freecad", VERSION)
    moved = find_environment("", second, "")
    assert moved is not None
    assert moved.folder == made
    assert examined(moved.python).version == VERSION
    assert find_environment("", Around(tmp_path, tmp_path / "freecad", VERSION), "") is None


def test_environment_of_another_python_than_the_named_one_is_not_used(tmp_path: Path, made: Path) -> None:
    other = program(
        tmp_path / "other", "echo '[3, 12, true, \"\"]'" if VERSION != (3, 12) else "echo '[3, 13, true, \"\"]'"
    )
    around = Around(tmp_path / "mount-1" / "usr", tmp_path / "freecad", VERSION)
    assert find_environment(str(other), around, "") is None


@pytest.mark.parametrize("text", ["", "{", "[]", '{"version": [3, 11]}'])
def test_folder_without_its_note_is_none(tmp_path: Path, made: Path, text: str) -> None:
    (made / "made.json").write_text(text, encoding="utf-8")
    assert find_environment("", Around(tmp_path, tmp_path / "freecad", VERSION), "") is None


def test_environments_of_earlier_pins_are_left_over_until_they_are_removed(made: Path) -> None:
    earlier = made.with_name("py311-0000000000")
    earlier.mkdir()
    assert left_over() == [earlier]
    assert remove_folder(earlier)
    assert left_over() == []
    assert made.is_dir()


def test_folder_names_tell_pythons_and_pins_apart(tmp_path: Path) -> None:
    one, two = tmp_path / "one.txt", tmp_path / "two.txt"
    one.write_bytes(b"numpy==1.0\nscipy==1.0\n")
    two.write_bytes(b"numpy==1.0\nscipy==1.1\n")
    names = {pins.environment_name(version, file) for version in ((3, 11), (3, 12)) for file in (one, two)}
    assert len(names) == 4
    two.write_bytes(one.read_bytes().replace(b"\n", b"\r\n"))
    assert pins.environment_name((3, 11), one) == pins.environment_name((3, 11), two), "git on Windows changes newlines"


@pytest.mark.parametrize(("said", "is_used"), [(f"aadm {__version__}", True), ("aadm 0.0.1", False), ("AADM", False)])
def test_program_on_the_path_is_used_where_it_is_of_this_version(tmp_path: Path, said: str, is_used: bool) -> None:
    found = program(tmp_path / "bin" / "aadm", f"echo '{said}'")
    around = Around(tmp_path, tmp_path / "freecad", VERSION)
    assert program_on_path(around, str(found.parent)) == (found if is_used else None)
    own = Around(tmp_path, tmp_path / "freecad", VERSION, (found.parent,))
    assert program_on_path(own, str(found.parent)) is None


def test_pins_of_this_addon_are_all_there() -> None:
    known = pins.pinned(pins.pins_file())
    assert {
        "numpy",
        "scipy",
        "opencv-python-headless",
        "ifcopenshell",
        "pye57",
        "python-neo-lzf",
        "lazrs",
    } <= known.keys()
    assert pins.pip_wheel().name.startswith("pip-")
