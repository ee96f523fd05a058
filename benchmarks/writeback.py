"""What results add to an IFC model: bytes a column, CPU seconds and memory, of a floor of so many columns.

    python -m benchmarks.writeback --columns 500

The model is that of the sample floor with as many columns, each with twelve sleeves and twelve bars; the figures are
those of its check, all different. Ends with 1 where a column takes more than 30 kB, or the whole more than 1 GB.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

from aadm_workbench.design.ifc.model import read_ifc
from aadm_workbench.report.ifc.model import write_ifc
from aadm_workbench.report.read import read_report
from benchmarks.floors import SAMPLE
from benchmarks.reports import cpu_s, many_columns, peak_mb, sample_report

MOST_KB, MOST_MEMORY_MB = 30.0, 1000.0
_APART_MM = 7800.0


def large_model(path: Path, number: int) -> None:
    """The sample floor's model with so many columns in rows of forty."""
    sys.path.insert(0, str(SAMPLE.parent))
    import make_model

    places = [(7800.0 * (k % 40), _APART_MM * (k // 40), make_model.STOREYS_MM["3F"]) for k in range(number)]
    make_model.columns = lambda: [(f"K-{k:04d}", "", place, 0.0) for k, place in enumerate(places)]
    make_model.build().write(str(path))


def matching_report(model: Path, document: dict[str, Any], number: int) -> dict[str, Any]:
    """The columns of a report, under the GlobalIds of a model."""
    many = many_columns(document, number, failing=True)
    for column, design in zip(many["columns"], read_ifc(model).columns, strict=True):
        column["id"], column["global_id"] = design.id, design.global_id
        column["T_model_column"] = None if design.T_model_column is None else design.T_model_column.tolist()
        for kind, points in (("sleeves", design.sleeves), ("rebars", design.rebars)):
            for point, known in zip(column[kind]["points"], points, strict=True):
                point["global_id"] = known.global_id
    return many | {"model": {"source": model.name, "sha256": sha256(model.read_bytes()).hexdigest()}}


def measured(folder: Path) -> dict[str, float]:
    """Written in this process."""
    model, out = folder / "model.ifc", folder / "out.ifc"
    report = read_report(folder / "report.json")
    before = cpu_s()
    write_ifc(report, model, out)
    added = out.stat().st_size - model.stat().st_size
    return {"kb": added / 1000.0 / len(report.columns), "cpu_s": cpu_s() - before, "peak_mb": peak_mb()}


def run(arguments: Sequence[str] | None = None) -> int:
    """Build, write, print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--columns", type=int, default=500)
    parser.add_argument("--report", type=Path, help="report.json of the sample floor, where it was checked before")
    parser.add_argument("--keep", type=Path, help="build in this folder, and keep it")
    parser.add_argument("--measure", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if options.measure:
        print(json.dumps(measured(options.measure)))
        return 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        document = json.loads(options.report.read_bytes()) if options.report else sample_report(folder / "sample")
        large_model(folder / "model.ifc", options.columns)
        report = matching_report(folder / "model.ifc", document, options.columns)
        (folder / "report.json").write_text(json.dumps(report), encoding="utf-8")
        words = [sys.executable, "-m", "benchmarks.writeback", "--measure", str(folder)]
        found = json.loads(subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout)
    print(
        f"{options.columns} columns: {found['kb']:.1f} kB a column, "
        f"{found['cpu_s']:.1f} CPU s, {found['peak_mb']:.0f} MB"
    )
    return int(found["kb"] > MOST_KB or found["peak_mb"] > MOST_MEMORY_MB)


if __name__ == "__main__":
    raise SystemExit(run())
