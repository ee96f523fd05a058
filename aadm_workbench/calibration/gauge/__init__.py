"""The gauge study: repeat captures of the same columns."""
