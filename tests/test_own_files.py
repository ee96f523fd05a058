"""Files in folders that others have prepared: links are replaced, pipes refused, and no name is looked up twice."""

import os
import socket
import stat
import threading
from pathlib import Path

import pytest

from aadm_workbench import own_files
from aadm_workbench.own_files import (
    UnsafeFileError,
    clear_asides,
    create,
    held,
    is_there,
    open_to_read,
    open_to_write,
    write_atomically,
)


@pytest.fixture(params=["as here", "as on Windows"], autouse=True)
def system(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """Windows knows neither O_NOFOLLOW and O_NONBLOCK nor names in an open folder."""
    if request.param == "as on Windows":
        monkeypatch.setattr(own_files, "_KNOWS_FOLDERS", False)
        monkeypatch.setattr(own_files, "_ALWAYS", 0)
    return str(request.param)


def write(path: Path, text: bytes) -> None:
    with os.fdopen(open_to_write(path), "wb") as stream:
        stream.truncate()
        stream.write(text)


@pytest.fixture
def precious(tmp_path: Path) -> Path:
    path = tmp_path / "elsewhere" / "precious"
    path.parent.mkdir()
    path.write_bytes(b"precious")
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    path = tmp_path / "out"
    path.mkdir()
    return path


def links_to(precious: Path, path: Path) -> list[Path]:
    """Links of every kind that lead to a file, one of them through another, one to what is not there."""
    found = [path.with_name(f"{path.name}-{kind}") for kind in ("symbolic", "chain", "hard", "nowhere")]
    found[0].symlink_to(precious)
    found[1].symlink_to(found[0].name)
    found[2].hardlink_to(precious)
    found[3].symlink_to(precious.with_name("made-by-a-link"))
    return found


def test_links_are_replaced_and_what_they_lead_to_stays(folder: Path, precious: Path) -> None:
    for path in links_to(precious, folder / "file"):
        write(path, b"ours")
        assert path.read_bytes() == b"ours"
        assert stat.S_ISREG(path.lstat().st_mode)
    for path in links_to(precious, folder / "other"):
        write_atomically(path, b"ours")
        assert path.read_bytes() == b"ours"
        assert not path.is_symlink()
    assert precious.read_bytes() == b"precious"
    assert [entry.name for entry in precious.parent.iterdir()] == ["precious"]


def test_nothing_is_read_through_a_link(folder: Path, precious: Path) -> None:
    symbolic, chain, hard, nowhere = links_to(precious, folder / "file")
    for path in (symbolic, chain, nowhere):
        assert not is_there(path)
        with pytest.raises(UnsafeFileError, match="is a link, which is not followed"):
            open_to_read(path)
    # A second name of a file is a file: to read it harms nobody.
    assert is_there(hard)
    os.close(open_to_read(hard))
    with pytest.raises(FileNotFoundError):
        open_to_read(folder / "missing")


def test_pipes_sockets_devices_and_folders_are_refused_without_waiting(folder: Path) -> None:
    os.mkfifo(folder / "pipe")
    (folder / "folder").mkdir()
    places = {folder / "pipe": "a pipe", folder / "folder": "a folder", Path(os.devnull): "a device"}
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(folder / "socket"))
        for path, what in {**places, folder / "socket": "a socket"}.items():
            for opened in (open_to_write, open_to_read):
                with pytest.raises(UnsafeFileError, match=f"it is {what}, not a file; remove it"):
                    opened(path)
            assert not is_there(path)
    assert stat.S_ISFIFO((folder / "pipe").lstat().st_mode)


def test_what_is_held_stays_though_its_name_leads_elsewhere(folder: Path, tmp_path: Path, system: str) -> None:
    """Whoever may write beside the folder puts a link in its place while a check runs; promised on POSIX alone."""
    if system == "as on Windows":
        assert not own_files._held
        return
    victim = tmp_path / "victim"
    victim.mkdir()
    with held(folder):
        write(folder / "before", b"1")
        folder.rename(tmp_path / "moved")
        folder.symlink_to(victim)
        write(folder / "after", b"2")
        write_atomically(folder / "report.json", b"3")
        os.close(create(folder / "new"))
    assert sorted(entry.name for entry in (tmp_path / "moved").iterdir()) == ["after", "before", "new", "report.json"]
    assert list(victim.iterdir()) == []


def test_a_name_that_changes_all_the_time_is_never_written_through(folder: Path, precious: Path) -> None:
    """Links, file, nothing, in turns, as fast as another thread can: the target is never touched."""
    path, stop = folder / "file", threading.Event()

    def juggle() -> None:
        while not stop.is_set():
            linked = (lambda: path.symlink_to(precious), path.unlink, lambda: path.hardlink_to(precious), path.unlink)
            for change in (*linked, path.touch, path.unlink):
                try:
                    change()
                except OSError:
                    continue

    thread = threading.Thread(target=juggle)
    thread.start()
    written = 0
    for _ in range(2000):
        try:
            write(path, b"ours")
            written += 1
        except OSError:
            continue
    stop.set()
    thread.join()
    assert written
    assert precious.read_bytes() == b"precious"


def test_create_takes_nobody_elses_file(folder: Path, precious: Path) -> None:
    for path in links_to(precious, folder / "file"):
        with pytest.raises(OSError, match="exists"):
            create(path)
    descriptor = create(folder / "own.log")
    assert stat.S_IMODE(os.fstat(descriptor).st_mode) == 0o600
    os.close(descriptor)


def test_what_killed_runs_left_is_cleared(folder: Path, precious: Path) -> None:
    left = folder / f".report.json.{'0' * 32}.part"
    left.write_bytes(b"half")
    (folder / f".timing.json.{'f' * 32}.part").symlink_to(precious)
    for name in ("journal.jsonl", "my.part", ".hidden", f".x.{'0' * 31}.part"):
        (folder / name).write_text("kept")
    (folder / ".aadm-freecad-x1").mkdir()
    (folder / ".aadm-freecad-x1" / "a.FCStd").write_bytes(b"half")
    (folder / ".aadm-freecad-link").symlink_to(precious.parent)
    os.mkfifo(folder / ".aadm-freecad-pipe")
    clear_asides(folder)
    kept = {"journal.jsonl", "my.part", ".hidden", f".x.{'0' * 31}.part"}
    assert {entry.name for entry in folder.iterdir()} == kept
    assert precious.read_bytes() == b"precious"
