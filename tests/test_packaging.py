"""What is installed is what lies in the tree, and the versions that are written down agree."""

import re
import subprocess
import sys
import tomllib
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

import pytest

from aadm_workbench import __version__

NOT_INSTALLED = {"", ".sh", ".pyc"}


def names_in(folder: Path, prefix: str) -> set[str]:
    """Names that the files of a source folder have once they are installed."""
    return {
        f"{prefix}/{path.relative_to(folder).as_posix()}"
        for path in folder.rglob("*")
        if path.is_file() and path.suffix not in NOT_INSTALLED
    }


def pins(path: Path) -> dict[str, str]:
    """Version of each package that a requirements file pins."""
    lines = [line for line in path.read_text("utf-8").splitlines() if line and not line.startswith("#")]
    found = [re.fullmatch(r"([a-z0-9-]+)==([^ ]+)( ; .+)?", line) for line in lines]
    assert all(found), "something is not pinned"
    return {match[1]: match[2] for match in found if match}


def test_wheel_holds_every_file(repository: Path, tmp_path: Path) -> None:
    # Beside the tree: setuptools leaves a folder build/ where it works, with files of earlier versions in it.
    copy = tmp_path / "copy"
    copy.mkdir()
    for name in ("pyproject.toml", "LICENSE"):
        (copy / name).write_bytes((repository / name).read_bytes())
    (copy / "README.md").write_text("")
    for name in ("aadm_workbench", "batch"):
        (copy / name).symlink_to(repository / name)
    command = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-index", "--no-build-isolation", "--quiet"]
    subprocess.run([*command, "--wheel-dir", str(tmp_path), str(copy)], check=True)
    (wheel,) = tmp_path.glob("aadm_workbench-*.whl")
    installed = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    expected = names_in(repository / "aadm_workbench", "aadm_workbench") | names_in(repository / "batch", "aadm_batch")
    assert installed == expected


def test_one_version(repository: Path) -> None:
    package = ElementTree.parse(repository / "package.xml").getroot()
    assert package.findtext("{https://wiki.freecad.org/Package_Metadata}version") == __version__


def test_demo_and_tests_pin_the_same_versions(repository: Path) -> None:
    demo, test = pins(repository / "requirements/demo.txt"), pins(repository / "requirements/test.txt")
    assert demo.items() <= test.items()


def test_freecads_private_environment_is_whole_and_of_the_same_versions(repository: Path) -> None:
    freecad, test = pins(repository / "requirements/freecad.txt"), pins(repository / "requirements/test.txt")
    assert freecad.items() <= test.items()
    project = tomllib.loads((repository / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    wanted = [*project["dependencies"], *extras["reports"], *extras["formats"], *extras["mesh"], "psutil"]
    named = {found[0] for one in wanted if (found := re.match(r"[A-Za-z0-9-]+", one))}
    assert named <= freecad.keys(), "run: sh requirements/renew.sh --no-upgrade"


def test_demo_stays_lean(repository: Path) -> None:
    demo = pins(repository / "requirements/demo.txt")
    assert not {"open3d", "open3d-cpu", "matplotlib", "distributed"} & demo.keys()


@pytest.mark.parametrize(("extra", "file"), [("", "demo"), ("test", "test")])
def test_every_dependency_is_pinned(repository: Path, extra: str, file: str) -> None:
    project = tomllib.loads((repository / "pyproject.toml").read_text("utf-8"))["project"]
    wanted = project["optional-dependencies"][extra] if extra else project["dependencies"]
    names = {re.split(r"[\[>=;\s]", line)[0] for line in wanted} - {project["name"]}
    assert names <= pins(repository / f"requirements/{file}.txt").keys()
