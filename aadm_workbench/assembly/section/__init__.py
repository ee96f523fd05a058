"""The section of a foot against its design."""
