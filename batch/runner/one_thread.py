"""One thread for linear algebra, so that the last bits of a sum do not depend on the machine's load or cores."""

from __future__ import annotations

import os

_VARIABLES = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def calculate_in_one_thread() -> None:
    """Bind the libraries under numpy and scipy to one thread; to be called before either is imported.

    The matrices here are small, so nothing is lost; columns are spread over processes instead.
    """
    os.environ.update(dict.fromkeys(_VARIABLES, "1"))


def is_in_one_thread() -> bool:
    """Whether this process was bound to one thread before it began."""
    return all(os.environ.get(name) == "1" for name in _VARIABLES)
