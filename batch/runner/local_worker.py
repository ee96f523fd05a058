"""A worker process of this machine: ``python -m aadm_batch.runner.local_worker PARENT``, started by a check.

It does what it is asked through its standard input, answers through its standard output, and listens to nothing else.
It ends with the process that started it, however that ends.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import sys

from ..switches import calculate_in_one_thread
from .pipes import answer, own_ends, receive, send

_SET_SIGNAL_OF_PARENTS_DEATH = 1  # PR_SET_PDEATHSIG of prctl(2)


def main(parent: str) -> None:
    """Do what is asked until nobody is left who asks."""
    _end_with(int(parent))
    calculate_in_one_thread()
    questions, answers = own_ends()
    with contextlib.suppress(OSError, EOFError, KeyboardInterrupt):
        while True:
            send(answers, answer(receive(questions)))
    # Nothing is left to be tidied up, and threads of native libraries may never end.
    os._exit(0)


def _end_with(parent: int) -> None:
    """Where the system can (Linux): be killed when the parent dies, at once and in the middle of native code.

    Elsewhere the pipe breaks: the process ends when it has done what it was asked last.
    """
    if sys.platform != "linux":
        return
    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None, use_errno=True).prctl(_SET_SIGNAL_OF_PARENTS_DEATH, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(0)


if __name__ == "__main__":
    main(*sys.argv[1:])
