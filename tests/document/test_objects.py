"""Objects in documents: made without a screen, saved, read by another process; of earlier and of newer versions."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import FreeCADRunner
from tests.freecad_environment import with_environment

pytestmark = pytest.mark.freecad

POINT = {
    "global_id": None,
    "scan_mm": None,
    "axis_tilt_deg": 0.1,
    "u_mm": 0.1,
    "limit_mm": 2.0,
    "reason": "",
    "probability": 1.0,
}


SETTING = {
    "against": "control_points",
    "foot_mm": [3.0, 4.0],
    "yaw_deg": 0.0,
    "top_mm": [3.0, 4.0],
    "top_u_mm": 2.7,
    "top_limit_mm": 8.0,
    "top_verdict": "inconclusive",
    "set_pose": [-2.0, -0.004, 0.05],
    "set_pose_top_mm": 3.25,
}


def point(label: str, x: float, y: float, dx: float, verdict: str) -> dict[str, Any]:
    """A point of report.json that was measured dx mm beside its design."""
    return POINT | {
        "label": label,
        "design_mm": [x, y, 0.0],
        "aligned_mm": [x + dx, y, 0.0],
        "offset_mm": [dx, 0.0],
        "deviation_mm": abs(dx),
        "diameter_mm": 36.0,
        "verdict": verdict,
    }


def report(*, x_mm: float = 5000.0) -> dict[str, Any]:
    """A report.json of one column that stands far away, with one sleeve that fails."""
    corners = [(-240.0, -240.0), (240.0, -240.0), (240.0, 240.0), (-240.0, 240.0)]
    points = [
        point(f"S{k + 1}", *corner, 2.5 if k == 1 else 0.5, "fail" if k == 1 else "pass")
        for k, corner in enumerate(corners)
    ]
    column = {
        "id": "C-1",
        "global_id": None,
        "piece_mark": "PCZ-1",
        "storey": "3F",
        "grid": "A/1",
        "size_mm": [600.0, 600.0],
        "T_model_column": [[0, -1, 0, x_mm], [1, 0, 0, 2.0e8], [0, 0, 1, 3600.0], [0, 0, 0, 1]],
        "verdict": "fail",
        "goes_on": "not_assessed",
        "reasons": ["S2 is 2.5 mm from design, limit 2 mm"],
        "sleeves": {"points": points, "spacing": [], "rules": [], "fit": None},
        "rebars": None,
        "trial_assembly": None,
        "hoisting": [],
        "setting": SETTING,
    }
    return {
        "schema": 1,
        "tool": {"name": "aadm", "version": "0.1.0"},
        "job": {"name": "t", "sha256": "0" * 64},
        "capture": {},
        "model": None,
        "profile": {"name": "cn", "rules": []},
        "summary": {"pass": 0, "fail": 1, "inconclusive": 0, "not_measured": 0, "error": 0},
        "columns": [column],
    }


@pytest.fixture(scope="module")
def saved(freecadcmd: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What one process made and saved, and what a fresh one read."""
    folder = tmp_path_factory.mktemp("saved")
    (folder / "report.json").write_text(json.dumps(report()), encoding="utf-8")
    runner = with_environment(FreeCADRunner(freecadcmd, folder))
    made = runner.run(
        "import FreeCAD\n"
        "from aadm_workbench.document import api\n"
        "document = FreeCAD.newDocument('made')\n"
        "(folder / 'x.xyz').write_text('\\n'.join(f'{x} {y} 1000' for x in range(30) for y in range(30)))\n"
        "box = document.addObject('App::FeaturePython', 'NoPlace')\n"
        "column, = api.show(document, folder / 'report.json')\n"
        "design = {'centres': [[-90, -90], [90, -90], [90, 90], [-90, 90]], 'sleeve_diameter': 26.0,\n"
        "          'rebar_diameter': 18.0, 'embedded_length': 100.0, 'size': [250.0, 250.0]}\n"
        "second = api.describe(document, 'L-1', design)\n"
        "second.SleevesUp = '-x'\n"
        "lines = ['%r %r %r' % (x * 0.5, y * 0.5, 1000.0 + (x + y) * 1e-3) for x in range(200) for y in range(100)]\n"
        "(folder / 'cloud.xyz').write_text('\\n'.join(lines))\n"
        "(folder / 'changed.xyz').write_text('\\n'.join(lines))\n"
        "third = api.describe(FreeCAD.newDocument('changed'), 'L-2', design)\n"
        "api.add_scan(third, folder / 'changed.xyz', 'sleeves')\n"
        "(folder / 'changed.xyz').write_text('\\n'.join(lines[1:]))\n"
        "try:\n"
        "    api.check(third)\n"
        "except Exception as error:\n"
        "    result['changed'] = str(error)\n"
        "FreeCAD.setActiveDocument('made')\n"
        "scan = api.add_scan(second, folder / 'cloud.xyz', 'sleeves', most_points=5000)\n"
        "api.add_scan(column, folder / 'x.xyz', 'sleeves')\n"
        "try:\n"
        "    api.check(column)\n"
        "except Exception as error:\n"
        "    result['from_report'] = str(error)\n"
        "document.removeObject(column.Scans[0].Name)\n"
        "document.recompute()\n"
        "again, = api.show(document, folder / 'report.json')\n"
        "document.recompute()\n"
        "result['same'] = again.Name == column.Name and len(api.columns_in(document)) == 2\n"
        "result['touched'] = [obj.Name for obj in document.Objects if 'Touched' in obj.State]\n"
        "result['place'] = list(column.Placement.Base)\n"
        "result['sha256'] = scan.Sha256\n"
        "result['points'] = [scan.PointCount, len(scan.Points)]\n"
        "document.saveAs(str(folder / 'made.FCStd'))\n"
        "newer, = api.show(FreeCAD.newDocument('newer'), folder / 'report.json')\n"
        "newer.Schema = 99\n"
        "newer.Document.saveAs(str(folder / 'newer.FCStd'))\n"
        "older, = api.show(FreeCAD.newDocument('older'), folder / 'report.json')\n"
        "older.Schema = 0\n"
        "older.removeProperty('Turns')\n"
        "older.Result.removeProperty('CheckedAt')\n"
        "older.Result.removeProperty('Top')\n"
        "older.Document.saveAs(str(folder / 'older.FCStd'))\n",
    )
    read = runner.run(
        "import FreeCAD\n"
        "document = FreeCAD.openDocument(str(folder / 'made.FCStd'))\n"
        "from aadm_workbench.document import api\n"
        "from aadm_workbench.document.result import found_of\n"
        "column, second = api.columns_in(document)\n"
        "design = api.column_design(column)\n"
        "result['types'] = sorted(f'{type(obj.Proxy).__module__}.{type(obj.Proxy).__name__}'\n"
        "                         for obj in document.Objects if getattr(obj, 'Proxy', None) is not None)\n"
        "result['state'] = [vars(obj.Proxy) for obj in document.Objects if getattr(obj, 'Proxy', None) is not None]\n"
        "result['place'] = list(column.Placement.Base)\n"
        "result['sleeves'] = [[point.label, point.centre.tolist(), point.diameter_mm] for point in design.sleeves]\n"
        "result['size'] = design.size_mm\n"
        "found = column.Result\n"
        "result['verdict'] = [found.Verdict, found.LargestSleeveDeviation.Value, found.Reasons]\n"
        "result['found'] = found_of(found)\n"
        "result['report'] = api.report_of(document)['summary']\n"
        "result['group'] = [obj.Label for obj in document.Objects if obj.isDerivedFrom('App::DocumentObjectGroup')]\n"
        "scan, = second.Scans\n"
        "result['scan'] = [scan.Sha256, len(scan.Points), scan.Kind, second.SleevesUp]\n"
        "result['valid'] = all(obj.isValid() for obj in document.Objects)\n"
        "newer = FreeCAD.openDocument(str(folder / 'newer.FCStd'))\n"
        "result['newer'] = api.columns_in(newer)[0].Schema\n"
        "older = FreeCAD.openDocument(str(folder / 'older.FCStd'))\n"
        "old, = api.columns_in(older)\n"
        "result['older'] = [old.Schema, old.Turns, old.Result.CheckedAt, old.Result.Verdict]\n"
        "result['setting'] = [found.Top, found.TopVerdict, found.SetPose, old.Result.Top]\n"
        "from aadm_workbench.document.display.setting import setting_said\n"
        "entry = found_of(found)['setting']\n"
        "result['lines'] = setting_said(entry).lines\n"
        "result['alone'] = setting_said(entry | {'against': 'bars', 'set_pose': None})\n"
        "result['unknown'] = setting_said(entry | {'top_mm': None, 'top_verdict': 'not_measured', 'set_pose': None})\n"
        "result['none'] = [setting_said(None), setting_said({})]\n"
    )
    return {"made": made, "read": read}


