"""Limits and paces, as people write and read them."""

import argparse

import pytest

from batch.shown import progress
from batch.shown.progress import Pace, duration
from batch.switches import memory_size, time_span


@pytest.mark.parametrize(
    ("text", "size"), [("2GB", 2 * 10**9), ("600 mb", 6 * 10**8), ("1.5GiB", 3 * 2**29), ("512MiB", 2**29)]
)
def test_sizes(text: str, size: int) -> None:
    assert memory_size(text) == size


@pytest.mark.parametrize(("text", "seconds"), [("90s", 90.0), ("15min", 900.0), ("1h", 3600.0), ("0.5 s", 0.5)])
def test_times(text: str, seconds: float) -> None:
    assert time_span(text) == seconds


@pytest.mark.parametrize("text", ["", "2", "GB", "0GB", "-1GB", "2 parsecs", "1e3s", "5s"])
def test_no_sizes(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError, match="write 2GB or 600MB"):
        memory_size(text)


def test_too_little_memory() -> None:
    with pytest.raises(argparse.ArgumentTypeError, match="too little memory"):
        memory_size("100MB")


@pytest.mark.parametrize("text", ["", "5", "0s", "2GB", "1:30"])
def test_no_times(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError, match="write 90s, 15min or 1h"):
        time_span(text)


def test_pace(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 100.0
    monkeypatch.setattr(progress, "monotonic", lambda: now)
    steps = Pace(200)
    assert (steps.per_second(), steps.in_words()) == (None, "")
    for _ in range(60):
        now += 2.0
        steps.step()
    assert steps.per_second() == 0.5
    assert steps.seconds_left() == 280.0
    assert steps.in_words() == "2.0 s each, 4 min 40 s left"
    # Only the last fifty count: what was slow at first is soon forgotten.
    for _ in range(60):
        now += 0.1
        steps.step()
    assert steps.in_words() == "10.0/s, 8 s left"


def test_durations() -> None:
    assert [duration(seconds) for seconds in (0.4, 59.4, 82.0, 3600.0, 7500.0)] == [
        "0 s",
        "59 s",
        "1 min 22 s",
        "1 h 00 min",
        "2 h 05 min",
    ]
