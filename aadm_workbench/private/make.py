"""Makes the private environment of the Python that runs it: ``python -I -S make.py ROOT [--wheels DIR]``.

Says what it does line by line, steps as ``3/30 numpy``; what went wrong stands behind ``!`` in the last line, as one of
the words of ``PROBLEMS``. Ends, and takes away what it has begun, when its standard input ends.
"""

import os
import shutil
import subprocess
import sys
import threading
from pathlib import Path

PROBLEMS = ("busy", "in-use", "network", "no-wheel", "certificate", "proxy", "space", "broken", "pip", "folder")
"""The words behind ``!``."""

_NEEDED_BYTES = 10**9
"""The packages take 670 MB, their wheels 180 MB while they are unpacked."""

_ROOMS = ("aadm_workbench", "batch")
"""Folders of the product that its checks import from."""

_OF_PIP = {
    "CERTIFICATE_VERIFY_FAILED": "certificate",
    "407 Proxy": "proxy",
    "ProxyError": "proxy",
    "No space left": "space",
    "NewConnectionError": "network",
    "NameResolutionError": "network",
    "Read timed out": "network",
    "ConnectTimeoutError": "network",
    "No matching distribution": "no-wheel",
}
"""Signs of pip's output, by what they mean; those that say more come first."""


class NotMadeError(Exception):
    """It could not be made; one of PROBLEMS, and what it is about."""


def main(wheels: str = "") -> int:
    """Make the environment of this Python; 0 where it is there afterwards."""
    from aadm_workbench.private.environment import environment_folder
    from aadm_workbench.private.holding import InUseError, hold

    folder = environment_folder(sys.version_info[:2])
    say(f"{sys.executable} (Python {sys.version.split()[0]}) -> {folder}")
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with hold(folder.parent / "making", alone=True):
            make(folder, wheels)
    except InUseError:
        return wrong("busy", str(folder.parent))
    except NotMadeError as error:
        return wrong(*error.args)
    except OSError as error:
        return wrong("space" if error.errno == 28 else "folder", str(error))
    return 0


def make(folder: Path, wheels: str) -> None:
    """Install into a folder beside, prove it, give it its name; one that is there already makes room."""
    from aadm_workbench.private.ending import end_with_input
    from aadm_workbench.private.environment import remove_folder, write_note

    for left in folder.parent.glob(".new-*"):
        shutil.rmtree(left, ignore_errors=True)
    if shutil.disk_usage(folder.parent).free < _NEEDED_BYTES:
        raise NotMadeError("space", str(folder.parent))
    begun = Begun(folder.parent / f".new-{os.getpid()}")
    end_with_input(begun.give_up)
    new = begun.folder
    try:
        with begun.lock:
            (new / "tmp").mkdir(parents=True)
        install(begun, wheels)
        prove(new)
        compile_own()
        with begun.lock:
            shutil.rmtree(new / "tmp", ignore_errors=True)
            write_note(new)
            if folder.exists() and not remove_folder(folder):
                raise NotMadeError("in-use", str(folder))
            new.rename(folder)
    finally:
        with begun.lock:
            shutil.rmtree(new, ignore_errors=True)


class Begun:
    """A folder that is being filled, and an end of that which leaves nothing, whenever it comes.

    Whoever begins something holds ``lock``; who gives up does not let go of it.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.lock = threading.Lock()
        self.running: subprocess.Popen[bytes] | None = None

    def give_up(self) -> None:
        """End pip, take away what it has written, end this process."""
        from aadm_workbench.private.ending import ENDED

        with self.lock:
            if self.running is not None:
                self.running.kill()
                self.running.wait()
            shutil.rmtree(self.folder, ignore_errors=True)
            os._exit(ENDED)


def install(begun: Begun, wheels: str) -> None:
    """Have pip unpack each pin into ``site``."""
    from aadm_workbench.private import pins

    count, total, lines = 0, len(pins.pinned(pins.pins_file())), []
    command = [sys.executable, "-I", "-S", "-X", "utf8", f"{pins.pip_wheel()}/pip", "install", "--no-deps"]
    command += ["--only-binary=:all:", "--progress-bar", "off", "--no-compile"]
    command += ["--target", str(begun.folder / "site"), "--requirement", str(pins.pins_file())]
    command += ["--no-index", "--find-links", wheels] if wheels else []
    say(" ".join(command))
    with begun.lock:
        begun.running = process = subprocess.Popen(
            command,
            env=variables(begun.folder),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
    for raw in process.stdout or ():
        line = raw.decode("utf-8", errors="replace").rstrip()
        lines.append(line)
        if line.startswith(("Collecting ", "Processing ")):  # the latter from a folder of wheels
            count += 1
            say(f"{min(count, total)}/{total} {Path(line.partition(' ')[2].partition(' (from')[0]).name}")
        elif line.startswith("Installing collected"):
            say(f"{total}/{total} unpacking")
        else:
            say(f"  {line}")
    if process.wait() != 0:
        text = "\n".join(lines)
        last = next((line for line in reversed(lines) if line.strip()), "")
        raise NotMadeError(next((word for sign, word in _OF_PIP.items() if sign in text), "pip"), last)


def variables(new: Path) -> "dict[str, str]":
    """The settings of pip stay, since mirrors need them; what would lead it elsewhere goes."""
    from aadm_workbench.private.pythons import plain_environment

    kept = plain_environment(os.environ)
    for name in ("PIP_TARGET", "PIP_PREFIX", "PIP_USER", "PIP_REQUIRE_VIRTUALENV", "PIP_CONSTRAINT", "PIP_PYTHON"):
        kept.pop(name, None)
    # Here nothing is left behind by a pip that is killed.
    kept |= dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(new / "tmp"))
    return kept | {"PIP_DISABLE_PIP_VERSION_CHECK": "1", "PIP_NO_INPUT": "1"}


def prove(new: Path) -> None:
    """Import all packages in a process that sees nothing else."""
    from aadm_workbench.private import pins
    from aadm_workbench.private.environment import python_words

    say("  importing each package once")
    command = [sys.executable, *python_words(new / "site", "aadm_workbench.private.proof")]
    command += sorted(set(pins.pinned(pins.pins_file())) - begun_without(new))
    # It shares this process's input, and ends with it.
    done = subprocess.run(command, env=variables(new), stdout=subprocess.PIPE, check=False)
    if done.returncode != 0:
        said = done.stdout.decode("utf-8", errors="replace").strip()
        raise NotMadeError("broken", said.replace("\n", "; ") or f"the proof ended with {done.returncode}")


def compile_own() -> None:
    """Byte-compile the product itself, so that no check has to; in a folder that cannot be written, each has to."""
    from compileall import compile_dir

    from aadm_workbench.private import pins

    say("  compiling the product")
    for room in _ROOMS:
        compile_dir(pins.ROOT / room, quiet=2)


def begun_without(new: Path) -> "set[str]":
    """Pins that are not meant for this system, which pip has left out: it says so in their markers."""
    from aadm_workbench.private import pins

    marked = {name for name, marker in pins.markers(pins.pins_file()).items() if marker}
    there = {path.name.partition("-")[0].replace("_", "-").lower() for path in (new / "site").glob("*.dist-info")}
    return {name for name in marked if name.replace("_", "-").lower() not in there}


def wrong(problem: str, about: str) -> int:
    """Say what went wrong, in the last line."""
    say(f"!{problem} {about}")
    return 1


def say(line: str) -> None:
    """A line of the log."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.path.append(sys.argv[1])
    raise SystemExit(main(sys.argv[3] if sys.argv[2:3] == ["--wheels"] else ""))
