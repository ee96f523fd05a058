"""Show the hoisting state to machines, read only: OPC UA, Modbus TCP, MQTT. It is never a command.

STATE is the file that aadm watch keeps. What may not be acted upon now (too old, swinging, not measured) has bad
quality and no number; READY is withdrawn before new values are shown and given after. Servers listen on this machine
alone unless --host says otherwise. This is no safety function: hold-to-run and limits of speed belong to the crane's
own safety controller. Ends with Ctrl-C, or after --seconds.
"""

from __future__ import annotations

import argparse
import asyncio
from pathlib import Path
from typing import TYPE_CHECKING

from ..switches import ALL_PASS, add_switches, length, port

if TYPE_CHECKING:
    from ..link.publish import Link

EXAMPLE = """\
examples:
  aadm link frames/aadm-state.json --opcua 4840
  aadm link frames/aadm-state.json --opcua 4840 --host 0.0.0.0 --certificates certificates
  aadm link frames/aadm-state.json --modbus 5020 --mqtt broker.site:1883"""
LOOPBACK = "127.0.0.1"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("state", type=Path, metavar="STATE", help="the state file of aadm watch")
    parser.add_argument("--opcua", type=port, metavar="PORT", help="serve OPC UA on this port (usual: 4840)")
    parser.add_argument("--modbus", type=port, metavar="PORT", help="serve Modbus TCP on this port (usual: 502)")
    parser.add_argument("--mqtt", metavar="BROKER", help="publish to this MQTT broker, HOST or HOST:PORT")
    parser.add_argument(
        "--host", default=LOOPBACK, metavar="ADDRESS", help=f"address to listen on (default: {LOOPBACK}, this machine)"
    )
    parser.add_argument(
        "--certificates",
        type=Path,
        metavar="DIR",
        help="OPC UA: encrypted, for clients with a certificate in DIR/trusted alone; MQTT: TLS by DIR/ca.pem",
    )
    parser.add_argument("--seconds", type=length, metavar="S", help="end after this time")
    add_switches(parser, prints_json="what was shown last")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Serve until the time is over, or somebody ends it."""
    from ..link.publish import publish
    from ..shown.terminal import say, show_json

    links, quiet = _links(options), options.quiet or options.json
    shown = asyncio.run(publish(options.state, links, (lambda line: None) if quiet else say, options.seconds))
    if options.json:
        from aadm_workbench.report.json import encode

        show_json(encode(shown))
    return ALL_PASS


def _links(options: argparse.Namespace) -> list[Link]:
    from aadm_workbench.errors import JobError

    from ..link.certificates import Certificates
    from ..link.modbus import ModbusLink
    from ..link.mqtt import MqttLink
    from ..link.opcua import OpcUaLink

    if options.opcua and options.host != LOOPBACK and options.certificates is None:
        raise JobError.because("command.opcua_open")
    links: list[Link] = []
    if options.opcua:
        own = None if options.certificates is None else Certificates(options.certificates)
        links.append(OpcUaLink(options.host, options.opcua, own))
    if options.modbus:
        links.append(ModbusLink(options.host, options.modbus))
    if options.mqtt:
        links.append(MqttLink(options.mqtt, options.certificates))
    if not links:
        raise JobError.because("command.link_to_nothing")
    return links
