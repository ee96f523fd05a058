"""The chaos of benchmarks/chaos.py in small: workers die, inputs are spoilt, strangers come, it is killed twice."""

import os
import socket
from pathlib import Path

import numpy as np

from batch.job.file import read_job
from benchmarks.chaos import run_chaos
from benchmarks.floors import write_floor
from benchmarks.strangers import Strangers


def test_a_floor_in_chaos_is_a_floor_in_peace(tmp_path: Path) -> None:
    chaos = run_chaos(tmp_path, 24, np.random.default_rng(5), kill_every_s=1.5)
    assert chaos.differ == []
    assert chaos.not_noticed == []
    assert chaos.processes_killed == 2
    assert chaos.harm == []
    assert {"full disk", "dead scheduler", "empty mount"} == {*chaos.faults.said, *chaos.faults.untried}
    assert [text for promised, text in chaos.faults.said.values() if not promised] == []
    assert min(chaos.strangers.links, chaos.strangers.pipes) > 0
    assert len(set(chaos.corrupt)) == 2
    # The calm check and the last one: some columns fail or are errors.
    assert chaos.exit_codes[-1] == 12


def test_floors_of_any_size(tmp_path: Path) -> None:
    for shrink in (1, 8):
        job = read_job(write_floor(tmp_path / str(shrink), 7, shrink=shrink))
        assert [column.id for column in job.columns] == [f"K-{number:04d}" for number in range(7)]
        assert all(
            (job.folder / name).is_file() for column in job.columns for name in (*column.sleeves, *column.rebars)
        )


def test_strangers_notice_what_they_get_hold_of(tmp_path: Path) -> None:
    strangers = Strangers(tmp_path / "out", tmp_path / "precious")
    strangers.come_near(os.getpid())
    assert strangers.harm == []
    (tmp_path / "precious" / "report.json").write_text("changed")
    with socket.create_server(("127.0.0.1", 0)) as server:
        strangers.come_near(os.getpid())
        assert set(strangers.harm) == {
            "written through a link: report.json",
            f"listens on port {server.getsockname()[1]}",
        }
