"""Aravis (libaravis-0.8, LGPL) by ctypes: which GigE Vision cameras there are, their registers, and their buffers.

Nothing is understood here: features are read from registers by the reference implementation of GenApi
(:mod:`aadm_workbench.camera.gige`), so that they mean the same whatever carries them. ctypes, because the binding by
GObject introspection belongs to the Python of the system alone, and no wheel of it is kept up.
"""

from __future__ import annotations

import ctypes
import ctypes.util
from collections.abc import Sequence
from ctypes import POINTER, byref, c_char_p, c_int, c_size_t, c_uint, c_uint32, c_uint64, c_void_p
from dataclasses import dataclass
from functools import cache
from typing import Any

from aadm_workbench.errors import MissingDependencyError

LOST = frozenset({2, 3, 4})  # ArvBufferStatus: TIMEOUT, MISSING_PACKETS, WRONG_PACKET_ID
WHOLE = 0  # SUCCESS

_NAMES = ("libaravis-0.8.so.0", "libaravis-0.8.0.dylib")
_INSTALL = "apt install libaravis-0.8-0"
_OTHER_INTERFACE = b"USB3Vision"  # it would be asked at each look for GigE cameras
_VERSION_REGISTER = 0  # of the bootstrap registers, GigE Vision 2.0: there on every camera


class TransportError(Exception):
    """A camera did not answer, or said no; the text is what Aravis says of it."""


class _GError(ctypes.Structure):
    _fields_ = (("domain", c_uint32), ("code", c_int), ("message", c_char_p))


_FUNCTIONS: dict[str, tuple[Any, Sequence[Any]]] = {
    "arv_disable_interface": (None, (c_char_p,)),
    "arv_update_device_list": (None, ()),
    "arv_get_n_devices": (c_uint, ()),
    "arv_get_device_address": (c_char_p, (c_uint,)),
    "arv_get_device_vendor": (c_char_p, (c_uint,)),
    "arv_get_device_model": (c_char_p, (c_uint,)),
    "arv_get_device_serial_nbr": (c_char_p, (c_uint,)),
    "arv_open_device": (c_void_p, (c_char_p, c_void_p)),
    "arv_device_get_genicam_xml": (c_void_p, (c_void_p, POINTER(c_size_t))),
    "arv_device_read_memory": (c_int, (c_void_p, c_uint64, c_uint32, c_void_p, c_void_p)),
    "arv_device_write_memory": (c_int, (c_void_p, c_uint64, c_uint32, c_void_p, c_void_p)),
    "arv_device_create_stream": (c_void_p, (c_void_p, c_void_p, c_void_p, c_void_p)),
    "arv_buffer_new_allocate": (c_void_p, (c_size_t,)),
    "arv_stream_push_buffer": (None, (c_void_p, c_void_p)),
    "arv_stream_timeout_pop_buffer": (c_void_p, (c_void_p, c_uint64)),
    "arv_buffer_get_status": (c_int, (c_void_p,)),
    "arv_buffer_has_chunks": (c_int, (c_void_p,)),
    "arv_buffer_get_data": (c_void_p, (c_void_p, POINTER(c_size_t))),
    "arv_buffer_get_n_parts": (c_uint, (c_void_p,)),
    "arv_buffer_get_part_data": (c_void_p, (c_void_p, c_uint, POINTER(c_size_t))),
    "arv_buffer_get_part_pixel_format": (c_uint32, (c_void_p, c_uint)),
    "arv_buffer_get_part_width": (c_int, (c_void_p, c_uint)),
    "arv_buffer_get_part_height": (c_int, (c_void_p, c_uint)),
    "g_object_unref": (None, (c_void_p,)),
    "g_error_free": (None, (c_void_p,)),
}
"""What is called: results and arguments as the library declares them. GLib's are found through Aravis."""


@cache
def library(needed_for: str) -> Any:
    """Return the library, its functions declared.

    Raises
    ------
    MissingDependencyError
        Where it is not installed.
    """
    for name in (*_NAMES, ctypes.util.find_library("aravis-0.8")):
        try:
            found = ctypes.CDLL(name) if name else None
        except OSError:
            continue
        if found is not None:
            for function, (result, arguments) in _FUNCTIONS.items():
                getattr(found, function).restype, getattr(found, function).argtypes = result, arguments
            found.arv_disable_interface(_OTHER_INTERFACE)
            return found
    raise MissingDependencyError("libaravis", needed_for, _INSTALL)


@dataclass(frozen=True)
class Found:
    """A camera that answers in one of this machine's networks."""

    address: str
    vendor: str
    model: str
    serial: str


@dataclass(frozen=True)
class RawPart:
    """One part of a buffer: its pixel format by the number of the PFNC, and its bytes."""

    format: int
    width: int
    height: int
    content: bytes


