"""Addresses of cameras in a network, ``SCHEME://IP``."""

from __future__ import annotations

from ipaddress import AddressValueError, IPv4Address

from aadm_workbench.camera.frame import Device
from aadm_workbench.errors import CameraError, CameraGoneError
from aadm_workbench.model.reason import said_of


def ip_of(address: str, needed: bool = True) -> str:
    """Return the IP of an address; empty where none is given and none is ``needed``.

    Raises
    ------
    CameraError
        For what is no IPv4 address, which is all that GigE Vision knows.
    """
    scheme, _, rest = address.partition(":")
    ip = rest.removeprefix("//").removesuffix("/")
    if not ip and not needed:
        return ""
    try:
        return str(IPv4Address(ip))
    except AddressValueError as error:
        form, example = f"{scheme}://IP", f"{scheme}://192.168.1.20"
        raise CameraError(said_of(address, "camera.no_ip", form=form, example=example)) from error


def asked_for(address: str, ip: str, found: list[Device]) -> list[Device]:
    """Return those of the devices that an address asks for: the one at its IP, all where it names none.

    Raises
    ------
    CameraGoneError
        Where none of them is at that IP.
    """
    if not ip:
        return found
    meant = [one for one in found if one.address == f"{address.partition(':')[0]}://{ip}"]
    if not meant:
        raise CameraGoneError(said_of(address, "camera.not_there"))
    return meant
