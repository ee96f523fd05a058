"""Whether the renderer is there, and what to install where it is not."""

from __future__ import annotations

from typing import Any

from aadm_workbench.errors import MissingDependencyError, needed

INSTALL_LLVM = "apt-get install libllvm19"
LEAST_LLVM = 19
"""The one that was tried. 15 is said to do, but 15 and 16 stop the whole process at the lesser of two numbers."""

_VARIANT = "llvm_ad_mono"  # one colour is enough, and only the compiled variants take whole arrays of rays


def mitsuba_ready() -> Any:
    """Mitsuba, set to the variant that compiles for the processor.

    Raises
    ------
    MissingDependencyError
        Where Mitsuba, or the LLVM that it compiles with, is not installed.
    """
    with needed("mitsuba", "The fringe camera"):
        import mitsuba
    if llvm_found() < LEAST_LLVM:
        raise MissingDependencyError(f"LLVM {LEAST_LLVM} or newer", "The fringe camera", INSTALL_LLVM)
    if mitsuba.variant() != _VARIANT:
        mitsuba.set_variant(_VARIANT)
    return mitsuba


def llvm_found() -> int:
    """Version of the LLVM that the renderer finds; 0 where it finds none that it can use."""
    import drjit

    if not drjit.has_backend(drjit.JitBackend.LLVM):
        return 0
    return int(drjit.detail.llvm_version()[0])
