"""Frames of one column that follow each other, or show it from several corners."""
