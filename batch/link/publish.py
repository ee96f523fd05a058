"""The loop of ``aadm link``: looks at the state file, and shows what it holds now through every link that is open."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Protocol

from .snapshot import Snapshot, read_snapshot

LOOK_EVERY_S = 0.1
"""A tenth of what a crane takes to react; a state file is read in a millisecond."""


class Link(Protocol):
    """One protocol, open."""

    where: str

    async def start(self) -> None:
        """Begin to listen, or connect."""

    async def show(self, snapshot: Snapshot, heartbeat: int) -> None:
        """Show a snapshot: what is not ready before its values, what is ready after them."""

    async def stop(self) -> None:
        """Say that nothing is ready, and end."""


async def publish(
    state: Path,
    links: Sequence[Link],
    say: Callable[[str], None],
    seconds: float | None = None,
    now_ns: Callable[[], int] = time.time_ns,
) -> Snapshot | None:
    """Show a state file until ``seconds`` have passed (None: never), or until it is cancelled; what was shown last."""
    shown: Snapshot | None = None
    started: list[Link] = []
    heartbeat = 0
    try:
        for link in links:
            await link.start()
            started.append(link)
            say(link.where)
        ends = None if seconds is None else time.monotonic() + seconds
        while ends is None or time.monotonic() < ends:
            heartbeat += 1
            snapshot = read_snapshot(state, now_ns() / 1e9)
            if shown is not None and shown.ready and _changes(shown, snapshot):
                await _show(links, shown.withdrawn(), heartbeat)
                await asyncio.sleep(LOOK_EVERY_S)  # a reader who asks twice sees it
            await _show(links, snapshot, heartbeat)
            if shown is None or (shown.ready, shown.reason) != (snapshot.ready, snapshot.reason):
                say("READY" if snapshot.ready else f"not ready: {snapshot.reason}")
            shown = snapshot
            await asyncio.sleep(LOOK_EVERY_S)
    finally:
        for link in started:
            await link.stop()
    return shown


def _changes(shown: Snapshot, snapshot: Snapshot) -> bool:
    return (shown.sequence, shown.column, shown.captured_s) != (snapshot.sequence, snapshot.column, snapshot.captured_s)


async def _show(links: Sequence[Link], snapshot: Snapshot, heartbeat: int) -> None:
    for link in links:
        await link.show(snapshot, heartbeat)
