"""The window that a crew looks at while the column hangs."""
