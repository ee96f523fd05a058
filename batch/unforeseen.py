"""A model that breaks its reader in a way that nobody foresaw is a bad model, not the end of the night."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from aadm_workbench.errors import AadmError, DesignError


@contextmanager
def unforeseen_in(model: str) -> Iterator[None]:
    """Turn whatever else than an :class:`AadmError` comes out of reading a model into one that names it.

    Raises
    ------
    DesignError
        With the error as its cause.
    """
    try:
        yield
    except (AadmError, MemoryError):
        raise
    except Exception as error:
        from aadm_workbench.model import Reason

        said = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        raise DesignError(Reason("run.not_evaluated", model=model, error=said)) from error
