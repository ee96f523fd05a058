"""Readers of scan formats, one a file."""
