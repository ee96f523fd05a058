"""A scheduler of Dask that somebody has started, wherever its workers are; with certificates where it asks for them.

Workers that others have started: their nannies replace them, and say how they died.
"""

from __future__ import annotations

import contextlib
import logging
import os
import re
import signal
import socket
import ssl
from asyncio import CancelledError
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from aadm_workbench.errors import JobError, MissingDependencyError

from .local_workers import exit_words, signal_words

_CONNECT_S = 10.0  # a scheduler that is there answers at once: a slow network has seconds
_LOGGERS = ("distributed", "distributed.client", "tornado", "tornado.application")

GONE: tuple[type[BaseException], ...] = (OSError, TimeoutError, RuntimeError, ValueError, CancelledError)
"""What Dask raises where a worker or the scheduler is no longer there."""


@dataclass(frozen=True)
class Cluster:
    """A synchronous client of Dask, and who looks after its workers."""

    client: Any
    keeper: RemoteWorkers


@dataclass(frozen=True)
class Certificates:
    """Files in PEM format: the authority that all of a cluster trust, this side's certificate, and its key."""

    authority: Path
    certificate: Path
    key: Path | None = None


def load_distributed() -> Any:
    """Dask's ``distributed``.

    Raises
    ------
    MissingDependencyError
        Where it is not installed.
    """
    try:
        return import_module("distributed")
    except ImportError as error:
        raise MissingDependencyError("distributed", "Checking columns on a cluster") from error


@contextmanager
def remote_cluster(
    address: str, log: Callable[[str], None], certificates: Certificates | None = None
) -> Iterator[Cluster]:
    """The workers of a scheduler.

    Raises
    ------
    JobError
        Where no scheduler answers, or one of another version of Dask, or one that does not take the certificate or
        has none that the authority has signed.
    """
    distributed = load_distributed()
    dask = import_module("dask")
    security = None if certificates is None else _security(distributed, address, certificates)
    if security is None and address.startswith("tls://"):
        if not dask.config.get("distributed.comm.tls.ca-file", None):
            raise JobError.because("run.tls_asked", address=address)
        _try(distributed.Security(), address, "those of Dask's configuration")
    with _messages_to(log), dask.config.set({"distributed.comm.retry.count": 2}):
        try:
            client = distributed.Client(address, timeout=_CONNECT_S, set_as_default=False, security=security)
        except (OSError, TimeoutError, ValueError, TypeError, ImportError, AttributeError, RuntimeError) as error:
            reason = str(error).splitlines()[0] if str(error) else type(error).__name__
            version = distributed.__version__
            raise JobError.because("run.no_dask", address=address, why=reason, version=version) from error
        try:
            yield Cluster(client, RemoteWorkers(client))
        finally:
            with contextlib.suppress(OSError, TimeoutError):
                client.close(timeout=5)


def _security(distributed: Any, address: str, certificates: Certificates) -> Any:
    """What Dask needs to know of certificates, once they were tried on the scheduler."""
    address = address if "://" in address else f"tls://{address}"
    if not address.startswith("tls://"):
        raise JobError.because("run.tls_address", address=address)
    for file in (certificates.authority, certificates.certificate, certificates.key):
        if file is not None and not file.is_file():
            raise JobError.because("run.tls_no_file", file=file)
    security = distributed.Security(
        require_encryption=True,
        tls_ca_file=str(certificates.authority),
        tls_client_cert=str(certificates.certificate),
        tls_client_key=None if certificates.key is None else str(certificates.key),
    )
    names = ", ".join(str(file) for file in vars(certificates).values() if file is not None)
    _try(security, address, names)
    return security


def _try(security: Any, address: str, files: str) -> None:
    """Try the certificates of ``files`` on a scheduler, before Dask does so again and again."""
    try:
        context = security.get_connection_args("client")["ssl_context"]
    except (OSError, ValueError) as error:
        reason = getattr(error, "reason", None) or error
        raise JobError.because("run.tls_unusable", files=files, why=reason) from error
    parts = urlsplit(address)
    _try_certificates(parts.hostname or "", parts.port, address, context)


def _try_certificates(host: str, port: int | None, address: str, context: ssl.SSLContext) -> None:
    """Shake hands once and wait for the first byte: a scheduler that refuses the certificate says so only then.

    Dask itself takes a refusal for a line that is bad, and tries again until its time is over.
    """
    if port is None:
        raise JobError.because("run.no_port", address=address)
    try:
        line = socket.create_connection((host, port), _CONNECT_S)
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise JobError.because("run.no_scheduler", address=address, why=reason) from error
    try:
        with line, context.wrap_socket(line, server_hostname=host) as secured:
            secured.recv(1)
    except ssl.SSLCertVerificationError as error:
        raise JobError.because("run.tls_signed", address=address, why=error.verify_message) from error
    except OSError as error:
        reason = getattr(error, "reason", None) or type(error).__name__
        raise JobError.because("run.tls_refused", address=address, why=reason) from error


class _Lines(logging.Handler):
    def __init__(self, log: Callable[[str], None]) -> None:
        super().__init__()
        self._log = log

    def emit(self, record: logging.LogRecord) -> None:
        """Hand over one message, on one line."""
        with contextlib.suppress(OSError, ValueError, TypeError):
            self._log(" ".join(f"{record.name}: {record.getMessage()}".split()))


@contextmanager
def _messages_to(log: Callable[[str], None]) -> Iterator[None]:
    """What Dask says goes to a log, not between the lines of the command."""
    loggers = [logging.getLogger(name) for name in _LOGGERS]
    before = [(logger, logger.handlers[:], logger.propagate, logger.level) for logger in loggers]
    for logger in loggers:
        logger.handlers, logger.propagate = [_Lines(log)], False
        logger.setLevel(logging.WARNING)
    try:
        yield
    finally:
        for logger, handlers, propagate, level in before:
            logger.handlers, logger.propagate = handlers, propagate
            logger.setLevel(level)


class RemoteWorkers:
    """The workers of a scheduler, by a client of Dask."""

    def __init__(self, client: Any) -> None:
        self._client = client

    def how_ended(self, address: str, pid: int) -> str | None:
        """How a worker ended, as a nanny on its machine says; None where none has said it (yet)."""
        return next((words for line in self._nannies_say(address) if (words := exit_in_words(line, pid))), None)

    def kill(self, address: str, pid: int) -> None:
        """End a worker; its nanny starts another."""
        with contextlib.suppress(*GONE, KeyError):
            self._client.run(_kill, pid, workers=[address], nanny=True)

    def _nannies_say(self, address: str) -> Iterator[str]:
        host = address.rpartition(":")[0]
        with contextlib.suppress(*GONE, KeyError):
            there = self._client.scheduler_info(n_workers=-1)["workers"]
            near = [other for other in there if other.rpartition(":")[0] == host]
            logs = self._client.get_worker_logs(workers=near, nanny=True) if near else {}
            for messages in logs.values():
                yield from (str(message[-1]) for message in messages)


def exit_in_words(message: str, pid: int) -> str | None:
    """How a process ended, from what its nanny says of it; None where the message is about something else."""
    found = re.search(rf"\bprocess {pid} (?:was killed by signal (\d+)|exited with status (-?\d+))", message)
    if found is None:
        return None
    return signal_words(int(found[1])) if found[1] else exit_words(int(found[2]))


def _kill(pid: int) -> None:
    """End a process of this machine, from its nanny."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, getattr(signal, "SIGKILL", signal.SIGTERM))
