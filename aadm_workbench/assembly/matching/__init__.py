"""Which point is which, and which column belongs on which bars."""
