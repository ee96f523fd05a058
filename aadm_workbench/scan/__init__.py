"""As-built scans: one module a file format, all of them leading to :class:`aadm_workbench.model.Scan`."""
