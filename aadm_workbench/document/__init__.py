"""FreeCAD documents without a screen: what a check creates in them. Imports FreeCAD, never its windows."""
