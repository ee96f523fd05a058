"""Frames of live cameras, written as capture folders."""
