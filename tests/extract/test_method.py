"""Extraction methods by name."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.extract.method import METHODS, extract
from aadm_workbench.model import Kind, Scan

CLOUD = Scan(np.random.default_rng(0).uniform(0.0, 100.0, (500, 3)))


def test_methods_are_the_five() -> None:
    assert tuple(METHODS) == ("refined", "fusion", "pointcloud", "image", "corners")


def test_unknown_method_lists_those_there_are() -> None:
    with pytest.raises(ValueError, match=r"'fushion'.*refined, fusion, pointcloud, image, corners"):
        extract(CLOUD, Kind.SLEEVE, 26.0, "fushion", np.random.default_rng(0))


@pytest.mark.parametrize("kind", list(Kind))
@pytest.mark.parametrize("method", ["fusion", "pointcloud"])
def test_without_open3d_the_message_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch, method: str, kind: Kind
) -> None:
    monkeypatch.setitem(sys.modules, "open3d", None)
    with pytest.raises(MissingDependencyError, match=rf"Method {method} .*pip install 'aadm-workbench\[published\]'"):
        extract(CLOUD, kind, 26.0, method, np.random.default_rng(0))


def test_image_does_without_open3d(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "open3d", None)
    found = extract(CLOUD, Kind.SLEEVE, 26.0, "image", np.random.default_rng(0))
    assert found.method == "image"
    assert found.reason


def test_refined_loads_neither_open3d_nor_the_published_methods(repository: Path) -> None:
    text = (
        "import sys\nfrom aadm_workbench.extract.method import METHODS\nfrom aadm_workbench.model import Kind\n"
        "[METHODS['refined'](kind) for kind in Kind]\n"
        "print([name for name in sys.modules if name == 'open3d' or '.published' in name])"
    )
    done = subprocess.run(
        [sys.executable, "-c", text], cwd=repository, capture_output=True, text=True, check=False, timeout=60
    )
    assert (done.returncode, done.stdout.strip()) == (0, "[]"), done.stderr
