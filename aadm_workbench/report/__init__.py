"""Verdicts to people and to models: one module a format."""
