"""From a scan to assembly points, in the scan frame. Pure: no files, no clock, no printing."""
