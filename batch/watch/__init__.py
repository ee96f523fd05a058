"""Frames measured as they arrive."""
