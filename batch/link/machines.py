"""Link and controller beside a watch in one program, speaking to each other over OPC UA on this machine."""

from __future__ import annotations

import asyncio
import socket
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from .controller import Controller, Machine
from .opcua import OpcUaLink
from .publish import publish


class Machines:
    """Shows a state file, and lets a controller move a machine by what it reads of it, until the ``with`` ends."""

    def __init__(
        self, state: Path, machine: Machine, tell: Callable[[str], None], now_ns: Callable[[], int] = time.time_ns
    ) -> None:
        self._state, self._machine, self._tell, self._now_ns = state, machine, tell, now_ns
        self._loop = asyncio.new_event_loop()
        self._task: asyncio.Task[None] | None = None
        self._thread = threading.Thread(target=self._run, name="machines")

    def __enter__(self) -> None:
        self._state.unlink(missing_ok=True)
        self._thread.start()

    def __exit__(self, *_: object) -> None:
        self._loop.call_soon_threadsafe(self._stop)
        self._thread.join()

    def _stop(self) -> None:
        if self._task is not None:
            self._task.cancel()

    def _run(self) -> None:
        with suppress(asyncio.CancelledError):
            self._task = self._loop.create_task(self._both())
            self._loop.run_until_complete(self._task)
        self._loop.close()

    async def _both(self) -> None:
        link = OpcUaLink("127.0.0.1", _free_port(), None)
        linking = asyncio.create_task(publish(self._state, [link], lambda _: None, now_ns=self._now_ns))
        try:
            await link.listening.wait()
            await Controller(self._machine, self._tell).steer(link.endpoint)
        finally:
            linking.cancel()
            await asyncio.gather(linking, return_exceptions=True)


def _free_port() -> int:
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))
        return int(held.getsockname()[1])
