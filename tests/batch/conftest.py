"""Small jobs that need no camera: clouds of a few points, and an extraction that knows where the centres are."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.inspection import measure
from aadm_workbench.model import Array, AssemblyPoint, Extraction, Kind, Scan
from aadm_workbench.scan.write import write_ply
from aadm_workbench.twin.parts import ring

CENTRES = ring(240.0, 240.0, 4)
DESIGN = f"""\
[columns.design]
sleeve_diameter = 36.0
rebar_diameter = 20.0
rebar_outer_diameter = 22.0
size = [600.0, 600.0]
centres = {CENTRES.tolist()}
"""
HEAD = 'schema = 1\nname = "层 3"\nunits = "mm"\n'

WriteJob = Callable[..., Path]


def column_text(name: str, sleeves: str | None = None, rebars: str | None = None, more: str = 'up = "-y"\n') -> str:
    """One column of a job, with its own design."""
    lines = [f'[[columns]]\nid = "{name}"\n']
    lines += [f'sleeves = "{sleeves}"\n'] if sleeves else []
    lines += [f'rebars = "{rebars}"\n'] if rebars else []
    return "".join([*lines, more, DESIGN])


@pytest.fixture
def write_job(tmp_path: Path) -> WriteJob:
    """Writes ``job.toml`` from the texts of its columns, and a cloud for each of some names."""

    def write(*columns: str, clouds: tuple[str, ...] = (), head: str = HEAD) -> Path:
        rng = np.random.default_rng(1)
        for name in clouds:
            write_ply(tmp_path / name, rng.uniform([-300.0, -300.0, -1.0], [300.0, 300.0, 1.0], (600, 3)))
        path = tmp_path / "job.toml"
        path.write_text(head + "".join(columns), encoding="utf-8")
        return path

    return write


def offsets_mm(source: str, kind: Kind) -> Array:
    """(12, 2) mm, measured minus design, by the file's name.

    ``4mm.ply`` holds a bar that is 4 mm off; ``apart.ply`` two bars that are 9 mm too far apart; ``wide-a.ply`` a foot
    and ``wide-b.ply`` bars that go together only with each other; ``mould-3.ply`` one of several feet whose second
    sleeve stands 1 mm off.
    """
    offsets = np.zeros((len(CENTRES), 2))
    if kind is Kind.REBAR and source.startswith("4mm"):
        offsets[4] = [4.0, 0.0]
    if kind is Kind.REBAR and source.startswith("apart"):
        offsets[0], offsets[6] = [-3.2, -3.2], [3.2, 3.2]
    if source.startswith("wide"):
        offsets += np.sign(CENTRES) * 2.6
    if kind is Kind.SLEEVE and source.startswith("mould"):
        offsets += np.random.default_rng(int(source[6])).normal(0.0, 0.1, offsets.shape)
        offsets[1] += [1.0, 0.0]
    return offsets


@pytest.fixture
def exact_extraction(monkeypatch: pytest.MonkeyPatch) -> None:
    """Extraction that finds every centre exactly, in a scan frame that is the column frame."""

    def extract(
        scan: Scan,
        kind: Kind,
        diameters_mm: list[float],
        method: str,
        rng: np.random.Generator,
        places: Array | None = None,
        known: object = None,
    ) -> Extraction:
        up = np.array([0.0, 0.0, 1.0])
        points = tuple(
            AssemblyPoint("", kind, np.array([*xy, 0.0]), up, diameter_mm, 0.01**2 * np.eye(3))
            for xy, diameter_mm in zip(CENTRES + offsets_mm(scan.source, kind), diameters_mm, strict=True)
        )
        return Extraction(kind, method, points, None, up, "exact", quality={"points": len(scan.points)})

    monkeypatch.setattr(measure, "extract_sizes", extract)
