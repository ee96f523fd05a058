"""The log of workers: one line each, whatever they say, and never the reason why a check fails."""

import re
from pathlib import Path

from batch.runner.pools import LOG_NAME, WorkersLog


def test_one_line_each_with_its_time(tmp_path: Path) -> None:
    log = WorkersLog(tmp_path)
    log.write("tcp://h:1: 层 3 is ready")
    log.write("steers \x1b[2J a terminal\nand breaks a line \u202e")
    lines = (tmp_path / LOG_NAME).read_text("utf-8").splitlines()
    assert len(lines) == 2
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ tcp://h:1: 层 3 is ready", lines[0])
    assert lines[1].endswith("steers \ufffd[2J a terminal\ufffdand breaks a line \ufffd")


def test_a_log_that_cannot_be_written(tmp_path: Path) -> None:
    WorkersLog(tmp_path / "nowhere").write("lost")
