"""The beginning of the scripted session: a FreeCAD that brings numpy and no other package. Runs inside FreeCAD."""

import sys
from importlib.util import find_spec

NOT_FREECADS = ("scipy", "cv2", "ifcopenshell", "rich", "jsonschema", "jinja2", "psutil", "trimesh", "msgspec")


def own_packages():
    """Where FreeCAD's interpreter would take packages from, and its path."""
    specs = {name: find_spec(name) for name in ("numpy", *NOT_FREECADS)}
    return {name: getattr(spec, "origin", None) for name, spec in specs.items()}, list(sys.path)


class NotFreeCADs:
    """A FreeCAD that brings numpy and none of the others."""

    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in NOT_FREECADS:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


before_all = own_packages()
sys.meta_path.insert(0, NotFreeCADs())
