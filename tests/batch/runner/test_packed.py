"""What is packed comes back to the last sign, and what others have made for it does no harm."""

import base64
import json
import zlib

import numpy as np
import pytest

from batch.runner.packed import LONGEST_TEXT_BYTES, in_signs, pack, unpack


def deflated(content: bytes) -> str:
    """A part of a packed text, without the words that reports have in common."""
    return base64.b85encode(zlib.compress(content)).decode()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{}",
        # Lengths, angles, directions: each is kept as so many units, and those that are no shortest text as they stand.
        "[0.0001,-0.0001,-0.0,-0.00,1234.5678,429496.7295,429496.7296,-214748.3648,-214748.3649,0.1234567,12.3450]",
        "[180.123456,-0.987654321,0.123456789012,0.0012345678901,1e-05,1.25e-07,9007199254740.993,2147483647.123456]",
        json.dumps({"a": [0.1, 1 / 3, -2e-300, 5e-324, 1e16, 123456789.123456789, 0, -0.0, 1e22]}),
        # What looks like a number and is none, or is another one: a digit too many, a zero behind the last.
        '"1.2345678900" 1.234567890123456789 -0.00000000000 12.3456789012e5 "9.87654321098-1.23456789012"',
        json.dumps('层 \x01 \udc80 \\ " \n'),
        "层 \udc80",
    ],
)
def test_texts_come_back(text: str) -> None:
    packed = pack(text)
    assert packed.isascii()
    assert not set('"\\') & set(packed)
    assert unpack(packed) == text


@pytest.mark.parametrize("count", [0, 1, 2, 3, 4, 5, 8, 1001])
def test_bytes_are_written_as_the_standard_library_does(count: int) -> None:
    content = np.random.default_rng(count).integers(0, 256, count, dtype=np.uint8).tobytes()
    for bytes_of in (content, bytes(count), b"\xff" * count):
        assert in_signs(bytes_of) == base64.b85encode(bytes_of).decode()


def test_numbers_come_back_bit_by_bit() -> None:
    rng = np.random.default_rng(11)
    bits = rng.integers(0, 2**63, 5000, dtype=np.uint64) | rng.integers(0, 2, 5000, dtype=np.uint64) << np.uint64(63)
    values = bits.view(np.float64)
    values = np.concatenate([values[np.isfinite(values)], rng.normal(0.0, 300.0, 5000)])
    again = json.loads(unpack(pack(json.dumps(values.tolist()))))
    assert np.array_equal(np.array(again).view(np.uint64), values.view(np.uint64))


def test_what_was_not_packed_here_is_refused() -> None:
    words, numbers = pack("[0.123456789012, 2]").split(" ")
    assert unpack(f"{words} {numbers}") == "[0.123456789012, 2]"
    far_too_long = deflated(bytes(LONGEST_TEXT_BYTES + 1))
    for broken in (
        "",
        words,
        f"{words} ",
        f"{words[:-5]} {numbers}",
        f"{words} {numbers} {numbers}",
        f"{words} {deflated(b'')}",
        f"{words} {deflated(bytes(16))}",
        f"{words} {deflated(bytes(7))}",
        f"{words} {far_too_long}",
        f"{far_too_long} {numbers}",
        '" \\',
    ):
        with pytest.raises(ValueError, match=r"."):
            unpack(broken)
