"""What would let a column go on that does not."""
