"""Who may read by OPC UA: the clients whose certificates lie in ``DIR/trusted``, and nobody else.

``DIR/own`` holds the certificate of the server, which is made where there is none. What a stranger presented is laid
into ``DIR/rejected``: whoever is to be trusted is moved from there by hand.
"""

from __future__ import annotations

import os
import socket
from pathlib import Path
from typing import TYPE_CHECKING, Any

from aadm_workbench.errors import AadmError
from aadm_workbench.own_files import write_atomically

if TYPE_CHECKING:
    from cryptography.x509 import Certificate

APPLICATION = "urn:aadm:hoisting"
"""The URI of the application, which the certificate of the server holds."""

_MOST_REJECTED = 20  # a stranger who tries again and again does not fill the disk
_DAYS = 3650  # of a certificate of its own: as long as a crane's controller runs
_SUFFIXES = (".der", ".crt", ".cer", ".pem")


class Certificates:
    """A folder of certificates, read anew at each connection: one that is taken out does not get in again."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name in ("own", "trusted", "rejected"):
            (folder / name).mkdir(parents=True, exist_ok=True)

    def own(self) -> tuple[Path, Path]:
        """The server's certificate (DER) and its key (PEM, for its owner alone); made where there are none."""
        certificate, key = self.folder / "own" / "certificate.der", self.folder / "own" / "key.pem"
        if certificate.exists() != key.exists():
            raise AadmError.because("command.link_halved", folder=certificate.parent)
        if not key.exists():
            _make(certificate, key)
        return certificate, key

    def get_user(
        self, iserver: Any, username: str | None = None, password: str | None = None, certificate: Any = None
    ) -> Any:
        """Who opened a session: a reader where its encrypted channel proved a trusted certificate, else nobody.

        What a client merely says of its certificate when it opens a session proves nothing, and it may say nothing.
        """
        from asyncua.crypto.permission_rules import User, UserRole

        return User(role=UserRole.User) if certificate is not None and bytes(certificate) in self._trusted() else None

    async def validate(self, certificate: Certificate, application: Any) -> None:
        """Let a client in, or raise what its protocol answers (BadCertificateUntrusted and others)."""
        from asyncua.common.utils import ServiceError
        from asyncua.crypto.validator import CertificateValidator, CertificateValidatorOptions
        from asyncua.ua import StatusCodes

        if _der(certificate) not in self._trusted():
            self._keep(certificate)
            raise ServiceError(StatusCodes.BadCertificateUntrusted)
        await CertificateValidator(CertificateValidatorOptions.BASIC_VALIDATION).validate(certificate, application)

    def _trusted(self) -> set[bytes]:
        found = set()
        for path in (self.folder / "trusted").iterdir():
            if path.suffix.lower() in _SUFFIXES and (content := _read(path)) is not None:
                found.add(content)
        return found

    def _keep(self, certificate: Certificate) -> None:
        from cryptography.hazmat.primitives.hashes import SHA1

        rejected = self.folder / "rejected"
        path = rejected / f"{certificate.fingerprint(SHA1()).hex()}.der"  # the name that OPC UA gives it
        if not path.exists() and len(list(rejected.iterdir())) < _MOST_REJECTED:
            write_atomically(path, _der(certificate))


def _der(certificate: Certificate) -> bytes:
    from cryptography.hazmat.primitives.serialization import Encoding

    return certificate.public_bytes(Encoding.DER)


def _read(path: Path) -> bytes | None:
    """A certificate file as DER; None where it holds none."""
    from cryptography import x509

    try:
        content = path.read_bytes()
        pem = content.lstrip().startswith(b"-----BEGIN")
        return _der(x509.load_pem_x509_certificate(content) if pem else x509.load_der_x509_certificate(content))
    except (OSError, ValueError):
        return None


def _make(certificate: Path, key: Path) -> None:
    """A certificate that signs itself, for the application's URI and this machine's name."""
    from asyncua.crypto.cert_gen import (
        dump_private_key_as_pem,
        generate_private_key,
        generate_self_signed_app_certificate,
    )
    from cryptography import x509
    from cryptography.x509.oid import ExtendedKeyUsageOID

    private = generate_private_key()
    names = [x509.UniformResourceIdentifier(APPLICATION), x509.DNSName(socket.gethostname())]
    made = generate_self_signed_app_certificate(
        private, "AADM hoisting", {}, names, [ExtendedKeyUsageOID.SERVER_AUTH], _DAYS
    )
    descriptor = os.open(key, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600)
    with os.fdopen(descriptor, "wb") as stream:
        stream.write(dump_private_key_as_pem(private))
    write_atomically(certificate, _der(made))
