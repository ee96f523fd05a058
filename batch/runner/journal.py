"""The journal of a check: each column's result, on the disk as soon as it is there.

DIR/journal.jsonl holds one line of JSON for each column that was begun (``{"began": ID}``) and for each that was
finished (a :class:`~.record.Record`), and a last one that says of which report it is. Lines are only added, by one
process, each in one write; what a killed process leaves at the end, half a line, is cut off by the next. After a
power failure the last second may be missing, and is checked again.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from time import monotonic
from types import MappingProxyType

from aadm_workbench.errors import AadmError
from aadm_workbench.own_files import UnsafeFileError, looked_up, open_to_read, open_to_write, write_atomically

from .record import Record, read_record

NAME = "journal.jsonl"
PREVIOUS_NAME = "journal.previous.jsonl"
_FIRST_LINE = b'{"aadm_journal":2}\n'
_FINISHED = b'{"finished":'
_STOPPED_LINE = b'{"stopped":true}\n'
_SECONDS_BETWEEN_FLUSHES = 1.0  # so much work is lost at most in a power failure
_LONGEST_LAST_BYTES = 4096  # of the line that ends a journal: two hashes and some numbers
_PIECE_BYTES = 2**20  # bounds the memory, not the time

LONGEST_LINE_BYTES = 2**26
"""A column takes 50 KB, one with a hundred hoisting frames 2 MB; a longer line is none of this program."""

MOST_LINES = 2_000_000
"""Two thousand columns, begun and finished in five hundred runs."""


class Journal:
    """The journal in a folder, open for writing; the folder is to be locked before.

    Parameters
    ----------
    folder
        Where reports go.
    resume
        Whether to go on with what an earlier run left there; otherwise it begins anew, and what a run left that was
        not finished is kept as ``journal.previous.jsonl``: a night's work is not lost to a forgotten ``--resume``.

    Raises
    ------
    AadmError
        Where it cannot be read or written.
    """

    def __init__(self, folder: Path, *, resume: bool) -> None:
        self.path = folder / NAME
        self._places: dict[str, tuple[int, int]] = {}
        self._keys: dict[str, str] = {}
        self._seen: dict[str, str] = {}
        self._begun: set[str] = set()
        self.finished = ""
        self.put_aside = False
        try:
            if resume:
                self._separate()
            else:
                self._put_aside()
            self._file = open_to_write(self.path)
            self._end = self._sound_end() if resume else 0
            os.ftruncate(self._file, self._end)
        except OSError as error:
            raise self._wrong(error) from error
        self._flushed = monotonic()
        if self._end == 0:
            self._append(_FIRST_LINE)
            self.flush()

    @property
    def keys(self) -> dict[str, str]:
        """The key of each column whose result is there and may be used again."""
        return {name: key for name, key in self._keys.items() if key}

    def seen(self, name: str) -> str:
        """What the files of a column looked like when the result that was kept was made from them; empty for none."""
        return self._seen.get(name, "")

    @property
    def now_ns(self) -> int:
        """When a line was added last, by the clock of the file system."""
        try:
            return os.fstat(self._file).st_mtime_ns
        except OSError as error:
            raise self._wrong(error) from error

    @property
    def interrupted(self) -> set[str]:
        """Columns that an earlier run began and never finished: one of them may be why it died."""
        return self._begun - self._places.keys()

    def began(self, name: str) -> None:
        """Note that a column is being checked."""
        self._append(json.dumps({"began": name}).encode() + b"\n")

    def add(self, record: Record) -> None:
        """Keep a result.

        Raises
        ------
        AadmError
            Where the disk takes no more. What was kept before is whole.
        """
        line = record.line()
        self._note(record, self._end, len(line))
        self._append(line)
        if monotonic() - self._flushed > _SECONDS_BETWEEN_FLUSHES:
            self.flush()

    def record(self, name: str) -> Record:
        """The result of a column that was kept last.

        Raises
        ------
        AadmError
            Where it is no longer there.
        """
        place, size = self._places[name]
        try:
            os.lseek(self._file, place, os.SEEK_SET)
            line = b""
            while len(line) < size and (more := os.read(self._file, size - len(line))):
                line += more
        except OSError as error:
            raise self._wrong(error) from error
        record = read_record(line)
        if record is None:
            raise AadmError.because("run.journal_changed", file=self.path)
        return record

    def finish(self, what: str = "") -> None:
        """Note that every column was checked and the report is written; ``what`` is read back as ``finished``."""
        self._append(_FINISHED + json.dumps(what).encode() + b"}\n")
        self.flush()

    def stop(self) -> None:
        """Note that the check ends before its end, but on request or for a reason that was said: by no column."""
        with suppress(AadmError):
            self._append(_STOPPED_LINE)

    def flush(self) -> None:
        """Bring everything to the disk itself."""
        try:
            os.fsync(self._file)
        except OSError as error:
            raise self._wrong(error) from error
        self._flushed = monotonic()

    def close(self) -> None:
        """Bring everything to the disk, and let go of the file."""
        with suppress(AadmError):
            self.flush()
        os.close(self._file)

    def _append(self, line: bytes) -> None:
        try:
            os.lseek(self._file, self._end, os.SEEK_SET)
            written = os.write(self._file, line)
            while written < len(line):
                written += os.write(self._file, line[written:])
        except OSError as error:
            # Half a line would be cut off by the next run anyway; this one may still be read from.
            with suppress(OSError):
                os.ftruncate(self._file, self._end)
            raise self._wrong(error) from error
        self._end += len(line)

    def _put_aside(self) -> None:
        # A link is no journal of ours: it is replaced.
        with suppress(FileNotFoundError, UnsafeFileError), open(open_to_read(self.path), "rb") as stream:  # noqa: PTH123
            size = os.fstat(stream.fileno()).st_size
            stream.seek(max(0, size - _LONGEST_LAST_BYTES))
            last = stream.read(_LONGEST_LAST_BYTES).rstrip(b"\n").rpartition(b"\n")[2]
            if not last.startswith(_FINISHED) and size > len(_FIRST_LINE):
                with looked_up(self.path) as (name, folder):
                    previous = Path(name).with_name(PREVIOUS_NAME)
                    os.replace(name, previous, src_dir_fd=folder, dst_dir_fd=folder)
                self.put_aside = True

    def _separate(self) -> None:
        """Give a journal that has a second name elsewhere (a hard link) a file of its own, as it is."""
        with suppress(FileNotFoundError), open(open_to_read(self.path), "rb") as stream:  # noqa: PTH123
            if os.fstat(stream.fileno()).st_nlink > 1:
                write_atomically(self.path, iter(partial(stream.read, _PIECE_BYTES), b""))

    def _sound_end(self) -> int:
        """Read what is there; returns where the last whole line ends."""
        with open(self._file, "rb", closefd=False) as stream:
            if stream.readline(len(_FIRST_LINE)) != _FIRST_LINE:
                return 0
            end = len(_FIRST_LINE)
            for _ in range(MOST_LINES):
                line = stream.readline(LONGEST_LINE_BYTES)
                if not line.endswith(b"\n"):
                    return end
                self._read_line(line, end)
                end += len(line)
        raise AadmError.because("run.journal_long", file=self.path, most=MOST_LINES)

    def _read_line(self, line: bytes, place: int) -> None:
        self.finished = ""
        record = read_record(line)
        if record is not None:
            self._note(record, place, len(line))
            return
        if line == _STOPPED_LINE:
            self._begun.clear()
            return
        # A line in the middle that is damaged costs its own column only: it is checked again.
        with suppress(ValueError, RecursionError):
            began = json.loads(line)
            if isinstance(began, dict) and isinstance(began.get("began"), str):
                self._begun.add(began["began"])
            elif isinstance(began, dict) and isinstance(began.get("finished"), str):
                self.finished = began["finished"]

    def _note(self, record: Record, place: int, size: int) -> None:
        self._places[record.id] = (place, size)
        self._keys[record.id] = record.key
        self._seen[record.id] = record.seen

    def _wrong(self, error: OSError) -> AadmError:
        if isinstance(error, UnsafeFileError):
            return AadmError.because("run.journal_refused", file=self.path, why=error.strerror)
        reason = error.strerror or type(error).__name__
        return AadmError.because("run.journal_full", file=self.path, why=reason)


class Unkept:
    """Results of a check that keeps no journal: they live as long as the check."""

    keys: Mapping[str, str] = MappingProxyType({})
    interrupted: frozenset[str] = frozenset()
    finished = ""
    now_ns = 0

    def __init__(self) -> None:
        self._records: dict[str, Record] = {}

    def began(self, name: str) -> None:
        """Nothing is noted."""

    def add(self, record: Record) -> None:
        """Keep a result."""
        self._records[record.id] = record

    def seen(self, name: str) -> str:
        """Nothing: what was kept is of this very run."""
        return ""

    def record(self, name: str) -> Record:
        """The result of a column."""
        return self._records[name]
