"""A crane's controller that reads the hoisting state by OPC UA, for the chain without hardware.

It does what ``docs/live.md`` asks of one: it acts on a frame once, only on numbers of good quality, and only where what
it read twice is the same.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from .opcua import NAMESPACE

_NAMES = ("Ready", "Sequence", "Dx_mm", "Dy_mm", "Yaw_deg", "Left_mm", "Reason", "U_mm")
_AGAIN_AFTER_S = 0.25  # two looks of the link: ready is then back, if it comes back
_POLL_S = 0.05  # what controllers poll with
_ANSWER_WITHIN_S = 30.0  # here the camera's light is calculated on the same machine, which then does little else
_WORTH_MM, _WORTH_DEG = 1.2, 0.2  # 0.4 of the limit; what is nearer a slow swing leaves within it


class Machine(Protocol):
    """What the controller steers."""

    landed: bool

    def move(self, dx_mm: float, dy_mm: float, yaw_deg: float) -> None:
        """Turn, then move."""

    def lower(self) -> None:
        """Let down."""

    def decided(self) -> None:
        """Take the next picture."""


@dataclass(frozen=True)
class Reading:
    """What was read at one time; numbers None where their quality is bad or uncertain.

    A move without ``u_mm`` is one from a place of which nobody knows yet whether the column swings through it.
    """

    ready: bool
    sequence: int
    move: tuple[float, float, float] | None
    reason: str
    u_mm: float | None = None


class Controller:
    """Moves a machine by what it reads; where the link is lost, it connects again, and has forgotten nothing."""

    def __init__(self, machine: Machine, say: Callable[[str], None]) -> None:
        self._machine, self._say, self._acted = machine, say, 0

    async def steer(self, url: str) -> None:
        """Read and act until the machine has let its column down."""
        from asyncua.ua.uaerrors import UaError

        while not self._machine.landed:
            try:
                await self._connected(url)
            except (OSError, TimeoutError, UaError):
                await asyncio.sleep(_AGAIN_AFTER_S)

    async def _connected(self, url: str) -> None:
        from asyncua import Client

        async with Client(url, timeout=_ANSWER_WITHIN_S) as client:
            space = await client.get_namespace_index(NAMESPACE)
            nodes = [client.get_node(f"ns={space};s=Hoisting.{name}").nodeid for name in _NAMES]
            while not self._machine.landed:
                reading = await _read(client, nodes)
                if reading.sequence > self._acted:
                    await asyncio.sleep(_AGAIN_AFTER_S)
                    again = await _read(client, nodes)
                    if again.sequence == reading.sequence:
                        self._acted = again.sequence
                        self._say(act(self._machine, again))
                await asyncio.sleep(_POLL_S)


def act(machine: Machine, reading: Reading) -> str:
    """Do what a reading allows, once, and say what."""
    if reading.ready:
        machine.lower()
        return "controller: READY was read, the column is let down"
    if reading.move is None or reading.u_mm is None or not _is_worth(reading.move):
        machine.decided()
        return f"controller: waits ({reading.reason})"
    machine.move(*reading.move)
    machine.decided()
    dx_mm, dy_mm, yaw_deg = reading.move
    return f"controller: moves by {dx_mm:+.1f}, {dy_mm:+.1f} mm, turns by {yaw_deg:+.2f} deg"


def _is_worth(move: tuple[float, float, float]) -> bool:
    dx_mm, dy_mm, yaw_deg = move
    return abs(dx_mm) > _WORTH_MM or abs(dy_mm) > _WORTH_MM or abs(yaw_deg) > _WORTH_DEG


async def _read(client: Any, nodes: list[Any]) -> Reading:
    """All variables in one request."""
    from asyncua import ua

    values = await client.uaclient.read_attributes(nodes, ua.AttributeIds.Value)
    found = {
        name: value.Value.Value if value.StatusCode.is_good() else None
        for name, value in zip(_NAMES, values, strict=True)
    }
    numbers = [found["Dx_mm"], found["Dy_mm"], found["Yaw_deg"]]
    dx_mm, dy_mm, yaw_deg = (number if isinstance(number, float) else None for number in numbers)
    u_mm = found["U_mm"] if isinstance(found["U_mm"], float) else None
    move = None if dx_mm is None or dy_mm is None or yaw_deg is None else (dx_mm, dy_mm, yaw_deg)
    return Reading(found["Ready"] is True, int(found["Sequence"] or 0), move, str(found["Reason"] or ""), u_mm)
