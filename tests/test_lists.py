"""What several places have to name is one list; a place that cannot read it holds the same words."""

from __future__ import annotations

import argparse
import json
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench import errors
from aadm_workbench.camera import replay
from aadm_workbench.design.model_units import MM_PER_UNIT
from aadm_workbench.design.read import SUPPORTED
from aadm_workbench.extract.method import BY_DESIGN, METHODS
from aadm_workbench.extract.published import hoisting
from aadm_workbench.model import SUMMED, WORST_FIRST, Verdict, worst
from aadm_workbench.report.drawing.sketch import STYLES
from aadm_workbench.report.sheets import xlsx
from aadm_workbench.report.words.labels import COLOUR, FAINT, HEAD, INK
from aadm_workbench.scan.file import CLOUDS, DEPTH_MAPS, TABLES
from aadm_workbench.scan.read import supported_formats
from batch.commands import design
from batch.job import command as job_command
from batch.report_files import _PACKAGES, FORMATS
from batch.switches import exit_code_of

ROOT = Path(__file__).resolve().parents[1]
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
NOT_OF_THE_PROGRAM = {"test"}


def named(requirement: str) -> str:
    """``numpy`` of ``numpy>=1.24``."""
    found = re.match(r"[A-Za-z0-9-]+", requirement)
    assert found
    return found[0]


def listed(extra: str) -> set[str]:
    """What pyproject.toml names for an extra; for none what always comes along."""
    required = PROJECT["optional-dependencies"][extra] if extra else PROJECT["dependencies"]
    return {named(requirement) for requirement in required}


@pytest.mark.parametrize("package", errors.PACKAGES, ids=lambda package: package.pip_name)
def test_each_package_is_brought_by_what_its_message_says(package: errors.Package) -> None:
    assert package.pip_name in listed(package.extra)
    message = str(errors.MissingDependencyError(package.pip_name, "This"))
    assert message.endswith(
        f"pip install '{f'aadm-workbench[{package.extra}]' if package.extra else package.pip_name}'"
    )


def test_every_package_of_the_project_is_in_the_list() -> None:
    known = {name for package in errors.PACKAGES for name in (package.pip_name, *package.others)}
    extras = PROJECT["optional-dependencies"].keys() - NOT_OF_THE_PROGRAM
    assert set().union(*map(listed, extras)) - {"aadm-workbench"} <= known
    assert {package.pip_name for package in errors.PACKAGES if not package.extra} == listed("")


def test_no_command_that_installs_is_written_by_hand() -> None:
    """Only the list knows them, and the workbench, which installs into a folder of its own."""
    files = [path for folder in ("aadm_workbench", "batch") for path in (ROOT / folder).rglob("*.py")]
    texts = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in files}
    assert [name for name, text in texts.items() if "pip install" in text] == ["aadm_workbench/errors.py"]


def test_each_report_names_packages_that_are_known() -> None:
    assert _PACKAGES.keys() <= FORMATS.keys()
    for packages in _PACKAGES.values():
        assert {errors.package_called(name).extra for name in packages} == {"reports"}


def test_the_kinds_of_scan_files_are_those_that_are_read() -> None:
    assert sorted((*DEPTH_MAPS, *CLOUDS, *TABLES)) == sorted(supported_formats())


def test_freecad_opens_all_scans_but_pictures_and_tables_that_may_be_anything() -> None:
    offered = re.findall(r"\*(\.\w+)", (ROOT / "Init.py").read_text(encoding="utf-8").split("open_scan")[0])
    assert {*offered} == {*supported_formats()} - {".png", ".txt", ".csv"}
    assert len(offered) == len({*offered})


def parsed(add_arguments: Any) -> dict[str, argparse.Action]:
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    return {action.dest: action for action in parser._actions}


def test_the_command_names_the_models_and_units_that_are_read() -> None:
    actions = parsed(design.add_arguments)
    told = set(re.findall(r"\.\w+", actions["model"].help or ""))
    assert told == {*SUPPORTED} - {".stp", ".brp"}  # short for .step and .brep
    assert tuple(actions["units"].choices or ()) == tuple(MM_PER_UNIT)


def test_all_name_the_same_methods() -> None:
    assert tuple(METHODS) == job_command.METHODS
    assert job_command.BY_DESIGN == BY_DESIGN
    assert job_command.SCAN_METHODS[1:] == hoisting.METHODS


def test_the_order_of_verdicts_is_that_of_their_sums_and_exit_codes() -> None:
    assert {*WORST_FIRST, Verdict.NOT_ASSESSED} == {*Verdict}
    for index, verdict in enumerate(WORST_FIRST):
        assert worst([*WORST_FIRST[index:][::-1], Verdict.NOT_ASSESSED]) is verdict
    codes = [exit_code_of([verdict]) for verdict in WORST_FIRST]
    assert codes == [12, 10, 11, 11, 0]
    assert worst([]) is Verdict.NOT_MEASURED


def test_the_schema_sums_the_verdicts_in_the_order_of_the_list() -> None:
    schema = json.loads((ROOT / "aadm_workbench" / "resources" / "report.schema.json").read_text(encoding="utf-8"))
    assert schema["properties"]["summary"]["required"] == [*SUMMED]
    assert {*SUMMED} == {*WORST_FIRST}


def test_the_page_has_the_colours_of_the_drawings() -> None:
    folder = ROOT / "aadm_workbench" / "resources" / "report"
    css, js = ((folder / name).read_text(encoding="utf-8") for name in ("report.css", "report.js"))
    assert f"--ink:{INK};--faint:{FAINT};" in css
    assert re.search(rf"^th{{[^}}]*background:{HEAD};", css, re.MULTILINE)
    strokes = {verdict: STYLES[verdict].stroke for verdict in (*WORST_FIRST, Verdict.NOT_ASSESSED)}
    drawn = re.search(r"const colours = {(.*?)}", js)
    assert drawn
    assert dict(re.findall(r"(\w+): \"(#\w+)\"", drawn[1])) == strokes
    assert dict(re.findall(r"\.h-(\w+){border-left-color:(#\w+)}", css)).items() <= strokes.items()
    assert {verdict: colour for verdict, (_, colour) in xlsx._FILLS.items()} == {
        verdict: STYLES[f"fill-{verdict}"].stroke for verdict in strokes
    }
    assert COLOUR.keys() == strokes.keys()


def test_captures_that_are_played_again_hold_what_can_be_read() -> None:
    """But for tables of text: beside a capture these are mostly something else."""
    assert {*DEPTH_MAPS, *CLOUDS, ".npz"} == replay._POINTS
