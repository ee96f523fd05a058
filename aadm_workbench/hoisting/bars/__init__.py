"""Bars under a hanging foot: where they stand, and the fit of all their sides."""
