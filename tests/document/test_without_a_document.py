"""What works without a document of ours: moves of versions, files of others, hooks, examples of the API."""

import doctest
from pathlib import Path
from typing import Any

import pytest

from tests.freecad_environment import with_environment

pytestmark = pytest.mark.freecad


def test_migrations_run_in_their_order(freecad: Any) -> None:
    result = freecad.run(
        "import FreeCAD\n"
        "from aadm_workbench.document import schema\n"
        "from aadm_workbench.document.properties import Property\n"
        "obj = FreeCAD.newDocument('old').addObject('App::FeaturePython', 'Old')\n"
        "obj.addProperty('App::PropertyLength', 'Size', 'AADM', '')\n"
        "obj.Size = 600.0\n"
        "def rename(obj):\n"
        "    obj.addProperty('App::PropertyLength', 'Width', 'AADM', '')\n"
        "    obj.Width = obj.Size\n"
        "    obj.removeProperty('Size')\n"
        "schema.bring_up_to_date(obj, [Property('App::PropertyBool', 'New', 'AADM', '', True)], {0: rename})\n"
        "result['found'] = [obj.Width.Value, obj.New, obj.Schema, 'Size' in obj.PropertiesList]\n"
        "obj.New = False\n"
        "schema.bring_up_to_date(obj, [Property('App::PropertyBool', 'New', 'AADM', '', True)], {0: rename})\n"
        "result['again'] = obj.New\n"
    )
    assert result["found"] == [600.0, True, 1, False]
    assert result["again"] is False, "what a user has set stays"


BAD = {
    "nowhere.json": None,
    "cut.json": '{"schema": 1, "columns": [{"id": "C-1", "verd',
    "match.json": '{"schema": 1, "assignments": []}',
    "newer.json": '{"schema": 7, "columns": [{"id": "C-1", "verdict": "pass"}]}',
    "odd.json": '{"schema": 1, "columns": [{"id": "C-1", "verdict": "pass", "sleeves": {"points": [{"label": 1}]}}]}',
    "empty.json": '{"schema": 1, "columns": []}',
}


def test_files_that_are_no_reports_or_scans_get_a_sentence(freecad: Any) -> None:
    for name, text in BAD.items():
        if text is not None:
            (freecad.folder / name).write_text(text, encoding="utf-8")
    (freecad.folder / "broken.ply").write_text("ply\nformat ascii 1.0\nelement vertex 5\n", encoding="utf-8")
    result = with_environment(freecad).run(
        "import FreeCAD\n"
        "from aadm_workbench.errors import AadmError\n"
        "from aadm_workbench.document import api, open_scan\n"
        "from aadm_workbench.document.report import opened as open_report\n"
        "document = FreeCAD.newDocument('bad')\n"
        "result['said'] = {}\n"
        f"for name in {list(BAD)!r}:\n"
        "    try:\n"
        "        api.show(document, folder / name)\n"
        "    except AadmError as error:\n"
        "        result['said'][name] = str(error)\n"
        "    open_report.insert(str(folder / name), document.Name)\n"
        "open_scan.insert(str(folder / 'broken.ply'), document.Name)\n"
        "column = api.describe(document, 'L-1', {'centres': [[0, 0], [90, 0], [0, 90]], 'sleeve_diameter': 26.0})\n"
        "open_scan.insert(str(folder / 'broken.ply'), document.Name)\n"
        "from aadm_workbench.document.asking import LANGUAGES\n"
        "from aadm_workbench.report.words.reasons import in_both_languages\n"
        "LANGUAGES[:] = [lambda sentence: in_both_languages(sentence).zh]  # as a Chinese window does\n"
        "open_report.insert(str(folder / 'nowhere.json'), document.Name)\n"
        "open_scan.insert(str(folder / 'broken.ply'), document.Name)\n"
        "LANGUAGES.clear()\n"
        "for call in (lambda: api.check(column), lambda: api.add_scan(column, folder / 'x.ply', 'sleeves'),\n"
        "             lambda: api.add_scan(column, folder / 'broken.ply', 'feet'),\n"
        "             lambda: api.report_of(document), lambda: api.sample(document)):\n"
        "    try:\n"
        "        call()\n"
        "    except AadmError as error:\n"
        "        result['said'][str(len(result['said']))] = str(error)\n"
    )
    assert len(result["said"]) == len(BAD) + 5, result["said"]
    assert all(len(sentence) > 15 for sentence in result["said"].values())
    assert "Traceback" not in result["printed"]
    assert "broken.ply" in result["printed"]
    assert "nowhere.json：无法读取（" in result["printed"]


def test_examples_of_the_api_run(freecad: Any, repository: Path) -> None:
    text = (repository / "aadm_workbench" / "document" / "api.py").read_text(encoding="utf-8")
    examples = doctest.DocTestParser().get_examples(text.split('"""')[1])
    lines = [example.source for example in examples if "report.json" not in example.source]
    assert len(lines) >= 7
    *work, last = lines
    body = f"import os\nos.chdir({str(repository)!r})\n{''.join(work)}result['verdict'] = {last}"
    result = with_environment(freecad).run(body)
    assert result["verdict"] == "pass"


def test_without_the_environment_a_sentence_says_so(freecad: Any, repository: Path) -> None:
    scans = repository / "samples" / "lab" / "scans"
    result = freecad.run(
        "import FreeCAD, sys\n"
        "from aadm_workbench.document import api, open_scan\n"
        "from aadm_workbench.errors import NoEnvironmentError\n"
        "document = FreeCAD.newDocument('bare')\n"
        "design = {'centres': [[-90, -90], [90, -90], [90, 90], [-90, 90]], 'sleeve_diameter': 26.0}\n"
        "column = api.describe(document, 'L-1', design)\n"
        "result['said'] = []\n"
        f"foot, model = {str(scans / 'L-1-foot.ply')!r}, {str(repository / 'samples/floor/floor3.ifc')!r}\n"
        "for call in (lambda: api.add_scan(column, foot, 'sleeves'), lambda: api.sample(document, file=model),\n"
        "             lambda: api.sample(document)):\n"
        "    try:\n"
        "        call()\n"
        "    except NoEnvironmentError as error:\n"
        "        result['said'].append(str(error))\n"
        "open_scan.insert(foot, document.Name)\n"
    )
    assert len(result["said"]) == 3
    assert all("FreeCAD itself is not changed" in sentence for sentence in result["said"])
    assert result["said"][0] in result["printed"]


def test_import_hooks_are_registered(freecad: Any) -> None:
    from aadm_workbench.scan.read import supported_formats

    result = freecad.run(
        "import FreeCAD\n"
        "from pathlib import Path\n"
        "result['types'] = {name: FreeCAD.getImportType(name) for name in\n"
        "                   ('ply', 'pcd', 'xyz', 'pts', 'asc', 'npz', 'tif', 'tiff', 'json', 'png', 'txt', 'csv')}\n"
    )
    ours = {f".{name}" for name, modules in result["types"].items() if "aadm_workbench.document.open_scan" in modules}
    # FreeCAD has better things to do with pictures and tables; there Import scan is the way in.
    assert ours <= {*supported_formats()}
    assert ours >= {".ply", ".pcd", ".tiff", ".npz"}
    assert "aadm_workbench.document.report.opened" in result["types"]["json"]
    assert result["types"]["ply"][0] != "aadm_workbench.document.open_scan", "others keep the first place"
