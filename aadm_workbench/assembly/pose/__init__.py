"""Poses of a pattern on another: fitted, best of all, and how probable one is."""
