"""A controller that reads by another OPC UA stack: open62541, in C, by the package o6; a program of its own.

``opcua_reader.py URL [CERTIFICATE KEY SERVER-CERTIFICATE URI]``. It says ``connected`` or the status that it got
instead; then each line on its standard input is a request, ``read NAME…`` or ``write NAME``, answered by JSON.
"""

import json
import os
import sys

answers = os.fdopen(os.dup(1), "w")
os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # the package prints its own name there

import o6  # noqa: E402


def quality(status) -> str:
    return str(o6.StatusCode(status)).rpartition(".")[2]


def read(client, names: list[str]) -> list[dict]:
    """What one request finds: value, status, and the source's time in ISO 8601."""
    found = client.read([f"ns=2;s=Hoisting.{name}" for name in names], valueOnly=False)
    return [
        {"value": plain(one.value), "status": quality(one.status), "source": str(one.sourceTimestamp)} for one in found
    ]


def plain(value):
    """A number, a text, a truth or None; a time as ISO 8601."""
    value = value.item() if hasattr(value, "item") else value
    return value if isinstance(value, str | bool | int | float | None) else str(value)


def write(client, name: str) -> str:
    try:
        client.write(f"ns=2;s=Hoisting.{name}", False)
    except o6.StatusCodeError as error:
        return quality(error.code)
    return "written"


def say(answer) -> None:
    print(json.dumps(answer), file=answers, flush=True)


def main(url: str, certificate="", key="", server="", uri="") -> None:
    secured = {
        "certificate": certificate,
        "privateKey": key,
        "trustList": [server],
        "securityMode": o6.SecurityMode.SIGN_AND_ENCRYPT,
        "securityPolicy": o6.SecurityPolicy.BASIC256SHA256,
        "applicationUri": uri,
    }
    client = o6.Client(url, **(secured if certificate else {}))
    client.config.timeout = 60_000  # ms; the machine may be busy
    try:
        client.connect()
    except o6.StatusCodeError as error:
        say(quality(error.code))
        return
    assert list(client.read("i=2255"))[2] == "urn:aadm:hoisting:1"
    say("connected")
    for line in sys.stdin:
        word, *names = line.split()
        say(read(client, names) if word == "read" else write(client, *names))
    client.disconnect()


if __name__ == "__main__":
    main(*sys.argv[1:])
