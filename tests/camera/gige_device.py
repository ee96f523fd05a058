"""A GigE Vision camera on loopback: Aravis' simulator, serving a frame and a description that a test gives it.

As a program, so that it can vanish: ``gige_device.py FRAME.npy DESCRIPTION.xml FORMAT WIDTH HEIGHT [FAULT]``. It says
``ready`` once it listens, and lives until its standard input ends. Faults: ``lossy`` drops half of all packets,
``vanishes`` sends one frame whole and dies in the middle of the next.
"""

from __future__ import annotations

import ctypes
import fcntl
import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from ctypes import c_char_p, c_int, c_size_t, c_uint32, c_void_p
from pathlib import Path
from typing import Any

import numpy as np

ADDRESS = "gige://127.0.0.1"
FORMATS = {"Coord3D_C16": 0x011000B8, "Coord3D_ABC32f": 0x026000C0}  # GigE Vision's PFNC 2.4
WIDTH, HEIGHT, START, FORMAT = 0x100, 0x104, 0x124, 0x128  # registers of the simulator
PAYLOAD = (
    '<IntSwissKnife Name="PayloadSize"><pVariable Name="W">Width</pVariable><pVariable Name="H">Height</pVariable>'
    '<pVariable Name="F">FormatRegister</pVariable><Formula>W*H*((F&gt;&gt;16)&amp;0xFF)/8</Formula>'
    "</IntSwissKnife>"
)


def aravis() -> Any:
    found = ctypes.CDLL("libaravis-0.8.so.0")
    for name in ("arv_gv_fake_camera_new_full", "arv_gv_fake_camera_get_fake_camera", "arv_buffer_get_data"):
        getattr(found, name).restype = c_void_p
    return found


def has_aravis() -> bool:
    try:
        aravis()
    except OSError:
        return False
    return True


def description(features: Mapping[str, Any], pixel_format: str) -> str:
    """What such a camera says of itself: registers that are there, and features that never change."""
    from .device import HEAD, node

    def register(name: str, address: int, mode: str = "RW") -> str:
        return (
            f'<IntReg Name="{name}"><Address>{address}</Address><Length>4</Length><AccessMode>{mode}</AccessMode>'
            "<pPort>Device</pPort><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess></IntReg>"
        )

    entries = f'<EnumEntry Name="{pixel_format}"><Value>{FORMATS[pixel_format]}</Value></EnumEntry>'
    nodes = [
        *(node(name, value, ()) for name, value in features.items()),
        register("Width", WIDTH),
        register("Height", HEIGHT),
        register("StartRegister", START, "WO"),
        register("FormatRegister", FORMAT),
        f'<Enumeration Name="PixelFormat">{entries}<pValue>FormatRegister</pValue></Enumeration>',
        PAYLOAD,
        *(
            f'<Command Name="Acquisition{what}"><pValue>StartRegister</pValue><CommandValue>{value}</CommandValue>'
            "</Command>"
            for what, value in (("Start", 1), ("Stop", 0))
        ),
    ]
    names = [*features, "Width", "Height", "PixelFormat", "PayloadSize", "AcquisitionStart", "AcquisitionStop"]
    top = "".join(f"<pFeature>{name}</pFeature>" for name in names)
    return f'{HEAD}<Category Name="Root">{top}</Category>{"".join(nodes)}<Port Name="Device"/></RegisterDescription>'


@contextmanager
def served(folder: Path, values: Any, features: Mapping[str, Any], pixel_format: str, fault: str = "") -> Iterator[Any]:
    """The process of a camera; one at a time on a machine, for GigE Vision has one port."""
    folder.mkdir(exist_ok=True)
    np.save(folder / "frame.npy", values)
    (folder / "camera.xml").write_text(description(features, pixel_format), encoding="utf-8")
    height, width = values.shape[:2]
    words = [str(folder / "frame.npy"), str(folder / "camera.xml"), pixel_format, str(width), str(height), fault]
    with (Path(tempfile.gettempdir()) / "aadm-tests-gige.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        program = subprocess.Popen(
            [sys.executable, __file__, *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        try:
            assert program.stdout.readline() == "ready\n"
            yield program
        finally:
            program.kill()
            program.communicate()


def main(frame: str, xml: str, pixel_format: str, width: str, height: str, fault: str) -> None:
    arv = aravis()
    content = np.load(frame).tobytes()
    device = c_void_p(arv.arv_gv_fake_camera_new_full(b"127.0.0.1", b"TWIN-1", c_char_p(xml.encode())))
    camera = c_void_p(arv.arv_gv_fake_camera_get_fake_camera(device))
    arv.g_object_set.argtypes = [c_void_p, c_char_p, ctypes.c_double, c_void_p]
    sent = 0

    def lose(share: float) -> None:
        arv.g_object_set(device, b"gvsp-lost-ratio", share, None)

    @ctypes.CFUNCTYPE(None, c_void_p, c_void_p, c_uint32, c_uint32, c_uint32)
    def fill(buffer: int, *_: Any) -> None:
        nonlocal sent
        sent += 1
        ctypes.memmove(arv.arv_buffer_get_data(c_void_p(buffer), ctypes.byref(c_size_t())), content, len(content))
        if fault == "vanishes" and sent == 2:
            lose(0.5)  # whole it is never
            threading.Timer(0.02, os._exit, (0,)).start()

    arv.arv_fake_camera_set_fill_pattern(camera, fill, None)
    if fault == "lossy":
        lose(0.5)
    values = {FORMAT: FORMATS[pixel_format], WIDTH: int(width), HEIGHT: int(height)}
    for register, value in values.items():
        arv.arv_fake_camera_write_register(camera, register, value)
    assert arv.arv_gv_fake_camera_is_running(device) == c_int(1).value
    print("ready", flush=True)
    sys.stdin.read()


if __name__ == "__main__":
    main(*sys.argv[1:])
