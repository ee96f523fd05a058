"""OPC UA by clients of two makers: open62541 (values, quality, time-out, certificates), asyncua (what it refuses)."""

from __future__ import annotations

import asyncio
import json
import re
import stat
import sys
import time
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from datetime import datetime
from pathlib import Path
from typing import Any

import pytest
from asyncua import Client, ua
from asyncua.crypto.cert_gen import (
    dump_private_key_as_pem,
    generate_private_key,
    generate_self_signed_app_certificate,
)
from asyncua.crypto.security_policies import SecurityPolicyBasic256Sha256
from asyncua.ua.uaerrors import UaError
from cryptography import x509
from cryptography.hazmat.primitives.serialization import Encoding
from cryptography.x509.oid import ExtendedKeyUsageOID

from batch.link.certificates import Certificates
from batch.link.opcua import NAMESPACE, NUMBERS, OpcUaLink

from .links import free_port, linked, until, write_state

READER = "urn:crane:controller"


async def reader(client: Client) -> Any:
    """How one variable of the object is read, by its name."""
    space = await client.get_namespace_index(NAMESPACE)

    async def read(name: str) -> ua.DataValue:
        return await client.get_node(f"ns={space};s=Hoisting.{name}").read_data_value(raise_on_bad_status=False)

    return read


class OtherReader:
    """A controller with another maker's stack, in a process of its own."""

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self._process = process

    async def answer(self) -> Any:
        return json.loads(await self._process.stdout.readline())

    async def asked(self, *words: str) -> Any:
        self._process.stdin.write(" ".join(words).encode() + b"\n")
        return await self.answer()

    async def read(self, *names: str) -> list[dict[str, Any]]:
        return await self.asked("read", *names)

    async def until(self, name: str, holds: Callable[[dict[str, Any]], bool]) -> None:
        async def is_so() -> bool:
            return holds((await self.read(name))[0])

        await until(is_so)


@asynccontextmanager
async def other_reader(
    port: int, own: tuple[Path, Path] | None = None, server: Path | None = None
) -> AsyncIterator[Any]:
    secured = () if own is None else (*own, server, READER)
    words = map(str, (Path(__file__).with_name("opcua_reader.py"), f"opc.tcp://127.0.0.1:{port}/aadm", *secured))
    pipe, nothing = asyncio.subprocess.PIPE, asyncio.subprocess.DEVNULL
    process = await asyncio.create_subprocess_exec(sys.executable, *words, stdin=pipe, stdout=pipe, stderr=nothing)
    try:
        yield OtherReader(process)
    finally:
        process.kill()
        await process.wait()


