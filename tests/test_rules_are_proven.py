"""Each rule of the house notices what it forbids and lets pass what it allows."""

import ast

import pytest

from tests.test_architecture import (
    RULES,
    Rule,
    broken,
    core_starts_without_extras,
    extract_and_assembly_are_pure,
    freecad_only_in_document_and_gui,
    ifcopenshell_only_in_ifc_files,
    no_grab_bags,
    no_long_files,
    nothing_listens,
    open3d_only_in_published_and_twin,
    package_never_imports_batch,
    stages_import_from_the_left,
    window_only_in_gui,
)

BREAKS = [
    (freecad_only_in_document_and_gui, "aadm_workbench/report/pages/html.py", "import FreeCAD"),
    (freecad_only_in_document_and_gui, "batch/main.py", "def go():\n    import FreeCAD as App"),
    (
        freecad_only_in_document_and_gui,
        "aadm_workbench/scan/formats/ply.py",
        "from importlib import import_module as m\nm.import_module('Part')",
    ),
    (window_only_in_gui, "aadm_workbench/document/column.py", "from PySide import QtCore"),
    (window_only_in_gui, "aadm_workbench/document/column.py", "if True:\n    import FreeCADGui"),
    (window_only_in_gui, "Init.py", "import FreeCADGui"),
    (ifcopenshell_only_in_ifc_files, "aadm_workbench/design/mesh.py", "import ifcopenshell.geom"),
    (ifcopenshell_only_in_ifc_files, "aadm_workbench/scan/ifc.py", "from ifcopenshell import guid"),
    (ifcopenshell_only_in_ifc_files, "batch/main.py", "import ifcopenshell"),
    (open3d_only_in_published_and_twin, "aadm_workbench/extract/plane.py", "import open3d as o3d"),
    (open3d_only_in_published_and_twin, "aadm_workbench/extract/published.py", "__import__('open3d')"),
    (
        stages_import_from_the_left,
        "aadm_workbench/scan/formats/ply.py",
        "from aadm_workbench.extract.plane import Plane",
    ),
    (stages_import_from_the_left, "aadm_workbench/design/mesh.py", "from aadm_workbench import scan"),
    (stages_import_from_the_left, "aadm_workbench/assembly/trial/virtual.py", "from ...report import json"),
    (stages_import_from_the_left, "aadm_workbench/extract/published/hough.py", "from ...assembly.eopa import fit"),
    (stages_import_from_the_left, "aadm_workbench/report/json.py", "import aadm_workbench.twin.scene"),
    (stages_import_from_the_left, "aadm_workbench/model.py", "from aadm_workbench.scan import read"),
    (stages_import_from_the_left, "aadm_workbench/model/scan.py", "from aadm_workbench.scan import read"),
    (stages_import_from_the_left, "aadm_workbench/inspection/check.py", "from aadm_workbench.twin import scene"),
    (
        stages_import_from_the_left,
        "aadm_workbench/report/json.py",
        "from aadm_workbench.inspection.check import check_column",
    ),
    (package_never_imports_batch, "aadm_workbench/gui/check.py", "from aadm_batch.job.table import JobTable"),
    (package_never_imports_batch, "aadm_workbench/report/pages/html.py", "import batch"),
    (extract_and_assembly_are_pure, "aadm_workbench/extract/plane.py", "with open('x') as f: pass"),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/extract/plane.py",
        "def f(scan):\n    return scan.source.read_bytes()",
    ),
    (extract_and_assembly_are_pure, "aadm_workbench/extract/plane.py", "import numpy as np\nnp.load('x.npy')"),
    (extract_and_assembly_are_pure, "aadm_workbench/extract/plane.py", "import cv2\ncv2.imread('x.png')"),
    (extract_and_assembly_are_pure, "aadm_workbench/extract/published/hough.py", "from pathlib import Path"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/trial/virtual.py", "print('passed')"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/trial/virtual.py", "from time import perf_counter"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/trial/virtual.py", "import datetime"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/trial/virtual.py", "import random"),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/assembly/trial/virtual.py",
        "import numpy as np\nnp.random.normal(0, 1)",
    ),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/assembly/trial/virtual.py",
        "import numpy as np\nnp.random.default_rng(1)",
    ),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/trial/virtual.py", "from numpy.random import default_rng"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/tolerances.py", "import time"),
    (extract_and_assembly_are_pure, "aadm_workbench/assembly/tolerances.py", "print(1)"),
    (no_grab_bags, "aadm_workbench/scan/utils.py", ""),
    (no_grab_bags, "aadm_workbench/common/plane.py", ""),
    (no_grab_bags, "batch/Manager.py", ""),
    (core_starts_without_extras, "aadm_workbench/report/sheets/xlsx.py", "import openpyxl"),
    (core_starts_without_extras, "aadm_workbench/design/mesh.py", "from trimesh.proximity import signed_distance"),
    (nothing_listens, "batch/runner/cluster.py", "import distributed\ndistributed.LocalCluster(host='127.0.0.1')"),
    (nothing_listens, "batch/runner/local_worker.py", "distributed.Worker('tcp://127.0.0.1:1')"),
    (nothing_listens, "batch/runner/run.py", "import socket\nsocket.socket().bind(('127.0.0.1', 0))"),
    (nothing_listens, "aadm_workbench/gui/jobs.py", "from http.server import HTTPServer"),
    (nothing_listens, "batch/runner/run.py", "from multiprocessing.connection import Listener"),
    (no_long_files, "aadm_workbench/scan/formats/ply.py", "x = 1\n" * 351),
]
KEEPS = [
    (freecad_only_in_document_and_gui, "aadm_workbench/document/column.py", "import FreeCAD, Part"),
    (freecad_only_in_document_and_gui, "aadm_workbench/twin/parts.py", "from aadm_workbench.twin.Part import Part"),
    (window_only_in_gui, "aadm_workbench/gui/panel.py", "from PySide import QtGui\nfrom pivy import coin"),
    (window_only_in_gui, "InitGui.py", "import FreeCADGui"),
    (ifcopenshell_only_in_ifc_files, "aadm_workbench/design/ifc/geometry/placement.py", "import ifcopenshell"),
    (ifcopenshell_only_in_ifc_files, "aadm_workbench/report/ifc/model.py", "import ifcopenshell.api"),
    (open3d_only_in_published_and_twin, "aadm_workbench/extract/published/cloud.py", "import open3d"),
    (open3d_only_in_published_and_twin, "aadm_workbench/twin/raycast.py", "def f():\n    import open3d"),
    (
        stages_import_from_the_left,
        "aadm_workbench/report/json.py",
        "from aadm_workbench.design.ifc.model import columns",
    ),
    (
        stages_import_from_the_left,
        "aadm_workbench/report/json.py",
        "from aadm_workbench import __version__, errors, model",
    ),
    (
        stages_import_from_the_left,
        "aadm_workbench/model/scan.py",
        "from .camera import Camera\nfrom ..errors import AadmError",
    ),
    (
        stages_import_from_the_left,
        "aadm_workbench/scan/formats/ply.py",
        "from .points import Points\nfrom ..model import Scan",
    ),
    (stages_import_from_the_left, "aadm_workbench/twin/scene.py", "from aadm_workbench.scan.camera import Camera"),
    (stages_import_from_the_left, "aadm_workbench/inspection/check.py", "from aadm_workbench.report import json"),
    (stages_import_from_the_left, "batch/main.py", "from aadm_workbench.report import json"),
    (package_never_imports_batch, "batch/main.py", "from aadm_batch.job.table import JobTable"),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/assembly/tolerances.py",
        "from pathlib import Path\nPath('x').read_text()",
    ),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/extract/plane.py",
        "def f(rng: 'np.random.Generator'): return rng.normal()",
    ),
    (extract_and_assembly_are_pure, "aadm_workbench/scan/formats/ply.py", "open('x')"),
    (
        extract_and_assembly_are_pure,
        "aadm_workbench/extract/published/ransac_plane.py",
        "def f(open3d, rng): open3d.utility.random.seed(int(rng.integers(9)))",
    ),
    (no_grab_bags, "aadm_workbench/design/baseline.py", ""),
    (core_starts_without_extras, "aadm_workbench/design/mesh.py", "import json\ndef read():\n    import trimesh"),
    (core_starts_without_extras, "aadm_workbench/design/mesh.py", "import numpy as np\nfrom .paths import kind"),
    (core_starts_without_extras, "aadm_workbench/twin/meshes.py", "import manifold3d"),
    (nothing_listens, "batch/runner/cluster.py", "import distributed\ndistributed.Client('tls://h:1')"),
    (nothing_listens, "batch/link/opcua.py", "server.start_server()"),
    (nothing_listens, "tests/batch/test_tls.py", "socket.create_server(('127.0.0.1', 0))"),
    (no_long_files, "aadm_workbench/scan/formats/ply.py", "x = 1\n" * 350),
]


@pytest.mark.parametrize(("rule", "path", "source"), BREAKS)
def test_rule_notices_what_it_forbids(rule: Rule, path: str, source: str) -> None:
    assert broken(rule, path, ast.parse(source))


@pytest.mark.parametrize(("rule", "path", "source"), KEEPS)
def test_rule_lets_pass_what_it_allows(rule: Rule, path: str, source: str) -> None:
    assert broken(rule, path, ast.parse(source)) == []


def test_every_rule_is_proven() -> None:
    assert (
        {id(rule) for rule in RULES.values()}
        == {id(rule) for rule, _, _ in BREAKS}
        == {id(rule) for rule, _, _ in KEEPS}
    )
