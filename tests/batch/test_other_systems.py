"""What is only there on POSIX or Linux is done without elsewhere: a check runs where none of it can be imported.

This stands in for machines with Windows and macOS, which are not at hand: what they lack is taken
away, what they have instead is put there.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from .conftest import WriteJob, column_text

POSIX_MODULES = ("crypt", "fcntl", "grp", "nis", "posix", "pty", "pwd", "resource", "spwd", "syslog", "termios", "tty")
"""Those of the standard library that Windows does not have."""

ELSEWHERE = """
import importlib, os, pkgutil, signal, sys, types
from pathlib import Path

# What others need of the system they may have: it is this project that is to do without.
import cv2, ifcopenshell, jinja2, numpy, psutil, reportlab, rich, scipy.optimize, scipy.spatial, tempfile, shutil, uuid

posix, lacks_functions = {posix!r}, {functions!r}
for name in posix:
    sys.modules[name] = None
for module, names in lacks_functions.items():
    for name in names:
        if hasattr(sys.modules[module], name):
            delattr(sys.modules[module], name)
os.supports_dir_fd = set()
locked = types.ModuleType("msvcrt")
locked.LK_NBLCK, locked.locking = 2, lambda descriptor, mode, size: None
sys.modules["msvcrt"] = locked

found = []
for package in ("aadm_workbench", "batch"):
    for path in sorted(Path(package).rglob("*.py")):
        name = ".".join(path.with_suffix("").parts).removesuffix(".__init__")
        if path.name == "__main__.py" or set(path.parts) & {{"document", "gui", "published", "twin"}}:
            continue
        importlib.import_module(name)
        found.append(name)

from batch.main import main
print(len(found), main(["check", sys.argv[1], "--out", sys.argv[2], "--quiet", "--html", *sys.argv[3:]]))
"""

SYSTEMS = {
    "windows": (
        POSIX_MODULES,
        {
            "os": (
                *("O_NOFOLLOW", "O_NONBLOCK", "O_DIRECTORY", "O_CLOEXEC", "O_NOCTTY", "killpg", "sched_getaffinity"),
                *("getppid", "geteuid", "getuid", "mkfifo", "setsid", "fchmod"),
            ),
            "signal": ("SIGHUP", "SIGKILL"),
        },
    ),
    "macos": ((), {"os": ("sched_getaffinity",)}),
}


@pytest.mark.parametrize("system", SYSTEMS)
def test_a_check_runs_without_what_a_system_lacks(
    write_job: WriteJob, repository: Path, tmp_path: Path, system: str
) -> None:
    job = write_job(column_text("C-1", "C-1.ply"), column_text("C-2", "missing.ply"), clouds=("C-1.ply",))
    posix, functions = SYSTEMS[system]
    script = ELSEWHERE.format(posix=posix, functions=functions)
    command = [sys.executable, "-c", script, str(job), str(tmp_path / "there")]
    done = subprocess.run(command, cwd=repository, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    modules, code = map(int, done.stdout.split())
    assert modules > 150
    assert code == 12
    here = [sys.executable, "-m", "batch", "check", str(job), "--out", str(tmp_path / "here"), "--quiet"]
    subprocess.run(here, cwd=repository, check=False)
    reports = [json.loads((tmp_path / out / "report.json").read_text("utf-8")) for out in ("here", "there")]
    assert reports[0] == reports[1]
    assert (tmp_path / "there" / ".aadm-lock").read_text().split()[0].isdecimal()
