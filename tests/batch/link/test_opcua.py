"""OPC UA by a client of another process's code path: values, quality, time-out, writes, certificates."""

from __future__ import annotations

import asyncio
import re
import stat
import time
from datetime import UTC, datetime
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
BAD = 0x80000000  # of every bad status, OPC 10000-4


async def reader(client: Client) -> Any:
    """How one variable of the object is read, by its name."""
    space = await client.get_namespace_index(NAMESPACE)

    async def read(name: str) -> ua.DataValue:
        return await client.get_node(f"ns={space};s=Hoisting.{name}").read_data_value(raise_on_bad_status=False)

    return read


def test_a_client_sees_values_quality_time_out_and_can_write_nothing(tmp_path: Path) -> None:
    path, port = tmp_path / "aadm-state.json", free_port()
    move = {"dx_mm": -1.25, "dy_mm": 0.5, "yaw_deg": 0.125, "u_mm": 0.1}
    captured_s = time.time_ns() / 1e9
    write_state(path, captured_s, move=move)

    async def run() -> None:
        async with (
            linked(path, OpcUaLink("127.0.0.1", port, None)),
            Client(f"opc.tcp://127.0.0.1:{port}/aadm", timeout=60) as client,
        ):
            read = await reader(client)
            assert (await read("Ready")).Value.Value is True
            values = [(await read(name)).Value.Value for name in NUMBERS]
            assert values[:3] == [-1.25, 0.5, 0.125]
            assert (values[4], values[5]) == (0.1, 3)
            dx = await read("Dx_mm")
            assert dx.StatusCode.is_good()
            taken = dx.SourceTimestamp.replace(tzinfo=UTC).timestamp()
            assert taken == pytest.approx(captured_s, abs=2e-3)
            assert (await read("Sequence")).Value.Value == 7
            assert (await read("Captured")).Value.Value.replace(tzinfo=UTC) <= datetime.now(UTC)
            beat = (await read("Heartbeat")).Value.Value
            await until(lambda: _is(read, "Heartbeat", lambda value: value.Value.Value > beat))
            await _refused(client, tmp_path)
            assert (await read("Ready")).Value.Value is True

            write_state(path, sequence=8, frame__verdict="inconclusive", frame__reasons=["S2-R2: too close"])
            await until(lambda: _is(read, "Sequence", lambda value: value.Value.Value == 8))
            dx = await read("Dx_mm")
            assert not dx.StatusCode.is_good()
            assert dx.StatusCode.value & BAD == 0
            assert dx.Value.Value is not None
            assert (await read("Ready")).Value.Value is False
            assert (await read("Reason")).Value.Value == "S2-R2: too close"

            write_state(path, time.time_ns() / 1e9 - 14.0, sequence=9, valid_for_s=15.0)  # it grows too old by itself
            await until(lambda: _is(read, "Sequence", lambda value: value.Value.Value == 9))
            await until(lambda: _is(read, "Dx_mm", lambda value: value.StatusCode.value == ua.StatusCodes.BadTimeout))
            assert [(await read(name)).Value.Value for name in NUMBERS] == [None] * len(NUMBERS)
            assert (await read("Ready")).Value.Value is False
            assert re.match(r"captured \d+ s ago", (await read("Reason")).Value.Value)

            path.unlink()
            await until(lambda: _is(read, "Dx_mm", lambda value: value.StatusCode.value == ua.StatusCodes.BadNoData))
            assert "is aadm watch running" in (await read("Reason")).Value.Value

    asyncio.run(run())


async def _is(read: Any, name: str, holds: Any) -> bool:
    return bool(holds(await read(name)))


async def _refused(client: Client, folder: Path) -> None:
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
            assert await ready_of(port, known, server) in (True, False)
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
