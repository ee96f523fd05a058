"""Absolute position: control points and datums."""
