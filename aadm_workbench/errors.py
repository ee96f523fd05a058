"""The errors that reach a person. Each message says what is wrong, where, and what to do about it.

What a scan cannot support (a plugged sleeve, a bar out of view) is no error: it is a value,
``Verdict.NOT_MEASURED`` with a reason (see :mod:`aadm_workbench.model`).
"""

from __future__ import annotations


class AadmError(Exception):
    """Base of all errors that this product raises on purpose."""


class JobError(AadmError):
    """The text of a job cannot be used: nothing was checked."""


class DesignError(AadmError):
    """A model does not give the as-designed points that were asked for."""


class ScanError(AadmError):
    """A scan file cannot be read, or what it holds cannot be a scan of this component."""


class CameraError(AadmError):
    """Intrinsics are missing or cannot belong to the scan."""


class ReportError(AadmError):
    """A report.json cannot be used: broken, of another schema, or not what the schema describes."""


class MissingDependencyError(AadmError):
    """A package that this command needs is not installed; the message holds the command that installs it."""

    def __init__(self, package: str, needed_for: str, install: str) -> None:
        super().__init__(
            f"{needed_for} needs the package {package}, which is not installed. Install it with: {install}"
        )
        self.package = package
        self.install = install
