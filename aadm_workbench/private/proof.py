"""Whether the packages of an environment can be imported; each that cannot is a line of the output."""

import sys
from importlib import import_module

from aadm_workbench.errors import PACKAGES


def problems(pip_names: set[str]) -> list[str]:
    """What is wrong with those packages that this product imports, one line each."""
    found = []
    for package in PACKAGES:
        if pip_names.intersection({package.pip_name, *package.others}):
            try:
                import_module(package.module)
            except Exception as error:  # noqa: BLE001 - a broken package may raise anything
                found.append(f"{package.pip_name}: {type(error).__name__}: {error}")
    return found


if __name__ == "__main__":
    said = problems(set(sys.argv[1:]))
    sys.stdout.write("".join(f"{line}\n" for line in said))
    raise SystemExit(1 if said else 0)
