"""BCF files are valid against the schemas that buildingSMART publishes for 2.1 and 3.0.

The schemas are read from a wheel that holds them (requirements/bcf-schemas.txt), which tests/run.sh puts into build/.
"""

from __future__ import annotations

import copy
import zipfile
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.report.bcf.topics import write_bcf
from tests.report.floor_schemas import made_report
from tests.report.typed import typed

ROOT = Path(__file__).resolve().parents[2]
DAY = datetime(2026, 11, 20, tzinfo=UTC)
HOSTILE = "C'1\"<script>alert(1)</script>\x01灌浆😀 =1+1"
SCHEMA_OF = {
    "markup.bcf": "markup.xsd",
    "viewpoint.bcfv": "visinfo.xsd",
    "project.bcfp": "project.xsd",
    "bcf.version": "version.xsd",
    "extensions.xml": "extensions.xsd",
    "documents.xml": "documents.xsd",
}


@pytest.fixture(scope="module")
def published(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folders v2 and v3 with the schemas."""
    wheels = sorted((ROOT / "build" / "bcf-schemas").glob("bcf_client-*.whl"))
    if not wheels:
        pytest.skip("no schemas in build/bcf-schemas: tests/run.sh fetches them")
    folder = tmp_path_factory.mktemp("schemas")
    with zipfile.ZipFile(wheels[-1]) as wheel:
        for name in wheel.namelist():
            if name.endswith(".xsd"):
                place = folder / name.split("/")[1] / name.rpartition("/")[2]
                place.parent.mkdir(exist_ok=True)
                place.write_bytes(wheel.read(name))
    return folder


@pytest.fixture(scope="module")
def made() -> dict[str, Any]:
    return made_report(ROOT / "samples" / "floor" / "floor3.ifc")


def complaints(path: Path, schemas: Path) -> list[str]:
    """What the schemas have against the files of a BCF; each file of a kind that they know is looked at."""
    xmlschema = pytest.importorskip("xmlschema")
    known = {name: xmlschema.XMLSchema(schemas / xsd) for name, xsd in SCHEMA_OF.items() if (schemas / xsd).exists()}
    found, seen = [], set()
    with zipfile.ZipFile(path) as archive:
        for name in archive.namelist():
            last = name.rpartition("/")[2]
            if last in known:
                seen.add(last)
                text = archive.read(name).decode("utf-8")
                found += [f"{name}: {error.reason}" for error in known[last].iter_errors(text)]
    assert {"markup.bcf", "viewpoint.bcfv", "bcf.version"} <= seen
    return found


@pytest.mark.parametrize(("version", "schemas"), [("2.1", "v2"), ("3.0", "v3")])
@pytest.mark.parametrize("language", ["en", "zh"])
def test_both_versions_are_valid_when_written_and_gone_on_with(
    made: dict[str, Any], published: Path, tmp_path: Path, version: Any, schemas: str, language: Any
) -> None:
    path, report = tmp_path / "report.bcf", copy.deepcopy(made)
    report["columns"][1] |= {"id": HOSTILE, "reasons": [HOSTILE], "storey": "  "}
    report["columns"][2]["global_id"] = None
    write_bcf(typed(report), path, version=version, language=language, written=DAY)
    assert complaints(path, published / schemas) == []
    report["columns"][0]["reasons"] = ["S5 is off"]
    report["columns"][1]["verdict"] = "pass"
    write_bcf(typed(report), path, existing=path, language=language, written=DAY.replace(day=21))
    assert complaints(path, published / schemas) == []


def test_the_schemas_would_complain(made: dict[str, Any], published: Path, tmp_path: Path) -> None:
    path = tmp_path / "report.bcf"
    write_bcf(typed(copy.deepcopy(made)), path, version="3.0", written=DAY)
    assert complaints(path, published / "v2")
