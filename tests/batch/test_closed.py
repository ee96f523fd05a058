"""What another user of the machine can do to a check: nothing. The attacks are shown to work where a door is open."""

import os
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from batch.runner.pipes import Failed, answer
from benchmarks.floors import write_floor

NOBODY = 65534

# Run code wherever Dask listens, as a stranger.
ATTACK = """
import os, sys
os.setgroups([]); os.setgid({nobody}); os.setuid({nobody})
os.environ["HOME"] = "/"
from distributed import Client
for port in sys.argv[1:]:
    try:
        client = Client(f"tcp://127.0.0.1:{{port}}", timeout=20, set_as_default=False)
        print("ran as", client.run_on_scheduler(os.getuid), "at", port, flush=True)
    except Exception as error:
        print(type(error).__name__, file=sys.stderr)
"""

# Reach into a process: its pipes, its memory, its environment.
REACH = """
import os, sys
os.setgroups([]); os.setgid({nobody}); os.setuid({nobody})
for pid in sys.argv[1:]:
    for number in range(3):
        try:
            os.close(os.open(f"/proc/{{pid}}/fd/{{number}}", os.O_RDWR | os.O_NONBLOCK))
            print("opened", pid, number)
        except OSError:
            pass
    for name in ("environ", "mem"):
        try:
            with open(f"/proc/{{pid}}/{{name}}", "rb") as stream:
                stream.read(1)
                print("read", pid, name)
        except OSError:
            pass
"""

SERVE = """
import sys
from distributed import LocalCluster
with LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address=":0") as cluster:
    print(cluster.scheduler.port, flush=True)
    sys.stdin.read()
"""

needs_root = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() != 0 or sys.platform != "linux",
    reason="only root can act as another user, and only Linux shows who listens",
)


def as_nobody(script: str, *words: str) -> str:
    """What a script prints that takes another user's place."""
    command = [sys.executable, "-c", script.format(nobody=NOBODY), *words]
    return subprocess.run(command, cwd="/", capture_output=True, text=True, timeout=120, check=False).stdout


def family(pid: int) -> list[psutil.Process]:
    """A process and all that it started."""
    try:
        process = psutil.Process(pid)
        return [process, *process.children(recursive=True)]
    except psutil.NoSuchProcess:
        return []


def doors(processes: list[psutil.Process]) -> set[str]:
    """Everything by which somebody else could come in: ports that listen, and sockets with a name."""
    found = set()
    for process in processes:
        try:
            for one in process.net_connections(kind="all"):
                if one.status == psutil.CONN_LISTEN:
                    found.add(f"port {one.laddr.port}")
                elif one.family.name == "AF_UNIX" and one.laddr:
                    found.add(f"socket {one.laddr!r}")
        except psutil.NoSuchProcess:
            continue
    return found


@needs_root
def test_the_attack_works_where_a_scheduler_listens() -> None:
    pytest.importorskip("distributed")
    command = [sys.executable, "-c", SERVE]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        port = server.stdout.readline().strip()
        assert doors(family(server.pid)) >= {f"port {port}"}
        said = as_nobody(ATTACK, port)
        assert as_nobody(REACH, str(os.getpid())) == ""
        server.communicate("")
    if not said:
        pytest.skip("another user cannot even read the packages that this test would attack with")
    assert said == f"ran as 0 at {port}\n"


@needs_root
def test_no_other_user_reaches_a_check_or_its_workers(tmp_path: Path, repository: Path) -> None:
    job = write_floor(tmp_path / "floor", 6)
    process = subprocess.Popen(
        [sys.executable, "-m", "batch", "check", str(job), "--jobs", "2", "--quiet"],
        cwd=repository,
        stdout=subprocess.DEVNULL,
    )
    journal = tmp_path / "floor" / "job-report" / "journal.jsonl"
    open_doors: set[str] = set()
    reached, tried = "", False
    most_workers = 0
    while process.poll() is None:
        processes = family(process.pid)
        open_doors |= doors(processes)
        most_workers = max(most_workers, len(processes) - 1)
        if not tried and most_workers == 2 and journal.exists() and b'"began"' in journal.read_bytes():
            ports = sorted(door.split()[1] for door in open_doors if door.startswith("port"))
            reached = as_nobody(REACH, *(str(one.pid) for one in processes))
            reached += as_nobody(ATTACK, *ports) if ports else ""
            tried = True
        time.sleep(0.05)
    assert reached == ""
    assert open_doors == set()
    assert tried
    assert most_workers == 2
    assert process.returncode in (0, 10, 11)


def test_what_cannot_be_answered_is_an_answer() -> None:
    """The other side of a pipe must hear of everything, also of what cannot be packed or unpacked."""
    import pickle  # noqa: TID251 - what travels through the pipes

    def said(call: object, *arguments: object) -> object:
        return pickle.loads(answer(pickle.dumps((call, arguments))))

    assert said(len, "four") == 4
    assert said(int, "x") == Failed("ValueError: invalid literal for int() with base 10: 'x'")
    unpacked = said(open, os.devnull)
    assert isinstance(unpacked, Failed)
    assert "cannot pickle" in unpacked.what
    broken = pickle.loads(answer(b"nonsense"))
    assert isinstance(broken, Failed)
