"""The private environment: all packages in a folder of their own, used by a process of its own; FreeCAD gets nothing.

Standard library alone: it runs in FreeCAD's interpreter, and in a Python that has nothing yet.
"""
