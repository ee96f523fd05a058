"""LZF, the compression of PCD files, through the C library of that name."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from aadm_workbench.errors import MissingDependencyError

GREATEST_EXPANSION = 88
"""Three bytes, a longest back reference, unpack to 264: no honest stream announces more than 88 times its size."""


def _lzf() -> ModuleType:
    try:
        return import_module("lzf")
    except ImportError as error:
        raise MissingDependencyError("python-neo-lzf", "a compressed PCD file (DATA binary_compressed)") from error


def decompress(packed: bytes, size_bytes: int) -> bytes | None:
    """Return the ``size_bytes`` bytes that an LZF stream unpacks to, or None where it does not unpack to that.

    Raises
    ------
    MissingDependencyError
        Where the LZF library is not installed.
    """
    if size_bytes > GREATEST_EXPANSION * len(packed):
        return None
    try:
        unpacked: bytes | None = _lzf().decompress(packed, size_bytes)
    except ValueError:
        return None
    return unpacked if unpacked is not None and len(unpacked) == size_bytes else None


def compress(content: bytes) -> bytes:
    """Return bytes packed by LZF; what does not shrink grows by one byte in 32.

    Raises
    ------
    MissingDependencyError
        Where the LZF library is not installed.
    """
    longest_bytes = len(content) + len(content) // 16 + 64
    packed: bytes = _lzf().compress(content, longest_bytes)
    return packed
