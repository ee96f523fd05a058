"""Live cameras: one file a protocol, all of them giving one noun (:mod:`aadm_workbench.camera.frame`)."""
