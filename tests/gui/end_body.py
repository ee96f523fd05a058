"""The end of the scripted session: what is open is closed, and FreeCAD's interpreter looked at. Runs inside FreeCAD."""

# ruff: noqa: F821 - a script in the order of the session, with names that the runner puts in
FreeCAD.closeDocument(tried.Name)
settle(0.2)
FreeCAD.closeDocument(document.Name)
settle(0.2)

sys.meta_path.pop(0)
result["own_packages"] = [before_all, own_packages()]
