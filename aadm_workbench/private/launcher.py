"""Runs a module of this addon with the packages of an environment, and with nothing else that Python may find.

``python -I -S launcher.py SITE ROOT MODULE ARGUMENT...``; it ends when its standard input does.
"""

import os
import runpy
import sys

if __name__ == "__main__":
    site, root, module, *arguments = sys.argv[1:]
    # The addon last: what is called as a package is that package.
    sys.path += [site, root]
    from contextlib import suppress
    from pathlib import Path

    from aadm_workbench.errors import PRIVATE_ENVIRONMENT
    from aadm_workbench.private.ending import end_with_input
    from aadm_workbench.private.holding import InUseError, hold

    end_with_input()
    os.environ[PRIVATE_ENVIRONMENT] = site
    with suppress(InUseError):
        # Who takes the environment away asks for this lock. Without it (two checks on Windows) work goes on.
        in_use = hold(Path(site).parent / "in-use", alone=False)
    sys.argv = [module, *arguments]
    runpy.run_module(module, run_name="__main__", alter_sys=True)
