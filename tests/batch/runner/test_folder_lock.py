"""Two runs never write into one folder; a run that was killed stands in nobody's way."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from aadm_workbench.errors import AadmError, JobError
from batch.runner.folder_lock import locked

HOLDS = """
import sys
from pathlib import Path
from batch.runner.folder_lock import locked
with locked(Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""


def test_a_second_run_is_refused_until_the_first_is_gone(tmp_path: Path, repository: Path) -> None:
    command = [sys.executable, "-c", HOLDS, str(tmp_path)]
    first = subprocess.Popen(command, cwd=repository, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert first.stdout is not None
    assert first.stdout.readline() == "held\n"
    with pytest.raises(JobError, match=rf"process {first.pid} on .+ is writing its results there"), locked(tmp_path):
        pass
    first.kill()
    first.communicate()
    with locked(tmp_path):
        pass
    with locked(tmp_path):
        pass


def test_a_folder_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(AadmError, match="nothing can be written there"), locked(tmp_path / "nowhere"):
        pass


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write everywhere")
def test_a_read_only_folder(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(AadmError, match="name another folder with --out"), locked(tmp_path):
        pass