def test_another_makers_client_sees_values_quality_time_out_and_can_write_nothing(tmp_path: Path) -> None:
    path, port = tmp_path / "aadm-state.json", free_port()
    move = {"dx_mm": -1.25, "dy_mm": 0.5, "yaw_deg": 0.125, "u_mm": 0.1}
    captured_s = time.time_ns() / 1e9
    write_state(path, captured_s, move=move)

    async def run() -> None:
        async with linked(path, OpcUaLink("127.0.0.1", port, None)), other_reader(port) as reader:
            assert await reader.answer() == "connected"
            ready, captured, *numbers = await reader.read("Ready", "Captured", *NUMBERS)
            assert (ready["value"], ready["status"]) == (True, "GOOD")
            assert [number["value"] for number in numbers] == [-1.25, 0.5, 0.125, None, 0.1, 3.0]
            assert [number["status"] for number in numbers] == [*["GOOD"] * 3, "BAD_NO_DATA", *["GOOD"] * 2]
            for taken in (captured["value"], numbers[0]["source"]):
                assert datetime.fromisoformat(taken).timestamp() == pytest.approx(captured_s, abs=2e-3)
            beat, sequence = await reader.read("Heartbeat", "Sequence")
            assert sequence["value"] == 7
            await reader.until("Heartbeat", lambda found: found["value"] > beat["value"])
            assert await reader.asked("write", "Ready") == "BAD_USER_ACCESS_DENIED"
            async with Client(f"opc.tcp://127.0.0.1:{port}/aadm", timeout=60) as client:
                await _refused(client)
            assert (await reader.read("Ready"))[0]["value"] is True

            write_state(path, sequence=8, frame__verdict="inconclusive", frame__reasons=["S2-R2: too close"])
            await reader.until("Sequence", lambda found: found["value"] == 8)
            dx, ready, reason = await reader.read("Dx_mm", "Ready", "Reason")
            assert dx["status"] == "UNCERTAIN_SENSOR_NOT_ACCURATE"
            assert dx["value"] is not None
            assert (ready["value"], reason["value"]) == (False, "S2-R2: too close")

            write_state(path, time.time_ns() / 1e9 - 14.0, sequence=9, valid_for_s=15.0)  # it grows too old by itself
            await reader.until("Sequence", lambda found: found["value"] == 9)
            await reader.until("Dx_mm", lambda found: found["status"] == "BAD_TIMEOUT")
            ready, reason, *numbers = await reader.read("Ready", "Reason", *NUMBERS)
            assert [number["value"] for number in numbers] == [None] * len(NUMBERS)
            assert ready["value"] is False
            assert re.match(r"captured \d+ s ago", reason["value"])

            path.unlink()
            await reader.until("Dx_mm", lambda found: found["status"] == "BAD_NO_DATA")
            assert "is aadm watch running" in (await reader.read("Reason"))[0]["value"]

    asyncio.run(run())


async def _refused(client: Client) -> None:
    """Whatever would change something is refused."""
    space = await client.get_namespace_index(NAMESPACE)
    ready = client.get_node(f"ns={space};s=Hoisting.Ready")
    with pytest.raises(UaError):
        await ready.write_value(False)
    with pytest.raises(UaError):
        await ready.write_value(ua.DataValue(ua.Variant(False, ua.VariantType.Boolean)))
    with pytest.raises(UaError):
        await client.nodes.server_state.write_value(1)
    with pytest.raises(UaError):
        await client.nodes.objects.add_object(ua.NodeId("Mine", space), f"{space}:Mine")
    with pytest.raises(UaError):
        await client.delete_nodes([ready])
    with pytest.raises(UaError):
        await client.nodes.server.call_method("0:GetMonitoredItems", 1)


def test_ready_is_withdrawn_before_values_change(tmp_path: Path) -> None:
    path, port = tmp_path / "aadm-state.json", free_port()
    write_state(path, move={"dx_mm": 1.0, "dy_mm": 0.0, "yaw_deg": 0.0, "u_mm": 0.1})
    events: list[tuple[str, Any]] = []

    class Handler:
        def datachange_notification(self, node: Any, value: Any, _data: Any) -> None:
            events.append((node.nodeid.Identifier, value))

    async def run() -> None:
        async with (
            linked(path, OpcUaLink("127.0.0.1", port, None)),
            Client(f"opc.tcp://127.0.0.1:{port}/aadm", timeout=60) as client,
        ):
            space = await client.get_namespace_index(NAMESPACE)
            nodes = [client.get_node(f"ns={space};s=Hoisting.{name}") for name in ("Ready", "Dx_mm")]
            subscription = await client.create_subscription(20, Handler())
            await subscription.subscribe_data_change(nodes, queuesize=100)
            await until(lambda: len(events) == 2)
            for dx_mm in (2.0, 3.0):
                write_state(path, sequence=dx_mm, move={"dx_mm": dx_mm, "dy_mm": 0.0, "yaw_deg": 0.0, "u_mm": 0.1})
                await until(lambda wanted=dx_mm: ("Hoisting.Dx_mm", wanted) in events)
            await until(lambda: len(events) == 8)

    asyncio.run(run())
    ready = "Hoisting.Ready"
    assert sorted(events[:2]) == [("Hoisting.Dx_mm", 1.0), (ready, True)]
    for began, dx_mm in ((2, 2.0), (5, 3.0)):
        assert [value for name, value in events[began : began + 3] if name == ready] == [False, True]
        assert ("Hoisting.Dx_mm", dx_mm) in events[began : began + 3]