@dataclass(frozen=True)
class RawBuffer:
    """A buffer: its state, its parts, and all its bytes where chunks lie behind them."""

    status: int
    parts: tuple[RawPart, ...] = ()
    with_chunks: bytes = b""


def cameras(address: str) -> list[Found]:
    """Return the cameras that answer a broadcast, which takes a second; ``address`` is what asks for them."""
    arv = library(address)
    arv.arv_update_device_list()
    asked = (arv.arv_get_device_address, arv.arv_get_device_vendor, arv.arv_get_device_model)
    return [
        Found(*(_text(ask(place)) for ask in (*asked, arv.arv_get_device_serial_nbr)))
        for place in range(arv.arv_get_n_devices())
    ]


class Connection:
    """A camera that this program controls, until it is closed.

    Raises
    ------
    TransportError
        Where the camera is not there, or another program controls it.
    """

    def __init__(self, address: str, ip: str) -> None:
        self._arv = library(address)
        with _Checked(self._arv) as failed:
            self._device = self._arv.arv_open_device(ip.encode(), failed)
        if not self._device:
            raise TransportError(ip)

    def xml(self) -> str:
        """Return the description of its features."""
        size = c_size_t()
        content = self._arv.arv_device_get_genicam_xml(self._device, byref(size))
        return ctypes.string_at(content, size.value).decode("utf-8", "replace") if content else ""

    def read(self, address: int, length: int) -> bytes:
        """Return ``length`` bytes of its registers."""
        content = ctypes.create_string_buffer(length)
        with _Checked(self._arv) as failed:
            self._arv.arv_device_read_memory(self._device, address, length, content, failed)
        return content.raw

    def write(self, address: int, content: bytes) -> None:
        """Write bytes to its registers."""
        with _Checked(self._arv) as failed:
            self._arv.arv_device_write_memory(self._device, address, len(content), content, failed)

    def answers(self) -> bool:
        """Whether the camera is there; one that is not takes some seconds to be sure of."""
        try:
            self.read(_VERSION_REGISTER, 4)
        except TransportError:
            return False
        return True

    def stream(self, largest_bytes: int) -> Stream:
        """Return a stream with a place for one buffer."""
        with _Checked(self._arv) as failed:
            stream = self._arv.arv_device_create_stream(self._device, None, None, failed)
        return Stream(self._arv, stream, largest_bytes)

    def close(self) -> None:
        """Give up control; once more does no harm."""
        device, self._device = self._device, None
        if device:
            self._arv.g_object_unref(device)


class Stream:
    """Takes one buffer off the network, and is closed: nothing of an earlier frame can wait in it."""

    def __init__(self, arv: Any, stream: int, largest_bytes: int) -> None:
        self._arv, self._stream = arv, stream
        arv.arv_stream_push_buffer(stream, arv.arv_buffer_new_allocate(largest_bytes))

    def buffer(self, within_s: float) -> RawBuffer | None:
        """Wait for the buffer and return it, with bytes of its own; None where none came."""
        arv = self._arv
        buffer = arv.arv_stream_timeout_pop_buffer(self._stream, round(within_s * 1e6))
        if not buffer:
            return None
        try:
            status = arv.arv_buffer_get_status(buffer)
            if status != WHOLE:
                return RawBuffer(status)
            size = c_size_t()
            start = arv.arv_buffer_get_data(buffer, byref(size))
            kept = ctypes.string_at(start, size.value) if arv.arv_buffer_has_chunks(buffer) else b""
            return RawBuffer(status, tuple(map(self._part(buffer), range(arv.arv_buffer_get_n_parts(buffer)))), kept)
        finally:
            arv.g_object_unref(buffer)

    def _part(self, buffer: int) -> Any:
        arv = self._arv

        def part(place: int) -> RawPart:
            size = c_size_t()
            start = arv.arv_buffer_get_part_data(buffer, place, byref(size))
            return RawPart(
                arv.arv_buffer_get_part_pixel_format(buffer, place),
                arv.arv_buffer_get_part_width(buffer, place),
                arv.arv_buffer_get_part_height(buffer, place),
                ctypes.string_at(start, size.value),
            )

        return part

    def close(self) -> None:
        """Stop listening; once more does no harm."""
        stream, self._stream = self._stream, 0
        if stream:
            self._arv.g_object_unref(stream)


class _Checked:
    """The place for an error of a call, which is raised at the end of the ``with``."""

    def __init__(self, arv: Any) -> None:
        self._arv, self._error = arv, POINTER(_GError)()

    def __enter__(self) -> Any:
        return byref(self._error)

    def __exit__(self, *_: object) -> None:
        if ctypes.cast(self._error, c_void_p).value is not None:
            said = _text(self._error.contents.message)
            self._arv.g_error_free(self._error)
            raise TransportError(said)


def _text(said: bytes | None) -> str:
    return (said or b"").decode("utf-8", "replace")
