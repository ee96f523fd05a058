"""FreeCAD runs this file at every start that has a screen: it registers the workbench, which loads the rest later."""

from aadm_workbench.gui.workbench import set_up

set_up()
