"""Modbus TCP as a controller speaks it: requests are built here byte by byte (Modbus Application Protocol 1.1b3)."""

from __future__ import annotations

import asyncio
import struct
from itertools import pairwise
from pathlib import Path

import pytest

from batch.link.modbus import ModbusLink

from .links import free_port, linked, until, write_state

READ_COILS, READ_INPUT = 1, 4
NO_NUMBER = -2147483648


async def asked(port: int, function: int, body: bytes, unit: int = 1) -> bytes:
    """The answer to one request, from its function code on."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    writer.write(struct.pack(">HHHBB", 0x1234, 0, len(body) + 2, unit, function) + body)
    head = await asyncio.wait_for(reader.readexactly(7), 10)
    transaction, protocol, length, _ = struct.unpack(">HHHB", head)
    assert (transaction, protocol) == (0x1234, 0)
    answer = await asyncio.wait_for(reader.readexactly(length - 1), 10)
    writer.close()
    return answer


async def registers(port: int) -> tuple[int, ...]:
    """Bit field, heartbeat and the eight numbers, in one request."""
    answer = await asked(port, READ_INPUT, struct.pack(">HH", 0, 18))
    assert (answer[0], answer[1]) == (READ_INPUT, 36)
    return struct.unpack(">HH8i", answer[2:])


def test_a_controller_reads_the_state_and_can_write_nothing(tmp_path: Path) -> None:
    path, port = tmp_path / "aadm-state.json", free_port()
    move = {"dx_mm": -1.2345, "dy_mm": 0.7, "yaw_deg": -0.0514, "u_mm": 0.12}
    write_state(path, move=move)

    async def run() -> None:
        async with linked(path, ModbusLink("127.0.0.1", port)):
            field, beat, sequence, dx, dy, yaw, _left, u, limit, age_ms = await registers(port)
            assert field & 0b111111 == 0b011111  # ready, fresh, still, oriented, numbers; not uncertain
            assert (sequence, dx, dy, yaw, u, limit) == (7, -1234, 700, -51, 120, 3000)
            assert 0 <= age_ms < 3_600_000

            async def beats() -> bool:
                return (await registers(port))[1] != beat

            await until(beats)
            written = struct.pack(">H", 1)
            refused = [
                (5, struct.pack(">HH", 0, 0xFF00)),
                (6, struct.pack(">HH", 0, 1)),
                (15, struct.pack(">HHBB", 0, 1, 1, 1)),
                (16, struct.pack(">HHB", 0, 1, 2) + written),
                (22, struct.pack(">HHH", 0, 0, 1)),
                (23, struct.pack(">HHHHB", 0, 1, 0, 1, 2) + written),
                (6, struct.pack(">HH", 9000, 1)),
                (READ_COILS, struct.pack(">HH", 0, 1)),
                (2, struct.pack(">HH", 0, 1)),
                (3, struct.pack(">HH", 0, 2)),
                (READ_INPUT, struct.pack(">HH", 10, 18)),
                (READ_INPUT, struct.pack(">HH", 18, 1)),
            ]
            for function, body in refused:
                answer = await asked(port, function, body)
                assert answer[0] == function | 0x80, function
                assert answer[1] in (1, 2)
            assert (await registers(port))[0] & 1

            write_state(path, sequence=8, frame__verdict="error", frame__max_mm=None)

            async def has_none() -> bool:
                field, _, sequence, dx, dy, yaw, left, u, limit, _ = await registers(port)
                assert not (field & 1 and sequence == 8)
                return sequence == 8 and (dx, dy, yaw, left, u, limit, field & 0b10001) == (*[NO_NUMBER] * 5, 3000, 0)

            await until(has_none)

    asyncio.run(run())


def test_ready_is_withdrawn_between_two_values(tmp_path: Path) -> None:
    path, port = tmp_path / "aadm-state.json", free_port()
    write_state(path)
    seen: list[tuple[bool, int]] = []

    async def run() -> None:
        async with linked(path, ModbusLink("127.0.0.1", port)):
            for sequence in (7, 8, 9):
                write_state(path, sequence=sequence)
                while not seen or seen[-1] != (True, sequence):
                    field, _, shown, *_ = await registers(port)
                    seen.append((bool(field & 1), shown))

    asyncio.run(run())
    changes = [seen[0], *(now for before, now in pairwise(seen) if now != before)]
    for before, now in pairwise(changes):
        assert not (before[0] and now[0]), "values changed while they were ready"
    assert [sequence for ready, sequence in changes if ready] == [7, 8, 9]


def test_a_port_that_is_taken_is_named(tmp_path: Path) -> None:
    from aadm_workbench.errors import AadmError

    port = free_port()

    async def run() -> None:
        server = await asyncio.start_server(lambda _r, _w: None, "127.0.0.1", port)
        try:
            with pytest.raises(AadmError, match="cannot listen"):
                await ModbusLink("127.0.0.1", port).start()
        finally:
            server.close()

    asyncio.run(run())
