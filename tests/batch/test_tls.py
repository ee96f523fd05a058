"""A cluster with certificates: the same report with the right one, and an end at once with any other."""

import os
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from batch.main import main
from benchmarks.faults import address_in

from .certificates import write_certificates
from .conftest import WriteJob, column_text


@pytest.fixture(scope="module")
def pem(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    return write_certificates(tmp_path_factory.mktemp("pem"))


@pytest.fixture(scope="module")
def cluster(pem: dict[str, Path], tmp_path_factory: pytest.TempPathFactory, repository: Path) -> Iterator[str]:
    """The address of a scheduler with a worker, started as docs/cluster.md has it."""
    pytest.importorskip("distributed")
    folder = tmp_path_factory.mktemp("cluster")
    tls = ["--tls-ca-file", pem["ca"], "--tls-cert", pem["cert"], "--tls-key", pem["key"]]
    said = folder / "scheduler.json"
    started: list[subprocess.Popen[bytes]] = []

    def start(*words: object) -> None:
        command = [sys.executable, "-m", "dask", *map(str, words)]
        with (folder / f"{len(started)}.txt").open("wb") as log:
            environment = {"PYTHONPATH": str(repository), "PATH": "/usr/bin:/bin", "HOME": str(folder)}
            started.append(
                subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=log, start_new_session=True)
            )

    try:
        start("scheduler", "--host", "tls://127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", said, *tls)
        address = address_in(said, 60.0)
        start("worker", address, "--nthreads", "1", "--no-dashboard", *tls)
        yield address
    finally:
        for process in started:
            # A nanny and its worker, at once: an orderly end takes seconds.
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


@pytest.fixture
def job(write_job: WriteJob) -> Path:
    return write_job(column_text("C-1", "C-1.ply"), column_text("C-2", "missing.ply"), clouds=("C-1.ply",))


def check(job: Path, out: str, address: str, *certificates: Path) -> int:
    """The exit code of a check on a cluster, with authority, certificate and key."""
    words = [word for pair in zip(("--tls-ca", "--tls-cert", "--tls-key"), certificates, strict=False) for word in pair]
    return main(
        ["check", str(job), "--out", str(job.parent / out), "--scheduler", address, "--quiet", *map(str, words)]
    )


def test_with_the_right_certificate(cluster: str, pem: dict[str, Path], job: Path) -> None:
    assert cluster.startswith("tls://")
    assert check(job, "there", cluster, pem["ca"], pem["cert"], pem["key"]) == 12
    assert main(["check", str(job), "--out", str(job.parent / "here"), "--quiet"]) == 12
    here, there = ((job.parent / out / "report.json").read_bytes() for out in ("here", "there"))
    assert there == here


def test_a_wrong_certificate_ends_it_at_once(
    cluster: str, pem: dict[str, Path], job: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    # Where it is tried again and again, that is seen by Dask being asked at all.
    monkeypatch.setattr("distributed.Client", None)
    assert check(job, "a", cluster, pem["ca"], pem["stranger"], pem["stranger-key"]) == 2
    assert "does not take the certificate of --tls-cert" in capsys.readouterr().err
    assert check(job, "b", cluster, pem["stranger-ca"], pem["cert"], pem["key"]) == 2
    assert "its certificate is not signed by the authority of --tls-ca" in capsys.readouterr().err
    assert check(job, "c", cluster, pem["ca"], pem["cert"], pem["stranger-key"]) == 2
    assert "cannot be used as authority, certificate and key in PEM format" in capsys.readouterr().err
    assert check(job, "d", cluster, pem["ca"], job, pem["key"]) == 2
    assert "cannot be used as authority, certificate and key" in capsys.readouterr().err
    assert check(job, "e", cluster.replace("tls://", "tcp://"), pem["ca"], pem["cert"], pem["key"]) == 2
    assert "certificates go with an address that begins with tls://" in capsys.readouterr().err


def test_a_wrong_certificate_of_dasks_own_configuration_ends_it_at_once(
    cluster: str, pem: dict[str, Path], job: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    dask = pytest.importorskip("dask")
    monkeypatch.setattr("distributed.Client", None)
    tls = "distributed.comm.tls"
    client = {f"{tls}.client.cert": str(pem["stranger"]), f"{tls}.client.key": str(pem["stranger-key"])}
    with dask.config.set({f"{tls}.ca-file": str(pem["ca"]), **client}):
        assert check(job, "f", cluster) == 2
    assert "does not take the certificate of --tls-cert" in capsys.readouterr().err


def test_certificates_that_are_not_there(job: Path, pem: dict[str, Path], capsys: pytest.CaptureFixture[str]) -> None:
    nowhere = job.parent / "nowhere.pem"
    assert check(job, "a", "tls://127.0.0.1:9", nowhere, pem["cert"], pem["key"]) == 2
    assert f"{nowhere}: there is no such file" in capsys.readouterr().err
    assert check(job, "b", "tls://127.0.0.1:9", pem["ca"]) == 2
    assert "--tls-ca and --tls-cert go together" in capsys.readouterr().err
    assert main(["check", str(job), "--tls-ca", str(pem["ca"]), "--tls-cert", str(pem["cert"])]) == 2
    assert "go with --scheduler" in capsys.readouterr().err


def test_nobody_answers_a_handshake(job: Path, pem: dict[str, Path], capsys: pytest.CaptureFixture[str]) -> None:
    assert check(job, "a", "tls://127.0.0.1:9", pem["ca"], pem["cert"], pem["key"]) == 2
    assert "no scheduler of Dask answers at tls://127.0.0.1:9 (Connection refused)" in capsys.readouterr().err
    assert check(job, "b", "tls://127.0.0.1", pem["ca"], pem["cert"], pem["key"]) == 2
    assert "names no port" in capsys.readouterr().err
    assert check(job, "c", "tls://127.0.0.1:9") == 2
    assert "asks for certificates; name them with --tls-ca" in capsys.readouterr().err


def test_a_port_that_speaks_something_else(job: Path, pem: dict[str, Path], capsys: pytest.CaptureFixture[str]) -> None:
    def speak(server: socket.socket) -> None:
        line, _ = server.accept()
        with line:
            line.recv(10)
            line.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n")

    with socket.create_server(("127.0.0.1", 0)) as server:
        thread = threading.Thread(target=speak, args=(server,))
        thread.start()
        address = f"tls://127.0.0.1:{server.getsockname()[1]}"
        assert check(job, "a", address, pem["ca"], pem["cert"], pem["key"]) == 2
        thread.join()
    assert "does not speak TLS (WRONG_VERSION_NUMBER)" in capsys.readouterr().err
