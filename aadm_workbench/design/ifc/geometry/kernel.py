"""The geometry kernel of ifcopenshell in a process of its own: it may crash over a solid, and no more is lost."""

from __future__ import annotations

import faulthandler
import os
import signal
import socket
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from aadm_workbench.design.ifc.geometry.placement import UnreadableGeometryError
from aadm_workbench.model import Array, IntArray, Reason

_LONGEST_S = 20.0
"""For one solid; the largest exact B-reps of real models take a second or two."""

_MOST_HANGS = 3
"""So many solids of a model to which there is no end: after them none is waited for any more."""

_HEAD = struct.Struct("<qq")
_FAILED = -1  # no process ends with it
_PIECE_BYTES = 2**20  # bounds the memory, not the time

Drawn = tuple[Array, IntArray]
"""Vertices (n, 3) mm and corners (m, 3) of triangles."""


class Kernel:
    """Facets solids of a file in a process that begins with the first of them, and again after each crash.

    Where processes cannot be forked (Windows) the kernel runs in this one.
    """

    def __init__(self) -> None:
        self._process = 0
        self._line: socket.socket | None = None
        self._hangs = 0

    def facets(self, item: Any) -> Drawn:
        """The facets of a representation item, in its own frame.

        Raises
        ------
        UnreadableGeometryError
            Where the kernel cannot draw it, crashes over it or comes to no end.
        """
        if not hasattr(os, "fork"):
            return _facets(item)
        if self._hangs >= _MOST_HANGS:
            raise UnreadableGeometryError(Reason("geometry.not_tried", id=item.id(), type=item.is_a()))
        line = self._line or self._start(item.file)
        try:
            line.sendall(_HEAD.pack(item.id(), 0))
            found = _answer(line)
        except (EOFError, OSError) as error:
            self.close()
            hangs = isinstance(error, TimeoutError)
            self._hangs += hangs
            code = "geometry.no_end" if hangs else "geometry.no_evaluation"
            raise UnreadableGeometryError(Reason(code, id=item.id(), type=item.is_a())) from error
        if found is None:
            raise UnreadableGeometryError(Reason("geometry.no_evaluation", id=item.id(), type=item.is_a()))
        return found

    def close(self) -> None:
        """End the process, where there is one."""
        if self._line is not None:
            self._line.close()
            self._line = None
            os.kill(self._process, signal.SIGKILL)
            os.waitpid(self._process, 0)

    def _start(self, file: Any) -> socket.socket:
        ours, theirs = socket.socketpair()
        self._process = os.fork()
        if self._process == 0:
            try:
                ours.close()
                _serve(file, theirs)
            finally:
                os._exit(0)  # nothing of the process that this is a copy of may be ended here
        theirs.close()
        ours.settimeout(_LONGEST_S)
        self._line = ours
        return ours


@contextmanager
def closing_kernel(kernel: Kernel) -> Iterator[None]:
    """End a kernel's process when a model is read."""
    try:
        yield
    finally:
        kernel.close()


def _serve(file: Any, line: socket.socket) -> None:
    faulthandler.disable()  # a crash is answered by the other side
    while True:
        try:
            number, _ = _HEAD.unpack(_received(line, _HEAD.size))
        except EOFError:
            return
        try:
            vertices, corners = _facets(file.by_id(number))
            line.sendall(_HEAD.pack(len(vertices), len(corners)) + vertices.tobytes() + corners.tobytes())
        except UnreadableGeometryError:
            line.sendall(_HEAD.pack(_FAILED, 0))


def _answer(line: socket.socket) -> Drawn | None:
    vertices, corners = _HEAD.unpack(_received(line, _HEAD.size))
    if vertices == _FAILED:
        return None
    points = np.frombuffer(_received(line, 24 * vertices), dtype=np.float64).reshape(-1, 3)
    return points, np.frombuffer(_received(line, 24 * corners), dtype=np.int64).reshape(-1, 3)


def _received(line: socket.socket, size: int) -> bytes:
    content = bytearray()
    while len(content) < size:
        piece = line.recv(min(size - len(content), _PIECE_BYTES))
        if not piece:
            raise EOFError
        content += piece
    return bytes(content)


def _facets(item: Any) -> Drawn:
    import ifcopenshell.geom

    kernel: Any = ifcopenshell.geom
    try:
        drawn = kernel.create_shape(kernel.settings(), item)
    except (RuntimeError, TypeError, ValueError, AttributeError) as error:
        raise UnreadableGeometryError(Reason("geometry.no_evaluation", id=item.id(), type=item.is_a())) from error
    vertices = 1000.0 * np.array(drawn.verts, dtype=np.float64).reshape(-1, 3)
    return vertices, np.array(drawn.faces, dtype=np.int64).reshape(-1, 3)
