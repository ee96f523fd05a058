"""FreeCAD runs this file at every start that has a screen: it registers the workbench, which loads the rest later."""

import FreeCADGui

from aadm_workbench.gui.workbench import AADMWorkbench

FreeCADGui.addWorkbench(AADMWorkbench())