def test_objects_survive_in_a_fresh_process(saved: dict[str, Any]) -> None:
    made, read = saved["made"], saved["read"]
    assert made["place"] == read["place"] == [5000.0, 2.0e8, 3600.0]
    assert read["sleeves"][1] == ["S2", [240.0, -240.0, 0.0], 36.0]
    assert read["size"] == [600.0, 600.0]
    assert read["verdict"] == ["fail", 2.5, ["S2 is 2.5 mm from design, limit 2 mm"]]
    assert read["found"] == report()["columns"][0]
    assert read["report"] == report()["summary"]
    assert read["scan"] == [made["sha256"], 5000, "sleeves", "-x"]
    assert made["points"] == [20000, 5000]
    assert read["valid"]


def test_a_setting_is_shown_where_a_column_is_looked_at(saved: dict[str, Any]) -> None:
    """The length of (3, 4) is 5; an older document has no such texts; against bars alone there is no word of a grid."""
    read = saved["read"]
    pose = "set_pose = [-2.00, 0.00, 0.050]"
    assert read["setting"] == ["5.00 mm ± 2.70 mm, against the grid", "inconclusive", pose, ""]
    top, aim = read["lines"]
    assert "5.00 mm ± 2.70 mm, against the grid" in top
    assert "inconclusive" in top
    assert f"{pose} in the job: the top comes to 3.25 mm" in aim
    alone = " ".join(map(str, read["alone"]))
    assert "its own bars alone" in alone
    assert "grid" not in alone
    assert read["unknown"][:3] == ["", "not_measured", ""]
    assert "not predicted" in read["unknown"][3][0]
    assert read["none"] == [["", "", "", []]] * 2


