"""What the camera does at edges, read from the scan."""
