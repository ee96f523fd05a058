"""Columns checked one after another, here or in other processes."""
