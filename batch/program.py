"""Which program this is: what reports say of it, and what tells two installations apart."""

from __future__ import annotations

import hashlib
import platform
import re
from functools import cache
from pathlib import Path

import aadm_workbench
from aadm_workbench.inspection.tasks import tool_entry

from .runner.exact_json import to_exact_json

_CODE = (".py", ".toml", ".json")


@cache
def program_versions() -> dict[str, str]:
    """Everything that may change a number: versions, and a hash of the program's own files.

    The hash tells apart two states of a working tree that call themselves by one version.
    """
    python = ".".join(platform.python_version_tuple()[:2])
    return {**tool_entry(), "python": python, "code": _code_hash()}


def program_key() -> str:
    """Hash of :func:`program_versions`: with another one a result has to be calculated again."""
    return hashlib.sha256(to_exact_json(program_versions()).encode()).hexdigest()


def difference(ours: dict[str, str], theirs: dict[str, str]) -> str:
    """What two installations have in different versions, in words; empty where nothing."""
    names = [name for name in {**ours, **theirs} if ours.get(name) != theirs.get(name) and name != "code"]
    said = [f"{name} {theirs.get(name, 'missing')} instead of {ours.get(name, 'none')}" for name in names]
    if not said and ours != theirs:
        return "other code under the same version of aadm"
    return ", ".join(re.sub(r"^version ", "aadm ", text) for text in said)


def _code_hash() -> str:
    found = hashlib.sha256()
    for folder in (Path(aadm_workbench.__file__).parent, Path(__file__).parent):
        for path in sorted(path for path in folder.rglob("*") if path.suffix in _CODE):
            content = path.read_bytes()
            found.update(f"{path.relative_to(folder).as_posix()} {len(content)}\n".encode())
            found.update(content)
    return found.hexdigest()[:16]
