"""A request to end, from the keyboard or from the system: the work stops at once, and what was done is kept."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def end_requests() -> Iterator[None]:
    """Whoever ends this process in an orderly way (SIGTERM, a closed terminal) is heard like Ctrl-C."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    there = [number for name in ("SIGTERM", "SIGHUP") if (number := getattr(signal, name, None)) is not None]
    # Under nohup a closed terminal is to be ignored.
    heard = [number for number in there if signal.getsignal(number) is signal.SIG_DFL]
    before = {number: signal.signal(number, _interrupt) for number in heard}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _interrupt(number: int, frame: FrameType | None) -> None:
    raise KeyboardInterrupt
