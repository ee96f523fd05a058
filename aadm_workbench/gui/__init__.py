"""What a person meets in FreeCAD: commands, panels and marks. Thin: it shows what the other packages have measured."""
