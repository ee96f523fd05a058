"""A state file that a test changes, and links that show it meanwhile."""

from __future__ import annotations

import asyncio
import json
import socket
import time
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

from aadm_workbench.report.hoisting_fitness import stamp_of
from batch.link.publish import Link, publish
from tests.report.test_hoisting_fitness import state


def free_port() -> int:
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))
        return int(held.getsockname()[1])


def write_state(path: Path, captured_s: float | None = None, **changes: Any) -> dict[str, Any]:
    """A state that is ready, captured now and valid for as long as an overloaded machine may take, with changes."""
    captured = {"captured": stamp_of(time.time_ns() / 1e9 if captured_s is None else captured_s)}
    said = {"schema": 2, "column": "C-301", "sequence": 7}
    document = {**said, **state(**{"valid_for_s": 3600.0, **captured, **changes})}
    aside = path.with_suffix(".part")
    aside.write_text(json.dumps(document), encoding="utf-8")
    aside.replace(path)
    return document


@asynccontextmanager
async def linked(path: Path, *links: Link) -> AsyncIterator[list[str]]:
    """The links, showing a state file; what the command says meanwhile."""
    said: list[str] = []
    task = asyncio.create_task(publish(path, links, said.append))
    await until(lambda: len(said) > len(links) or task.done())
    try:
        yield said
    finally:
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)


async def until(holds: Callable[[], Any], within_s: float = 30.0) -> None:
    ends = time.monotonic() + within_s
    while not (found := holds()) or (asyncio.iscoroutine(found) and not await found):
        assert time.monotonic() < ends, "it never came"
        await asyncio.sleep(0.02)
