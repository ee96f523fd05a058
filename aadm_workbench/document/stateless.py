"""What all proxies of this workbench share: they keep nothing, everything is in properties.

FreeCAD 0.20 asks a proxy for its state by other names than 1.0 does; both get none.
"""

from __future__ import annotations


class Stateless:
    """A proxy without state."""

    def dumps(self) -> None:
        """Nothing to keep (FreeCAD 0.21 and newer)."""

    def loads(self, state: object) -> None:
        """Nothing to bring back (FreeCAD 0.21 and newer)."""

    def __getstate__(self) -> None:
        """Nothing to keep (FreeCAD 0.20)."""

    def __setstate__(self, state: object) -> None:
        """Nothing to bring back (FreeCAD 0.20)."""
