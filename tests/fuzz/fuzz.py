"""Fuzz one reader, guided by coverage: ``python tests/fuzz/fuzz.py ply -max_total_time=600``.

Needs atheris (``pip install atheris``; CPython 3.11 to 3.14 on Linux). Starts from the corpus beside this file; what it
finds on the way is kept in a folder of its own (``--corpus DIR``, by default a temporary one). A crash is written to
the working folder as ``crash-...``: put it into the corpus once it is mended. Further arguments are those of libFuzzer.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import atheris

FOLDER = Path(__file__).resolve().parent


def main(arguments: list[str]) -> None:
    """Fuzz until the time or the patience is over."""
    sys.path.insert(0, str(FOLDER.parents[1]))
    with atheris.instrument_imports(include=["aadm_workbench", "batch", "json", "tomllib", "xml", "zipfile"]):
        from tests.fuzz.targets import TARGETS
    name = arguments[1] if len(arguments) > 1 else ""
    if name not in TARGETS:
        raise SystemExit(f"usage: fuzz.py {{{','.join(TARGETS)}}} [--corpus DIR] [libFuzzer's arguments]")
    options = arguments[2:]
    kept = options.pop(1) if options[:1] == ["--corpus"] else tempfile.mkdtemp(prefix="aadm-fuzz-")
    options = [option for option in options if option != "--corpus"]
    Path(kept).mkdir(parents=True, exist_ok=True)
    # Inputs up to 16 KiB, five seconds and two gigabytes for each.
    limits = ["-max_len=16384", "-timeout=5", "-rss_limit_mb=2048", "-print_final_stats=1"]
    atheris.Setup([arguments[0], kept, str(FOLDER / "corpus" / name), *limits, *options], TARGETS[name])
    atheris.Fuzz()


if __name__ == "__main__":
    main(sys.argv)
