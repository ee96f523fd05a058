"""FreeCAD runs this file at every start, with a screen or without one: it names the files that AADM opens."""

import FreeCAD

FreeCAD.addImportType(
    "AADM: structured-light scan (*.ply *.pcd *.xyz *.pts *.ptx *.las *.laz *.e57 *.asc *.npz *.tif *.tiff)",
    "aadm_workbench.document.open_scan",
)
FreeCAD.addImportType("AADM: job (*.toml)", "aadm_workbench.document.job.opened")
FreeCAD.addImportType("AADM: report of a check (*.json)", "aadm_workbench.document.report.opened")
FreeCAD.__unit_test__ += ["aadm_workbench.document.selftest"]
