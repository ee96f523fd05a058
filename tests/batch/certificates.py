"""Certificates in tests: an authority, what it signs for this machine, and a stranger that signs for itself."""

import shutil
import subprocess
from pathlib import Path

import pytest

_DAYS = "2"


def write_certificates(folder: Path) -> dict[str, Path]:
    """``ca``, and by it ``cert`` with ``key``; ``stranger-ca``, and by it ``stranger`` with ``stranger-key``."""
    if shutil.which("openssl") is None:
        pytest.skip("there is no openssl to make certificates with")
    found = {}
    for prefix, names in (("", ("ca", "cert", "key")), ("stranger-", ("stranger-ca", "stranger", "stranger-key"))):
        authority, signed, key = (folder / f"{name}.pem" for name in names)
        authority_key = folder / f"{prefix}ca-key.pem"
        new_key = ["-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes"]
        _openssl(
            "req", "-x509", *new_key, "-keyout", authority_key, "-out", authority, "-days", _DAYS, "-subj", "/CN=a"
        )
        request = folder / f"{prefix}request.pem"
        _openssl("req", *new_key, "-keyout", key, "-out", request, "-subj", "/CN=c")
        ca = ["-CA", authority, "-CAkey", authority_key, "-CAcreateserial"]
        names_of = folder / f"{prefix}names.txt"
        names_of.write_text("subjectAltName=IP:127.0.0.1\n", encoding="utf-8")
        _openssl("x509", "-req", "-in", request, *ca, "-out", signed, "-days", _DAYS, "-extfile", names_of)
        found |= dict(zip(names, (authority, signed, key), strict=True))
    return found


def _openssl(*words: str | Path) -> None:
    subprocess.run(["openssl", *map(str, words)], check=True, capture_output=True)
