"""Fuzz the containers that others send: ``python -m tests.fuzz.containers [bcf fcstd ifczip journal] --seconds 600``.

Archives whose structure lies (see :mod:`.zips`), and journals that were spoilt, from a seed that is printed. Whatever
they hold, a reader may raise an error of its own and nothing else. Ends with 1 where it raises another, takes more than
20 s for one input, or the process grows beyond 4 GB; such an input is written to the working folder.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from aadm_workbench.design.fcstd import check_archive
from aadm_workbench.design.read import read_model
from aadm_workbench.errors import AadmError
from aadm_workbench.report.bcf.topics import write_bcf
from batch.runner.journal import Journal
from tests.report.checked_floor import CASES, floor_report
from tests.report.typed import typed

from .zips import Entry, harmed, harmed_text

LONGEST_S, LARGEST_MB = 20.0, 4096.0
SEED = 20261130

MODEL = (
    b"ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
    b"FILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n#1=IFCPROJECT('0YvctVUKr0kugbFTf53O9L',$,'P',$,$,$,$,$,#2);\n"
    b"#2=IFCUNITASSIGNMENT((#3));\n#3=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\nENDSEC;\nEND-ISO-10303-21;\n"
)
DOCUMENT = b"<?xml version='1.0' encoding='utf-8'?>\n<Document SchemaVersion='4'><Objects Count='0'/></Document>"


@dataclass(frozen=True)
class Container:
    """``make`` gives one more input, ``read`` gives it to the reader."""

    suffix: str
    make: Callable[[np.random.Generator], bytes]
    read: Callable[[Path], object]


def bcf() -> Container:
    """An earlier report.bcf, which a new one goes on from."""
    report = floor_report(*CASES)
    report["columns"] = [column for column in report["columns"] if column["verdict"] == "fail"][:1]
    pictures = {str(column["id"]): b"\x89PNG" for column in report["columns"]}

    def read(path: Path) -> object:
        return write_bcf(typed(report), path.with_suffix(".new"), existing=path, snapshots=pictures)

    with tempfile.TemporaryDirectory() as folder:
        sound = Path(folder) / "sound.bcf"
        write_bcf(typed(report), sound, snapshots=pictures)
        entries = entries_of(sound)
    return Container(".bcf", lambda rng: harmed(entries, rng), read)


def fcstd() -> Container:
    """A FreeCAD document, as far as it is looked at before FreeCAD reads it."""
    entries = [Entry("Document.xml", DOCUMENT), Entry("Shape.brp", b"DBRep_DrawableShape\n" * 50, 0)]
    return Container(".FCStd", lambda rng: harmed(entries, rng), check_archive)


def ifczip() -> Container:
    """A packed model without elements: what is in a model is fuzzed elsewhere."""
    entries = [Entry("model.ifc", MODEL), Entry("picture.png", b"\x89PNG", 0)]
    return Container(".ifczip", lambda rng: harmed(entries, rng), read_model)


def journal() -> Container:
    """What an earlier check left in the folder of a report."""
    line = b'{"id":"C-1","key":"k","verdict":"pass","goes_on":"pass","seconds":{"total":1.0},"where":"","report":{},'
    sound = b'{"aadm_journal":2}\n{"began":"C-1"}\n' + line + b'"crc32":"00000000"}\n{"stopped":true}\n'

    def read(path: Path) -> None:
        with suppress(OSError):
            (path.parent / "journal.jsonl").unlink()
        path.rename(path.parent / "journal.jsonl")
        Journal(path.parent, resume=True).close()

    return Container(".jsonl", lambda rng: harmed_text(sound, rng), read)


CONTAINERS: dict[str, Callable[[], Container]] = {"bcf": bcf, "fcstd": fcstd, "ifczip": ifczip, "journal": journal}


def entries_of(path: Path) -> list[Entry]:
    import zipfile

    with zipfile.ZipFile(path) as archive:
        return [Entry(entry.filename, archive.read(entry)) for entry in archive.infolist()]


@dataclass
class Tally:
    """What came of some inputs."""

    inputs: int = 0
    refused: int = 0
    slowest_s: float = 0.0
    largest_mb: float = 0.0
    failed: str = ""


def fuzz(name: str, rng: np.random.Generator, go_on: Callable[[Tally], bool]) -> Tally:
    """Give inputs to a reader for as long as ``go_on`` says; stops at the first that breaks it."""
    container, tally = CONTAINERS[name](), Tally()
    with tempfile.TemporaryDirectory(prefix="aadm-fuzz-") as folder:
        path = Path(folder) / f"input{container.suffix}"
        while go_on(tally) and not tally.failed:
            content = container.make(rng)
            path.write_bytes(content)
            began = time.process_time()
            try:
                container.read(path)
            except AadmError:
                tally.refused += 1
            except Exception as error:  # noqa: BLE001 - this is what is looked for
                tally.failed = f"{type(error).__name__}: {error}"
            tally.inputs += 1
            tally.slowest_s = max(tally.slowest_s, time.process_time() - began)
            tally.largest_mb = _largest_mb()
            if tally.slowest_s > LONGEST_S or tally.largest_mb > LARGEST_MB:
                tally.failed = tally.failed or "took too long, or too much memory"
            if tally.failed:
                Path(f"crash-{name}{container.suffix}").write_bytes(content)
    return tally


def _largest_mb() -> float:
    import resource

    # Linux counts in kilobytes, macOS in bytes.
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1024.0 if sys.platform == "linux" else 2.0**20)


def main() -> int:
    """Fuzz the containers that are named, one after the other, and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="CONTAINER", default=list(CONTAINERS))
    parser.add_argument("--seconds", type=float, default=600.0, help="for each (default: 600)")
    parser.add_argument("--seed", type=int, default=SEED)
    options = parser.parse_args()
    failed = False
    for name in options.names:
        until = time.monotonic() + options.seconds
        tally = fuzz(name, np.random.default_rng(options.seed), lambda _, until=until: time.monotonic() < until)
        print(
            f"{name}: {tally.inputs} inputs, {tally.refused} refused, slowest {tally.slowest_s:.2f} s of processor, "
            f"largest {tally.largest_mb:.0f} MB, seed {options.seed}: {tally.failed or 'sound'}",
            flush=True,
        )
        failed = failed or bool(tally.failed)
    return int(failed)


if __name__ == "__main__":
    raise SystemExit(main())
