"""Virtual camera: as-built geometry in, a scan with its exact truth out (samples, studies, tests)."""
