"""A camera without hardware: features by the reference implementation of GenApi, frames as a test wants them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
from genicam.genapi import NodeMap

HEAD = """<?xml version="1.0" encoding="utf-8"?>
<RegisterDescription ModelName="Twin" VendorName="Test" StandardNameSpace="None" SchemaMajorVersion="1"
 SchemaMinorVersion="1" SchemaSubMinorVersion="0" MajorVersion="1" MinorVersion="0" SubMinorVersion="0"
 ToolTip="" ProductGuid="11111111-2222-3333-4444-555555555555" VersionGuid="11111111-2222-3333-4444-555555555556"
 xmlns="http://www.genicam.org/GenApi/Version_1_1">
"""


def node_map(features: Mapping[str, Any], choices: Mapping[str, Sequence[str]] | None = None) -> NodeMap:
    """Features with values: numbers, texts as enumerations of one or more entries, truths."""
    found = NodeMap()
    nodes = [node(name, value, (choices or {}).get(name, ())) for name, value in features.items()]
    top = "".join(f"<pFeature>{name}</pFeature>" for name in features)
    found.load_xml_from_string(
        f'{HEAD}<Category Name="Root">{top}</Category>{"".join(nodes)}<Port Name="Device"/></RegisterDescription>'
    )
    return found


def node(name: str, value: Any, entries: Sequence[str]) -> str:
    if isinstance(value, bool):
        return f'<Boolean Name="{name}"><Value>{str(value).lower()}</Value></Boolean>'
    if isinstance(value, int):
        return f'<Integer Name="{name}"><Value>{value}</Value></Integer>'
    if isinstance(value, float):
        return f'<Float Name="{name}"><Value>{value!r}</Value></Float>'
    listed = list(dict.fromkeys([value, *entries]))
    inner = "".join(f'<EnumEntry Name="{one}"><Value>{number}</Value></EnumEntry>' for number, one in enumerate(listed))
    return f'<Enumeration Name="{name}">{inner}<Value>0</Value></Enumeration>'


def component(pixel_format: str, width: int, height: int, values: np.ndarray[Any, Any]) -> SimpleNamespace:
    return SimpleNamespace(data_format=pixel_format, width=width, height=height, data=values.reshape(-1))


class Buffer:
    """A buffer that is given back at the end of a ``with``."""

    def __init__(self, components: Sequence[SimpleNamespace]) -> None:
        self.payload = SimpleNamespace(components=components)

    def __enter__(self) -> Buffer:
        return self

    def __exit__(self, *_: object) -> None:
        for one in self.payload.components:
            one.data = one.data.copy()
            one.data[:] = 0  # the producer writes the next frame here


class Acquirer:
    """As harvesters' acquirer: each call of ``frames`` gives a buffer, None (with a loss or without) or an error."""

    Events = SimpleNamespace(INCOMPLETE_BUFFER=1)

    def __init__(self, features: NodeMap, frames: Sequence[Callable[[Acquirer], Buffer | None]]) -> None:
        self.remote_device = SimpleNamespace(node_map=features)
        self._frames, self.callbacks, self.running, self.destroyed = list(frames), [], False, False

    def add_callback(self, event: int, callback: Any) -> None:
        self.callbacks.append(callback)

    def start(self) -> None:
        self.running = True

    def stop(self) -> None:
        self.running = False

    def destroy(self) -> None:
        self.destroyed = True

    def try_fetch(self, *, timeout: float) -> Buffer | None:
        assert self.running
        return self._frames.pop(0)(self)


def lost(acquirer: Acquirer) -> None:
    """Packets are missing: harvesters says so, and gives nothing."""
    for callback in acquirer.callbacks:
        callback.emit(acquirer)


def silent(acquirer: Acquirer) -> None:
    """Nothing comes."""
