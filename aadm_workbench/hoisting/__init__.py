"""Alignment while the column hangs: from frames to corrections."""