def certificate(folder: Path, uri: str = READER, days: int = 30) -> tuple[Path, Path]:
    """A client's own certificate and key."""
    folder.mkdir(parents=True, exist_ok=True)
    key = generate_private_key()
    made = generate_self_signed_app_certificate(
        key, "controller", {}, [x509.UniformResourceIdentifier(uri)], [ExtendedKeyUsageOID.CLIENT_AUTH], days
    )
    (folder / "key.pem").write_bytes(dump_private_key_as_pem(key))
    (folder / "certificate.der").write_bytes(made.public_bytes(Encoding.DER))
    return folder / "certificate.der", folder / "key.pem"


async def ready_of(port: int, own: tuple[Path, Path] | None, server: Path, says: bytes | None = b"own") -> Any:
    """What a client with a certificate reads; ``says``: the certificate that it names when it opens its session."""
    client = Client(f"opc.tcp://127.0.0.1:{port}/aadm", timeout=60)
    client.application_uri = READER
    if own is not None:
        await client.set_security(
            SecurityPolicyBasic256Sha256,
            certificate=str(own[0]),
            private_key=str(own[1]),
            server_certificate=str(server),
        )
        if says != b"own":
            send = client.uaclient.create_session

            async def create_session(parameters: Any) -> Any:
                parameters.ClientCertificate = says
                return await send(parameters)

            client.uaclient.create_session = create_session
    async with client:
        return (await (await reader(client))("Ready")).Value.Value


def test_only_trusted_certificates_get_in(tmp_path: Path) -> None:
    path, port, folder = tmp_path / "aadm-state.json", free_port(), tmp_path / "certificates"
    write_state(path)
    known, stranger = certificate(tmp_path / "known"), certificate(tmp_path / "stranger")
    certificates = Certificates(folder)
    (folder / "trusted" / "crane.der").write_bytes(known[0].read_bytes())
    (folder / "trusted" / "readme.txt").write_text("certificates of those who may read")
    (folder / "trusted" / "broken.der").write_text("no certificate")
    server = folder / "own" / "certificate.der"

    async def run() -> None:
        async with linked(path, OpcUaLink("127.0.0.1", port, certificates)):
            for own, answer in ((known, "connected"), (stranger, "BAD_CERTIFICATE_UNTRUSTED")):
                async with other_reader(port, own, server) as other:
                    assert await other.answer() == answer
            with pytest.raises(UaError, match="BadCertificateUntrusted"):
                await ready_of(port, stranger, server)
            for said in (None, known[0].read_bytes()):  # it may say nothing, or name somebody else's
                with pytest.raises(UaError):
                    await ready_of(port, stranger, server, said)
            with pytest.raises((UaError, TimeoutError)):
                await ready_of(port, None, server)
            (rejected,) = (folder / "rejected").iterdir()
            assert rejected.read_bytes() == stranger[0].read_bytes()
            rejected.rename(folder / "trusted" / rejected.name)
            assert await ready_of(port, stranger, server) in (True, False)
            (folder / "trusted" / "crane.der").unlink()
            with pytest.raises(UaError, match="BadCertificateUntrusted"):
                await ready_of(port, known, server)

    asyncio.run(run())
    assert stat.S_IMODE((folder / "own" / "key.pem").stat().st_mode) == 0o600


def test_a_certificate_of_another_application_does_not_get_in(tmp_path: Path) -> None:
    from asyncua.common.utils import ServiceError

    folder = tmp_path / "certificates"
    certificates = Certificates(folder)
    other, _ = certificate(tmp_path / "other", "urn:somebody:else")
    (folder / "trusted" / "other.der").write_bytes(other.read_bytes())
    client = ua.ApplicationDescription(ApplicationUri=READER)
    loaded = x509.load_der_x509_certificate(other.read_bytes())
    with pytest.raises(ServiceError) as caught:
        asyncio.run(certificates.validate(loaded, client))
    assert caught.value.code == ua.StatusCodes.BadCertificateUriInvalid
