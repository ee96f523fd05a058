"""What a check and its worker processes say to each other: through pipes that nobody else can open.

A port of this machine can be reached by each of its users, a pipe by the two processes that hold its ends. That is why
Python objects may travel here, which is forbidden for files.
"""

from __future__ import annotations

import os
import pickle  # noqa: TID251 - between a process and the one that started it, never from a file
import struct
import subprocess
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass
from queue import SimpleQueue
from typing import IO, Any

from aadm_workbench.model import Reason

_LENGTH = struct.Struct("<Q")


@dataclass(frozen=True)
class Failed:
    """The answer to a question that could not be answered: why, on one line."""

    what: str


class Conversation:
    """Questions to a worker process, one after the other, and its answers, in a thread of its own.

    Parameters
    ----------
    process
        With pipes for its input and its output.
    heard
        Is given each answer, and None once there will be no more: the process has ended.
    """

    def __init__(self, process: subprocess.Popen[bytes], heard: Callable[[Any], None]) -> None:
        self._process = process
        self._heard = heard
        self._questions: SimpleQueue[bytes | None] = SimpleQueue()
        threading.Thread(target=self._talk, name=f"worker {process.pid}", daemon=True).start()

    def ask(self, call: Callable[..., Any], *arguments: Any) -> None:
        """Have the process call a function of a module."""
        self._questions.put(pickle.dumps((call, arguments), pickle.HIGHEST_PROTOCOL))

    def end(self) -> None:
        """Say nothing more."""
        self._questions.put(None)

    def _talk(self) -> None:
        questions, answers = self._process.stdin, self._process.stdout
        assert questions is not None
        assert answers is not None
        try:
            while (question := self._questions.get()) is not None:
                send(questions, question)
                self._heard(_understood(receive(answers)))
        except (OSError, EOFError, ValueError):
            self._heard(None)


def own_ends() -> tuple[IO[bytes], IO[bytes]]:
    """In a worker process: what it is asked, and where it answers.

    What anybody else in it reads from then on is empty, and what they write goes where errors go.
    """
    sys.stdout.flush()
    questions, answers = os.dup(0), os.dup(1)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    return os.fdopen(questions, "rb"), os.fdopen(answers, "wb")


def answer(question: bytes) -> bytes:
    """Do what was asked; what goes wrong, the packing of the answer included, is an answer too."""
    try:
        call, arguments = pickle.loads(question)  # noqa: S301 - from the process that started this one
        return pickle.dumps(call(*arguments), pickle.HIGHEST_PROTOCOL)
    except Exception as error:  # noqa: BLE001 - the other side must hear of it, whatever it is
        said = f"{type(error).__name__}: {error}".splitlines()[0]
        return pickle.dumps(Failed(said), pickle.HIGHEST_PROTOCOL)


def send(stream: IO[bytes], message: bytes) -> None:
    """Write a message with its length."""
    stream.write(_LENGTH.pack(len(message)))
    stream.write(message)
    stream.flush()


def receive(stream: IO[bytes]) -> bytes:
    """The next message.

    Raises
    ------
    EOFError
        Where the other side is gone.
    """
    (size,) = _LENGTH.unpack(_exactly(stream, _LENGTH.size))
    return _exactly(stream, size)


def _exactly(stream: IO[bytes], size: int) -> bytes:
    content = stream.read(size)
    if len(content) < size:
        raise EOFError
    return content


def _understood(message: bytes) -> Any:
    try:
        return pickle.loads(message)  # noqa: S301 - from a process that this one started
    except Exception as error:  # noqa: BLE001 - whatever it is, the task has no outcome
        return Failed(Reason("run.no_answer", why=f"{type(error).__name__}: {error}".splitlines()[0]))
