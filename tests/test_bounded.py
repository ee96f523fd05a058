"""Archives and XML of strangers: every bound is kept, by what is declared and by what is there."""

import io
import os
import struct
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from aadm_workbench.bounded import ArchiveBounds, BoundsError, check_xml, entry_bytes, opened_archive, read_bounded

from .fuzz.zips import Entry, written

BOUNDS = ArchiveBounds("box", entries=20, entry_bytes=2**20, all_bytes=2**22)


def packed(how: int = zipfile.ZIP_DEFLATED, **entries: bytes) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", how) as archive:
        for name, held in entries.items():
            archive.writestr(name, held)
    return content.getvalue()


def read(path: Path, bounds: ArchiveBounds = BOUNDS) -> dict[str, bytes]:
    with opened_archive(path, bounds) as archive:
        return {entry.filename: entry_bytes(archive, entry) for entry in archive.infolist()}


def test_what_is_within_bounds_comes_through(tmp_path: Path) -> None:
    entries = {"a": os.urandom(5000), "b/c": b"", "zeros": bytes(2**20)}
    (tmp_path / "a.zip").write_bytes(packed(**entries))
    assert read(tmp_path / "a.zip") == entries


def understated(content: bytes) -> bytes:
    """The same archive, whose list says that an entry has ten bytes."""
    place = content.rindex(b"PK\x01\x02") + 24
    return content[:place] + struct.pack("<L", 10) + content[place + 4 :]


def listed_often(content: bytes) -> bytes:
    """The same archive, whose only entry is listed eighty thousand times: four megabytes of list."""
    begin, end = content.index(b"PK\x01\x02"), content.index(b"PK\x05\x06")
    entries = content[begin:end] * 80_000
    counts = struct.pack("<4s4H2LH", b"PK\x05\x06", 0, 0, 80_000 % 65536, 80_000 % 65536, len(entries), begin, 0)
    return content[:begin] + entries + counts


def with_a_false_end(content: bytes) -> bytes:
    """A long list whose end holds the mark of another end, in its counts of entries."""
    return content[:-14] + b"PK\x05\x06" + content[-10:]


def with_large_list(content: bytes) -> bytes:
    """The same, with the locator that makes readers look for a list of any size elsewhere."""
    end = content.index(b"PK\x05\x06")
    return content[:end] + struct.pack("<4sLQL", b"PK\x06\x07", 0, 0, 1) + content[end:]


def encrypted(content: bytes) -> bytes:
    place = content.rindex(b"PK\x01\x02") + 8
    return content[:place] + b"\x01\x00" + content[place + 2 :]


REFUSED: dict[str, tuple[bytes | Callable[[], bytes], str]] = {
    "too many entries": (packed(**{f"e{k}": b"" for k in range(21)}), "more than a box can hold"),
    "too long a list": (lambda: listed_often(packed(a=b"x")), "more than a box can hold"),
    "two ends": (lambda: with_a_false_end(listed_often(packed(a=b"x"))), "more than a box can hold"),
    "a list elsewhere": (with_large_list(packed(a=b"x")), "more than a box can hold"),
    "too large an entry": (packed(a=os.urandom(2**20 + 1)), "of 1048577 bytes"),
    "too much of all": (packed(**{f"e{k}": bytes(2**20) for k in range(5)}), "would unpack to 5242880"),
    "longer than it says": (understated(packed(a=b"x" * 5000)), "damaged"),
    "encrypted": (encrypted(packed(a=b"x")), "is encrypted"),
    "bzip2": (packed(zipfile.ZIP_BZIP2, a=b"x" * 99), "in a way that no box does"),
    "lzma": (packed(zipfile.ZIP_LZMA, a=b"x" * 99), "in a way that no box does"),
    "leads out": (packed(**{"a/../../b": b"x"}), "leads out of it"),
    "has no name": (written([Entry("", b"x")], {}), "an entry without a name"),
    "leads to a drive": (packed(**{"C:b": b"x"}), "leads out of it"),
    "no archive": (b"ISO-10303-21;", "is no box, or is cut short or damaged"),
    "nothing": (b"", "is no box"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_beyond_them_does_not(tmp_path: Path, name: str) -> None:
    content, why = REFUSED[name]
    (tmp_path / "a.zip").write_bytes(content if isinstance(content, bytes) else content())
    with pytest.raises(BoundsError, match=why):
        read(tmp_path / "a.zip")


def test_small_archives_may_pack_as_they_like_and_large_ones_not(tmp_path: Path) -> None:
    large = ArchiveBounds("box", entries=9, entry_bytes=2**30, all_bytes=2**30)
    (tmp_path / "small.zip").write_bytes(packed(a=bytes(2**26)))
    assert len(read(tmp_path / "small.zip", large)["a"]) == 2**26
    (tmp_path / "large.zip").write_bytes(packed(a=bytes(2**26 + 1)))
    with pytest.raises(BoundsError, match="no box packs like that"):
        read(tmp_path / "large.zip", large)


def test_what_is_no_file_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "endless").symlink_to("/dev/zero")
    (tmp_path / "sparse").touch()
    os.truncate(tmp_path / "sparse", 2**40)
    for name, why in (("pipe", "a pipe"), ("endless", "a device"), ("sparse", "more than 100"), (".", "a folder")):
        with pytest.raises(BoundsError, match=why):
            read_bounded(tmp_path / name, 100)
        with pytest.raises(BoundsError, match=why.replace("100", str(2**22))):
            read(tmp_path / name)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_xml_that_is_meant_to_harm(encoding: str) -> None:
    def check(text: str) -> None:
        check_xml(text.encode(encoding), deepest=5, most_elements=10)

    check("<a><b><c><d><e/></d></c></b></a>")
    for text, why in (
        ("<a><b><c><d><e><f/></e></d></c></b></a>", "more than 5 levels"),
        (f"<a>{'<b/>' * 10}</a>", "or 10 elements"),
        ("<!DOCTYPE a [<!ENTITY x 'y'>]><a>&x;</a>", "its own XML document type"),
        ("<a>", "is no XML"),
        ("<a>&x;</a>", "is no XML"),
    ):
        with pytest.raises(BoundsError, match=why):
            check(text)