def test_module_paths_are_those_that_files_hold(saved: dict[str, Any]) -> None:
    assert sorted(set(saved["read"]["types"])) == [
        "aadm_workbench.document.column.Column",
        "aadm_workbench.document.result.Result",
        "aadm_workbench.document.scan_cloud.ScanCloud",
    ]


def test_proxies_keep_nothing(saved: dict[str, Any]) -> None:
    assert [state for state in saved["read"]["state"] if state] == []


def test_showing_a_report_again_replaces_results(saved: dict[str, Any]) -> None:
    assert saved["made"]["same"]
    assert saved["read"]["group"] == ["AADM checks"]


def test_design_from_a_report_is_not_measured_against(saved: dict[str, Any]) -> None:
    assert "sample its design first" in saved["made"]["from_report"]


def test_scan_that_has_changed_since_its_import_is_refused(saved: dict[str, Any]) -> None:
    assert "changed.xyz: has changed since it was imported" in saved["made"]["changed"]


def test_nothing_is_left_touched(saved: dict[str, Any]) -> None:
    assert saved["made"]["touched"] == []


def test_older_documents_are_brought_up_to_date(saved: dict[str, Any]) -> None:
    assert saved["read"]["older"] == [1, False, "", "fail"]


def test_newer_documents_are_left_alone_with_a_sentence(saved: dict[str, Any]) -> None:
    assert saved["read"]["newer"] == 99
    assert "newer version of the AADM workbench" in saved["read"]["printed"]
