"""FreeCAD runs this file at every start, with a screen or without one; nothing needs to be set up yet."""
