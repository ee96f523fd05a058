"""MQTT: the state, retained, under ``aadm/COLUMN/hoisting``; the broker tells readers when the link is lost."""

from __future__ import annotations

import asyncio
import json
import os
import re
import ssl
from pathlib import Path
from typing import Any

from aadm_workbench.errors import AadmError, needed
from aadm_workbench.report.json import encode

from .snapshot import Snapshot

_QOS = 1  # a message that was sent arrives, perhaps twice: each is a whole state
_KEEPALIVE_S = 5  # after one and a half times of this without a sign, the broker publishes the last will
_PLAIN_PORT, _TLS_PORT = 1883, 8883  # IANA's for mqtt and secure-mqtt
_HEARTBEAT_EVERY = 10  # looks: once a second
_CONNECT_WITHIN_S = 5.0  # a broker in a site's network answers in milliseconds
_NO_LEVEL = re.compile(r"[/+#$\x00-\x1f]")
_LOST = "the link is lost"
_STOPPED = "the link has ended"


class MqttLink:
    """A client of one broker. User and password come from AADM_MQTT_USER and AADM_MQTT_PASSWORD."""

    def __init__(self, broker: str, certificates: Path | None) -> None:
        host, port = _address(broker, certificates is not None)
        self.where = f"MQTT at {host}:{port}, aadm/COLUMN/hoisting"
        self._host, self._port, self._certificates = host, port, certificates
        self._client: Any = None
        self._topic, self._shown = "", b""

    async def start(self) -> None:
        """Look whether the broker answers; what is published there depends on the column."""
        with needed("paho-mqtt", "aadm link --mqtt"):
            import paho.mqtt.client  # noqa: F401 - whether it is there
        await asyncio.to_thread(self._connect, "")

    async def show(self, snapshot: Snapshot, heartbeat: int) -> None:
        """Publish the state where it changed, and the heartbeat once a second."""
        topic = topic_of(snapshot.column) if snapshot.column else self._topic
        if not topic:
            return
        if topic != self._topic:
            await self.stop()
            await asyncio.to_thread(self._connect, topic)
        payload = payload_of(snapshot)
        if payload != self._shown:
            self._client.publish(self._topic, payload, _QOS, retain=True)
            self._shown = payload
        if heartbeat % _HEARTBEAT_EVERY == 0:
            self._client.publish(f"{self._topic}/heartbeat", str(heartbeat), 0)

    async def stop(self) -> None:
        """Say that nothing is ready, and end."""
        if self._client is None:
            return
        if self._topic:
            done = self._client.publish(self._topic, _nothing(_STOPPED), _QOS, retain=True)
            await asyncio.to_thread(done.wait_for_publish, _CONNECT_WITHIN_S)
        self._client.disconnect()
        await asyncio.to_thread(self._client.loop_stop)
        self._client, self._shown = None, b""

    def _connect(self, topic: str) -> None:
        from paho.mqtt.client import Client
        from paho.mqtt.enums import CallbackAPIVersion

        client = Client(CallbackAPIVersion.VERSION2)
        if self._certificates is not None:
            client.tls_set_context(_context(self._certificates))
        if user := os.environ.get("AADM_MQTT_USER"):
            client.username_pw_set(user, os.environ.get("AADM_MQTT_PASSWORD"))
        if topic:
            client.will_set(topic, _nothing(_LOST), _QOS, retain=True)
        refused: list[str] = []

        def connected(_client: Any, _user: Any, _flags: Any, reason: Any, _properties: Any) -> None:
            refused.append(str(reason) if reason.is_failure else "")
            self._shown = b""  # while the link was lost, the broker has told the last will

        def ended(_client: Any, _user: Any, _flags: Any, reason: Any, _properties: Any) -> None:
            if not refused:  # TLS 1.3: a broker that knows no such certificate hangs up after the handshake
                refused.append(str(reason))

        client.on_connect, client.on_disconnect = connected, ended
        try:
            client.connect(self._host, self._port, _KEEPALIVE_S)
        except OSError as error:
            raise AadmError.because("command.link_silent", address=f"{self._host}:{self._port}", why=error) from error
        client.loop_start()
        _wait_for(refused)
        if not refused or refused[0]:
            client.loop_stop()
            why = refused[0] if refused else "no answer"
            raise AadmError.because("command.link_refused", address=f"{self._host}:{self._port}", why=why)
        self._client, self._topic = client, topic


def topic_of(column: str) -> str:
    """Where the state of a column stands; what a topic may not hold in a level is an underscore."""
    return f"aadm/{_NO_LEVEL.sub('_', column)}/hoisting"


def payload_of(snapshot: Snapshot) -> bytes:
    """The state file, with what holds now in place of what held when it was measured."""
    if snapshot.document is None:
        return _nothing(snapshot.reason)
    shows_move = snapshot.dx_mm is not None
    now = {"ready": snapshot.ready, "reason": snapshot.reason, "shows_move": shows_move}
    move = {} if shows_move else {"move": None}
    return encode({**snapshot.document, **now, **move})


def _nothing(reason: str) -> bytes:
    return json.dumps({"schema": 2, "ready": False, "reason": reason, "shows_move": False, "move": None}).encode()


def _address(broker: str, encrypted: bool) -> tuple[str, int]:
    found = re.fullmatch(r"(\[[0-9A-Fa-f:]+\]|[^:\s/]+)(?::(\d{1,5}))?", broker)
    port = int(found[2] or (_TLS_PORT if encrypted else _PLAIN_PORT)) if found else 0
    if found is None or not 0 < port < 2**16:
        raise AadmError.because("command.link_no_broker", broker=broker)
    return found[1].strip("[]"), port


def _context(folder: Path) -> ssl.SSLContext:
    """TLS with the authority in ``ca.pem``, and a certificate of our own where there is one."""
    try:
        context = ssl.create_default_context(cafile=str(folder / "ca.pem"))
        if (folder / "certificate.pem").exists():
            context.load_cert_chain(folder / "certificate.pem", folder / "key.pem")
    except (OSError, ssl.SSLError) as error:
        raise AadmError.because("command.link_authority", folder=folder, why=error) from error
    return context


def _wait_for(answers: list[str]) -> None:
    import time

    ends = time.monotonic() + _CONNECT_WITHIN_S
    while not answers and time.monotonic() < ends:
        time.sleep(0.01)
