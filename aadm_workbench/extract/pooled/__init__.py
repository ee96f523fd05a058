"""One fit of all features of a scan, with what they share."""
