"""Checks precast columns against their connecting rebars: from BIM models and structured-light scans to verdicts."""

__version__ = "0.1.0"
