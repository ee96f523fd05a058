"""A process that ends when whoever started it closes its standard input, or dies."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable
from time import sleep

_LAST_WORDS_S = 1.0  # time to take temporary files away
ENDED = 130  # as a shell says of a process that was interrupted


def end_with_input(end: Callable[[], None] | None = None) -> None:
    """Watch the standard input in a thread; at its end call ``end``, or interrupt this process."""
    threading.Thread(target=_watch, args=(end or _interrupt,), daemon=True).start()


def _watch(end: Callable[[], None]) -> None:
    try:
        # Not sys.stdin: its lock would bring the interpreter down at exit.
        while os.read(0, 1024):
            pass
    except OSError:
        pass
    end()
    sleep(_LAST_WORDS_S)
    os._exit(ENDED)


def _interrupt() -> None:
    if sys.platform == "win32":
        import _thread

        _thread.interrupt_main()
    else:
        os.kill(os.getpid(), signal.SIGINT)
