"""OPC UA, read only: one object ``Hoisting`` in a namespace of its own, a variable for each key of the state.

The companion specification for cranes and hoists (OPC 40020-1) models the axes and the load of the crane itself and has
no place for a correction, so its names are not used here.
"""

from __future__ import annotations

import asyncio
import logging
from datetime import UTC, datetime
from typing import Any

from aadm_workbench.errors import AadmError, needed

from .certificates import APPLICATION, Certificates
from .snapshot import Quality, Snapshot

NAMESPACE = "urn:aadm:hoisting:1"

NUMBERS = ("Dx_mm", "Dy_mm", "Yaw_deg", "Left_mm", "U_mm", "Limit_mm")
"""Double; bad, without a number, where there is none to act upon."""

_FLAGS = ("Fresh", "Still", "Oriented")
_STATUS = {
    Quality.GOOD: "Good",
    Quality.UNCERTAIN: "UncertainSensorNotAccurate",
    Quality.NO_DATA: "BadNoData",
    Quality.TIMEOUT: "BadTimeout",
}
_WRITES = ("WriteRequest", "CallRequest", "HistoryUpdateRequest", "AddNodesRequest", "DeleteNodesRequest")


class OpcUaLink:
    """A server on one port; with certificates only those who are trusted, encrypted, get in."""

    def __init__(self, host: str, port: int, certificates: Certificates | None) -> None:
        self.endpoint = f"opc.tcp://{host}:{port}/aadm"
        self.where = f"OPC UA at {self.endpoint}"
        self.listening = asyncio.Event()
        self._certificates = certificates
        self._server: Any = None
        self._nodes: dict[str, Any] = {}

    async def start(self) -> None:
        """Build the address space, and listen."""
        with needed("asyncua", "aadm link --opcua"):
            from asyncua import Server
        logging.getLogger("asyncua").setLevel(logging.CRITICAL)
        server = self._server = Server(user_manager=self._certificates)
        await server.init()
        server.set_endpoint(self.endpoint)
        server.set_server_name("AADM hoisting")
        await server.set_application_uri(APPLICATION)
        server.allow_remote_admin(False)
        await self._secure(server)
        await self._build(server)
        try:
            await server.start()
        except OSError as error:
            raise AadmError.because("command.link_not_listening", where=self.where, why=error.strerror) from error
        self.listening.set()

    async def show(self, snapshot: Snapshot, heartbeat: int) -> None:
        """Write what is shown: ready first where it is false, last where it is true."""
        if not snapshot.ready:
            await self._write("Ready", False)
        await self._write("Reason", snapshot.reason)
        values = (
            snapshot.dx_mm,
            snapshot.dy_mm,
            snapshot.yaw_deg,
            snapshot.left_mm,
            snapshot.u_mm,
            snapshot.limit_mm,
        )
        captured = None if snapshot.captured_s is None else datetime.fromtimestamp(snapshot.captured_s, UTC)
        for name, value in zip(NUMBERS, values, strict=True):
            await self._write(name, value, snapshot.quality, captured)
        for name, flag in zip(_FLAGS, (snapshot.fresh, snapshot.still, snapshot.oriented), strict=True):
            await self._write(name, flag)
        await self._write("Column", snapshot.column)
        await self._write("Captured", captured, Quality.NO_DATA if captured is None else Quality.GOOD, captured)
        await self._write("Sequence", snapshot.sequence)
        if snapshot.ready:
            await self._write("Ready", True)
        await self._write("Heartbeat", heartbeat & 0xFFFFFFFF)

    async def stop(self) -> None:
        """Close all sessions."""
        if self._server is not None:
            await self._server.stop()

    async def _secure(self, server: Any) -> None:
        from asyncua import ua

        server.set_identity_tokens([ua.AnonymousIdentityToken])
        policy = ua.SecurityPolicyType.NoSecurity
        if self._certificates is not None:
            policy = ua.SecurityPolicyType.Basic256Sha256_SignAndEncrypt
            own, key = self._certificates.own()
            await server.load_certificate(str(own))
            await server.load_private_key(str(key))
            server.set_certificate_validator(self._certificates.validate)
        server.set_security_policy([policy], permission_ruleset=_ReadOnly())

    async def _build(self, server: Any) -> None:
        from asyncua import ua

        kinds = {
            **dict.fromkeys(("Ready", *_FLAGS), ua.VariantType.Boolean),
            **dict.fromkeys(("Reason", "Column"), ua.VariantType.String),
            **dict.fromkeys(NUMBERS, ua.VariantType.Double),
            "Sequence": ua.VariantType.Int64,
            "Captured": ua.VariantType.DateTime,
            "Heartbeat": ua.VariantType.UInt32,
        }
        space = await server.register_namespace(NAMESPACE)
        hoisting = await server.nodes.objects.add_object(ua.NodeId("Hoisting", space), f"{space}:Hoisting")
        for name, kind in kinds.items():
            first = ua.Variant(_FIRST[kind.name], kind)
            self._nodes[name] = await hoisting.add_variable(
                ua.NodeId(f"Hoisting.{name}", space), f"{space}:{name}", first
            )
        self._kinds = kinds
        await self.show(Snapshot(False, "starting", Quality.NO_DATA), 0)

    async def _write(
        self, name: str, value: Any, quality: Quality = Quality.GOOD, captured: datetime | None = None
    ) -> None:
        from asyncua import ua

        # a number that is missing among good ones has no data; among bad ones none is shown
        status = Quality.NO_DATA if value is None and quality in (Quality.GOOD, Quality.UNCERTAIN) else quality
        has_value = value is not None and status in (Quality.GOOD, Quality.UNCERTAIN)
        variant = ua.Variant(value, self._kinds[name]) if has_value else ua.Variant(None, ua.VariantType.Null)
        stamp = None if captured is None else captured.replace(tzinfo=None)
        code = ua.StatusCode(getattr(ua.StatusCodes, _STATUS[status]))
        await self._nodes[name].write_value(
            ua.DataValue(variant, code, SourceTimestamp=stamp or datetime.now(UTC).replace(tzinfo=None))
        )


class _ReadOnly:
    """Who may ask for what: everybody who is let in may read, nobody may write or call."""

    def __init__(self) -> None:
        from asyncua import ua
        from asyncua.crypto.permission_rules import SimpleRoleRuleset

        self._roles = SimpleRoleRuleset()
        self._refused = {getattr(ua.ObjectIds, f"{name}_Encoding_DefaultBinary") for name in _WRITES}

    def check_validity(self, user: Any, action_type_id: Any, body: Any) -> bool:
        """Whether a request is answered."""
        if action_type_id.Identifier in self._refused:
            return False
        return bool(self._roles.check_validity(user, action_type_id, body))


_FIRST: dict[str, bool | str | float | int | datetime] = {
    "Boolean": False,
    "String": "",
    "Double": 0.0,
    "Int64": 0,
    "UInt32": 0,
    "DateTime": datetime(1970, 1, 1, tzinfo=UTC).replace(tzinfo=None),
}
