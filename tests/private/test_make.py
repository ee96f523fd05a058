"""The private environment is made, repaired and taken away by its own program, offline, in awkward places."""

import shutil
import socket
import subprocess
import time
from importlib.util import cache_from_source
from pathlib import Path

import pytest

from tests.private.addon import ENDLESS_PIP, PACKAGES, QUICK_PIP, Addon, make_addon, write_wheel


@pytest.fixture
def addon(tmp_path: Path) -> Addon:
    return make_addon(tmp_path, PACKAGES)


@pytest.fixture
def quick(tmp_path: Path) -> Addon:
    return make_addon(tmp_path, PACKAGES, QUICK_PIP)


@pytest.fixture
def endless(tmp_path: Path) -> Addon:
    return make_addon(tmp_path, PACKAGES, ENDLESS_PIP)


def begun(addon: Addon) -> subprocess.Popen[str]:
    """One that is being made, until somebody ends it."""
    process = addon.start("--wheels", str(addon.wheels))
    assert process.stdout is not None
    while not process.stdout.readline().startswith("1/2 lazrs"):
        assert process.poll() is None
    assert [path.name[:5] for path in addon.made()] == [".new-"]
    return process


def run_in(addon: Addon, text: str) -> subprocess.Popen[str]:
    """A module of the addon's root in the environment that was made."""
    (folder,) = addon.made()
    (addon.root / "told.py").write_text(text, encoding="utf-8")
    return subprocess.Popen(
        addon.words("launcher.py", str(folder / "site"), str(addon.root), "told"),
        env=addon.variables(),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )


def line_of(process: subprocess.Popen[str]) -> str:
    assert process.stdout is not None
    return process.stdout.readline().strip()


def end(process: subprocess.Popen[str]) -> None:
    assert process.stdin is not None
    process.stdin.close()
    process.wait(60)


def test_made_from_a_folder_of_wheels(addon: Addon) -> None:
    pins = addon.root / "requirements" / "freecad.txt"
    # A package that has no wheel for this system is not asked for, and not missed.
    pins.write_text(pins.read_text(encoding="utf-8") + "pye57==1.0 ; sys_platform == 'elsewhere'\n", encoding="utf-8")
    said = addon.make()
    assert [line for line in said if line[:2] in {"1/", "2/"}][:2] == [
        "1/3 lazrs-1.0-py3-none-any.whl",
        "2/3 tifffile-1.0-py3-none-any.whl",
    ]
    (folder,) = addon.made()
    assert sorted(path.name for path in folder.iterdir()) == ["in-use", "made.json", "site"]
    process = run_in(
        addon, "import sys, tifffile\nprint(tifffile.__file__, sys.path[-2:] == sys.argv[1:] or sys.path[-2:])"
    )
    file, *_ = line_of(process).rsplit(" ", 1)
    assert "site" in file
    end(process)


def test_the_product_is_compiled_when_it_is_installed(quick: Addon) -> None:
    """What a check imports is byte code already; a folder that nobody may write to does not keep it from being made."""
    files = list((quick.root / "aadm_workbench").rglob("*.py"))
    for folder in quick.root.rglob("__pycache__"):  # of whoever has used the tree that was copied
        shutil.rmtree(folder)
    quick.make()
    assert [path for path in files if not Path(cache_from_source(str(path))).exists()] == []
    for folder in quick.root.rglob("__pycache__"):
        shutil.rmtree(folder)
        folder.touch()  # no folder of that name can be made any more, not even by root
    shutil.rmtree(quick.environments)
    assert not quick.make()[-1].startswith("!")


def test_missing_wheel_is_said_and_nothing_is_left(addon: Addon) -> None:
    next(addon.wheels.glob("tifffile*")).unlink()
    assert addon.make()[-1].startswith("!no-wheel")
    assert addon.made() == []


def test_package_that_cannot_be_loaded_is_said_and_nothing_is_left(quick: Addon) -> None:
    write_wheel(quick.wheels, "tifffile", "import a_library_that_is_not_there\n")
    said = quick.make()[-1]
    assert said.startswith("!broken tifffile: ModuleNotFoundError")
    assert quick.made() == []


def test_server_that_cannot_be_reached_is_said(addon: Addon) -> None:
    with socket.socket() as nobody:
        nobody.bind(("127.0.0.1", 0))
        port = nobody.getsockname()[1]
    index = {"PIP_INDEX_URL": f"http://127.0.0.1:{port}/simple", "PIP_RETRIES": "0"}
    said = addon.make("--wheels", "", **index)[-1]
    assert said.startswith(("!network", "!no-wheel"))
    assert addon.made() == []


def test_cancelled_by_closing_its_input(endless: Addon) -> None:
    process = begun(endless)
    end(process)
    assert process.returncode != 0
    assert endless.made() == []


@pytest.mark.parametrize("waits_s", [0.0, 0.05, 0.1, 0.2, 0.3])
def test_cancelled_at_any_moment_it_leaves_nothing(endless: Addon, waits_s: float) -> None:
    process = endless.start("--wheels", str(endless.wheels))
    time.sleep(waits_s)
    end(process)
    assert endless.made() == []
    held = (endless.root / "requirements" / "pip-0-py3-none-any.whl").as_posix().encode()
    running = [path for path in Path("/proc").glob("[0-9]*/cmdline") if held in read_or_nothing(path)]
    assert running == [], "pip goes on"


def read_or_nothing(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""


def test_two_at_once_are_refused(endless: Addon) -> None:
    first = begun(endless)
    assert endless.make()[-1].startswith("!busy")
    end(first)


def test_damaged_one_is_repaired_but_not_under_a_running_check(quick: Addon) -> None:
    quick.make()
    (folder,) = quick.made()
    (folder / "site" / "lazrs.py").unlink()
    process = run_in(quick, "import time\nprint('works', flush=True)\ntime.sleep(60)")
    assert line_of(process) == "works"
    assert quick.make()[-1].startswith("!in-use")
    assert quick.made() == [folder]
    end(process)
    quick.make()
    assert quick.made() == [folder]
    assert (folder / "site" / "lazrs.py").is_file()


def test_process_ends_with_its_input(quick: Addon) -> None:
    quick.make()
    process = run_in(quick, "import time\nprint('works', flush=True)\ntime.sleep(600)")
    assert line_of(process) == "works"
    end(process)
    assert process.returncode != 0


def test_what_others_have_set_for_python_does_not_matter(quick: Addon) -> None:
    quick.make()
    process = run_in(
        quick, "import json, os, sys\nprint(json.__file__, os.environ['AADM_PRIVATE_ENVIRONMENT'], sys.flags.isolated)"
    )
    said = line_of(process)
    assert "hostile" not in said
    assert said.endswith(" 1")
    assert str(quick.environments) in said
    end(process)
