"""Modbus TCP, read only: input registers from 0, each number as two, high word first.

Register 0 is a bit field, register 1 the heartbeat. A number that is not there is the smallest int32. All registers are
filled when they are read, so that one request shows one moment.
"""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any

from aadm_workbench.errors import AadmError, needed

from .snapshot import Quality, Snapshot

if TYPE_CHECKING:
    from pymodbus.constants import ExcCodes

NO_NUMBER = -(2**31)
"""Two thousand kilometres in micrometres: no crane takes it for a move."""

BITS = ("ready", "fresh", "still", "oriented", "numbers", "uncertain")
"""Bit 0 upwards of register 0; ``numbers``: there are some, ``uncertain``: the frame is inconclusive."""

NUMBERS = ("sequence", "dx_um", "dy_um", "yaw_mdeg", "left_um", "u_um", "limit_um", "age_ms")
"""Two registers each, from register 2 on."""

REGISTERS = 2 + 2 * len(NUMBERS)
"""How many there are."""

_READ_INPUT_REGISTERS = 4  # its function code; all others are refused
_THOUSANDTHS = 1000.0  # mm to µm, degrees to millidegrees, s to ms


class ModbusLink:
    """A server on one port."""

    def __init__(self, host: str, port: int) -> None:
        self.where = f"Modbus TCP at {host}:{port}, input registers 0 to {REGISTERS - 1}"
        self._address = (host, port)
        self._registers = registers_of(Snapshot(False, "", Quality.NO_DATA), 0)
        self._server: Any = None

    async def start(self) -> None:
        """Listen; other function codes, other registers and every write are answered by an exception."""
        with needed("pymodbus", "aadm link --modbus"):
            from pymodbus.server import ModbusTcpServer
            from pymodbus.simulator import DataType, SimData, SimDevice
        logging.getLogger("pymodbus").setLevel(logging.CRITICAL)
        block = SimData(0, count=REGISTERS, values=0, datatype=DataType.REGISTERS, readonly=True)
        device = SimDevice(0, simdata=[block], action=self._answer)
        self._server = ModbusTcpServer(device, address=self._address)
        try:
            await self._server.serve_forever(background=True)
        except (OSError, RuntimeError) as error:  # pymodbus keeps the reason to itself
            raise AadmError.because("command.link_port", where=self.where) from error

    async def show(self, snapshot: Snapshot, heartbeat: int) -> None:
        """Show a snapshot to whoever reads next."""
        self._registers = registers_of(snapshot, heartbeat)

    async def stop(self) -> None:
        """Close all connections."""
        if self._server is not None:
            await self._server.shutdown()

    async def _answer(
        self, function: int, _start: int, _address: int, _count: int, registers: list[int], written: Any
    ) -> ExcCodes | None:
        from pymodbus.constants import ExcCodes

        if function != _READ_INPUT_REGISTERS or written is not None:
            return ExcCodes.ILLEGAL_FUNCTION
        registers[:REGISTERS] = self._registers
        return None


def registers_of(snapshot: Snapshot, heartbeat: int) -> list[int]:
    """The registers of a snapshot, in order, 16 bits each."""
    has_numbers = snapshot.quality in (Quality.GOOD, Quality.UNCERTAIN)
    said = {
        "ready": snapshot.ready,
        "fresh": snapshot.fresh,
        "still": snapshot.still,
        "oriented": snapshot.oriented,
        "numbers": has_numbers,
        "uncertain": snapshot.quality is Quality.UNCERTAIN,
    }
    age_s = None if snapshot.captured_s is None else max(0.0, snapshot.now_s - snapshot.captured_s)
    values = (
        snapshot.sequence,
        *(
            _thousandths(value)
            for value in (
                snapshot.dx_mm,
                snapshot.dy_mm,
                snapshot.yaw_deg,
                snapshot.left_mm,
                snapshot.u_mm,
                snapshot.limit_mm,
                age_s,
            )
        ),
    )
    field = sum(1 << place for place, name in enumerate(BITS) if said[name])
    return [field, heartbeat & 0xFFFF, *(half for value in values for half in _halves(value))]


def _thousandths(value: float | None) -> int:
    scaled = None if value is None else round(value * _THOUSANDTHS)
    return NO_NUMBER if scaled is None or not NO_NUMBER < scaled < -NO_NUMBER else scaled


def _halves(value: int) -> tuple[int, int]:
    whole = value & 0xFFFFFFFF
    return whole >> 16, whole & 0xFFFF
