"""What reports of many columns cost: CPU seconds, memory and bytes of each format, in a process of its own.

    python -m benchmarks.reports                       # 1,000 columns, every format
    python -m benchmarks.reports --columns 160 --formats html bcf
    python -m benchmarks.reports --failing             # every column fails: each has a topic, reasons, advice

The columns are those of the sample floor, checked from their scans, again and again under other names and GlobalIds,
six metres apart, with other figures: what a format shares between columns that are alike is not to flatter it. Prints a
table; ends with 1 where a format needs more than it should.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.report.read import read_report
from batch.report_files import write_reports
from benchmarks.floors import SAMPLE

MOST_CPU_S = {"bcf": 15.0}
"""Seconds of a thousand columns; five where nothing is said."""
MOST_MEMORY_MB = 300.0
MOST_MB = {"bcf": 20.0}

_FORMATS = ("html", "pdf", "xlsx", "csv", "bcf", "crew", "scan_card")
_IN_ROW = 25
_OTHERWISE_MM, _OTHERWISE_U_MM = 2.0, 0.05
"""So far apart are figures of two columns: as far as tolerances allow; uncertainties as far as cameras differ."""
_SAME = ("limit", "design", "T_", "size", "quantity", "adjustment", "hash", "embedded")
"""Begin or part of the names of figures that columns of one design share."""


def sample_report(folder: Path) -> dict[str, Any]:
    """report.json of the sample floor, checked here and now."""
    from batch.main import main

    main(["check", str(SAMPLE / "job.toml"), "--out", str(folder), "--quiet", "--jobs", "1"])
    document: dict[str, Any] = json.loads((folder / "report.json").read_bytes())
    return document


def many_columns(document: dict[str, Any], number: int, *, failing: bool = False) -> dict[str, Any]:
    """The same columns again and again, under names, GlobalIds and places of their own."""
    columns = [c for c in document["columns"] if c["verdict"] == "fail" or not failing]
    made = []
    generator = np.random.default_rng(number)
    for k in range(number):
        column = _otherwise(columns[k % len(columns)], generator)
        column["id"] = f"K-{k:04d}"
        column["grid"] = f"{_letters(k // _IN_ROW)}/{k % _IN_ROW + 1}"
        column["global_id"] = _global_id(f"{k}")
        for kind in ("sleeves", "rebars"):
            for point in (column[kind] or {}).get("points", ()):
                point["global_id"] = _global_id(f"{k} {point['label']}")
        if column["T_model_column"] is not None:
            column["T_model_column"] = [[*row] for row in column["T_model_column"]]
            column["T_model_column"][0][3] = 6000.0 * (k % _IN_ROW)
            column["T_model_column"][1][3] = 6000.0 * (k // _IN_ROW)
        made.append(column)
    return document | {"columns": made, "mould_drift": document["mould_drift"]}


def _otherwise(value: Any, generator: np.random.Generator, apart: float = _OTHERWISE_MM) -> Any:
    """A copy with other lengths and angles, up to ``apart`` larger."""
    if isinstance(value, dict):
        return {name: _named_otherwise(name, entry, generator, apart) for name, entry in value.items()}
    if isinstance(value, list):
        return [_otherwise(entry, generator, apart) for entry in value]
    return round(value + float(generator.uniform(0.0, apart)), 4) if isinstance(value, float) else value


def _named_otherwise(name: str, entry: Any, generator: np.random.Generator, apart: float) -> Any:
    if any(part in name for part in _SAME):
        return entry
    if "probability" in name and entry is not None:
        return round(float(generator.uniform(0.0, 1.0)), 4)
    return _otherwise(entry, generator, _OTHERWISE_U_MM if name.startswith("u_") else apart)


def _letters(number: int) -> str:
    return chr(ord("A") + number % 26) * (1 + number // 26)


def _global_id(name: str) -> str:
    from ifcopenshell.guid import compress

    return str(compress(uuid.uuid5(uuid.NAMESPACE_OID, name).hex))


def measure(path: Path, name: str, folder: Path) -> dict[str, float]:
    """CPU seconds, peak memory and size of one format, without what reading report.json takes."""
    words = [sys.executable, "-m", "benchmarks.reports", "--measure", str(path), name, str(folder)]
    done = subprocess.run(words, stdout=subprocess.PIPE, check=True)
    found: dict[str, float] = json.loads(done.stdout)
    return found


def measured(path: Path, name: str, folder: Path) -> dict[str, float]:
    """The same, in this process."""
    report = read_report(path)
    before, wall = cpu_s(), time.perf_counter()
    read_mb = peak_mb()
    written = write_reports(report, (name,), folder)
    seconds, took = cpu_s() - before, time.perf_counter() - wall
    size = sum(file.stat().st_size for file in written.files.values())
    return {"cpu_s": seconds, "wall_s": took, "read_mb": read_mb, "peak_mb": peak_mb(), "mb": size / 1e6}


def cpu_s() -> float:
    """That this process has used."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def peak_mb() -> float:
    """Of this process alone: what getrusage says begins with that of its parent."""
    status = Path("/proc/self/status").read_text(encoding="utf-8")
    return float(next(line.split()[1] for line in status.splitlines() if line.startswith("VmHWM:"))) / 1024.0


def run(arguments: Sequence[str] | None = None) -> int:
    """Measure, print, compare."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--columns", type=int, default=1000)
    parser.add_argument("--formats", nargs="+", default=list(_FORMATS))
    parser.add_argument("--failing", action="store_true", help="columns that fail alone")
    parser.add_argument("--report", type=Path, help="report.json of the sample floor, where it was checked before")
    parser.add_argument("--keep", type=Path, help="write into this folder, and keep it")
    parser.add_argument("--measure", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if options.measure:
        path, name, folder = options.measure
        print(json.dumps(measured(Path(path), name, Path(folder))))
        return 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        document = json.loads(options.report.read_bytes()) if options.report else sample_report(folder / "sample")
        path = folder / "report.json"
        many = many_columns(document, options.columns, failing=options.failing)
        path.write_text(json.dumps(many, ensure_ascii=False), encoding="utf-8")
        print(f"{options.columns} columns, report.json {path.stat().st_size / 1e6:.1f} MB")
        print("format      CPU s   wall s   MB read   MB peak   file MB")
        missed = 0
        for name in options.formats:
            found = measure(path, name, folder)
            most = options.columns / 1000.0
            late = found["cpu_s"] > MOST_CPU_S.get(name, 5.0) * most
            large = found["peak_mb"] > MOST_MEMORY_MB or found["mb"] > MOST_MB.get(name, float("inf")) * most
            missed += late or large
            figures = "".join(f"{found[key]:9.1f}" for key in ("cpu_s", "wall_s", "read_mb", "peak_mb", "mb"))
            print(f"{name:9}{figures}{'   beyond' if late or large else ''}", flush=True)
    return int(missed > 0)


if __name__ == "__main__":
    raise SystemExit(run())
