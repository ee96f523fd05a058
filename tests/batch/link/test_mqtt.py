"""MQTT through a broker of another maker: retained state, heartbeat, last will."""

from __future__ import annotations

import asyncio
import json
import shutil
import ssl
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest
from amqtt.broker import Broker
from amqtt.client import MQTTClient
from amqtt.mqtt.constants import QOS_1

from aadm_workbench.errors import AadmError
from batch.link.mqtt import MqttLink, topic_of
from tests.batch.certificates import write_certificates

from .links import free_port, linked, until, write_state


class StrictBroker(Broker):
    """A broker that asks every client of its encrypted port for a certificate."""

    @staticmethod
    def _create_ssl_context(listener: Any) -> ssl.SSLContext:
        context = Broker._create_ssl_context(listener)
        context.verify_mode = ssl.CERT_REQUIRED
        return context


@asynccontextmanager
async def broker(encrypted: dict[str, Any] | None = None) -> AsyncIterator[int]:
    """A broker; with ``encrypted``, a listener's settings, it has a port for TLS beside the plain one."""
    port = free_port()
    listeners = {"default": {"type": "tcp", "bind": f"127.0.0.1:{port}"}}
    if encrypted is not None:
        listeners["encrypted"] = {"type": "tcp", "ssl": True, **encrypted}
    plugins = {"amqtt.plugins.authentication.AnonymousAuthPlugin": {"allow_anonymous": True}}
    server = StrictBroker({"listeners": listeners, "plugins": plugins})
    await server.start()
    try:
        yield port
    finally:
        await server.shutdown()


@asynccontextmanager
async def reader(port: int, topic: str) -> AsyncIterator[list[tuple[str, Any]]]:
    """What a reader gets who comes now."""
    client = MQTTClient(config={"auto_reconnect": False})
    await client.connect(f"mqtt://127.0.0.1:{port}/")
    await client.subscribe([(topic, QOS_1)])
    got: list[tuple[str, Any]] = []

    async def listen() -> None:
        while True:
            message = await client.deliver_message()
            got.append((message.topic, json.loads(message.data)))

    task = asyncio.create_task(listen())
    try:
        yield got
    finally:
        task.cancel()
        await client.disconnect()


def test_a_reader_gets_the_state_at_once_the_heartbeat_and_the_end(tmp_path: Path) -> None:
    path = tmp_path / "aadm-state.json"
    written = write_state(path)
    topic = "aadm/C-301/hoisting"

    async def run() -> None:
        async with broker() as port:
            async with linked(path, MqttLink(f"127.0.0.1:{port}", None)):
                await asyncio.sleep(0.3)
                async with reader(port, "aadm/#") as got:  # who comes later gets what is retained
                    await until(lambda: got)
                    assert got[0][0] == topic
                    assert {**got[0][1], "reason": ""} == {**written, "ready": True, "shows_move": True, "reason": ""}
                    await until(lambda: any(name == f"{topic}/heartbeat" for name, _ in got))
                    write_state(path, sequence=8, frame__verdict="error", frame__max_mm=None)
                    await until(lambda: any(name == topic and value.get("sequence") == 8 for name, value in got))
                    states = [value for name, value in got if name == topic]
                    assert [value["ready"] for value in states][:2] == [True, False]
                    assert states[1]["sequence"] == 7, "ready is withdrawn before the values change"
                    assert (states[-1]["ready"], states[-1]["move"]) == (False, None)
            async with reader(port, topic) as got:
                await until(lambda: got)
                assert (got[0][1]["ready"], got[0][1]["reason"]) == (False, "the link has ended")

    asyncio.run(run())


def test_the_broker_says_that_the_link_is_lost(tmp_path: Path) -> None:
    path = tmp_path / "aadm-state.json"
    write_state(path)

    async def run() -> None:
        async with broker() as port:
            link = MqttLink(f"127.0.0.1:{port}", None)
            async with linked(path, link), reader(port, "aadm/C-301/hoisting") as got:
                await until(lambda: got and got[-1][1]["ready"])
                link._client.socket().close()  # the cable
                await until(lambda: any(value.get("reason") == "the link is lost" for _, value in got))
                await until(lambda: got[-1][1]["ready"])  # it comes back by itself

    asyncio.run(run())


def own_folder(folder: Path, name: str, ca: Path, signed: Path | None = None, key: Path | None = None) -> Path:
    """What ``--certificates`` names: the broker's authority, and a certificate of one's own where there is one."""
    made = folder / name
    made.mkdir()
    shutil.copy(ca, made / "ca.pem")
    if signed is not None and key is not None:
        shutil.copy(signed, made / "certificate.pem")
        shutil.copy(key, made / "key.pem")
    return made


def test_an_encrypted_link_shows_the_state_and_strangers_get_nowhere(tmp_path: Path) -> None:
    path, port = tmp_path / "aadm-state.json", free_port()
    write_state(path)
    made = write_certificates(tmp_path)
    settings = {
        "bind": f"127.0.0.1:{port}",
        "cafile": str(made["ca"]),
        "certfile": str(made["cert"]),
        "keyfile": str(made["key"]),
    }
    known = own_folder(tmp_path, "known", made["ca"], made["cert"], made["key"])
    strange_client = own_folder(tmp_path, "strange-client", made["ca"], made["stranger"], made["stranger-key"])
    nameless = own_folder(tmp_path, "nameless", made["ca"])
    strange_broker = own_folder(tmp_path, "strange-broker", made["stranger-ca"], made["cert"], made["key"])

    async def run() -> None:
        async with broker(settings) as plain:
            async with linked(path, MqttLink(f"127.0.0.1:{port}", known)), reader(plain, "aadm/C-301/hoisting") as got:
                await until(lambda: got and got[-1][1]["ready"])
            for folder in (strange_client, nameless):
                with pytest.raises(AadmError, match=f"127.0.0.1:{port}: the MQTT broker refuses the connection"):
                    await MqttLink(f"127.0.0.1:{port}", folder).start()
            with pytest.raises(AadmError, match="certificate verify failed"):
                await MqttLink(f"127.0.0.1:{port}", strange_broker).start()
            with pytest.raises(AadmError, match="certificate verify failed"):
                await MqttLink(f"localhost:{port}", known).start()  # the certificate is for 127.0.0.1
            with pytest.raises(AadmError, match=r"refuses the connection|does not answer"):
                await MqttLink(f"127.0.0.1:{port}", None).start()  # not encrypted

    asyncio.run(run())


def test_a_broker_that_is_not_there_and_addresses_that_are_none(tmp_path: Path) -> None:
    with pytest.raises(AadmError, match="does not answer"):
        asyncio.run(MqttLink(f"127.0.0.1:{free_port()}", None).start())
    for address in ("", "host:99999", "host:port", "a b", "http://x"):
        with pytest.raises(AadmError, match="is no broker"):
            MqttLink(address, None)
    with pytest.raises(AadmError, match=r"ca\.pem"):
        asyncio.run(MqttLink("127.0.0.1:8883", tmp_path).start())


@pytest.mark.parametrize(
    ("column", "topic"),
    [("C-301", "aadm/C-301/hoisting"), ("3/A+#$", "aadm/3_A___/hoisting"), ("柱 1", "aadm/柱 1/hoisting")],
)
def test_a_column_is_one_level_of_its_topic(column: str, topic: str) -> None:
    assert topic_of(column) == topic
