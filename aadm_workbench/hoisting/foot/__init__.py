"""Sleeves of a hanging foot: the face, the mouths in it, and every sleeve by its own evidence."""
