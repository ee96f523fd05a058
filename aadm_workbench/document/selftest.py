"""Self-test in FreeCAD's own test framework: ``freecadcmd -t aadm_workbench.document.selftest``.

FreeCAD lists it among the tests of its workbenches; it looks at what this installation can do, and needs no files.
"""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

import FreeCAD

from aadm_workbench.document import api
from aadm_workbench.errors import ScanError


class ColumnInDocument(unittest.TestCase):
    """A column is made, saved, and comes back."""

    def setUp(self) -> None:
        """A document with one column."""
        self.document = FreeCAD.newDocument("AADMSelfTest")
        corners = [[-240, -240], [240, -240], [240, 240], [-240, 240]]
        design = {"centres": corners, "sleeve_diameter": 36.0, "rebar_diameter": 20.0, "size": [600.0, 600.0]}
        self.column = api.describe(self.document, "C-1", design)

    def tearDown(self) -> None:
        """Leave nothing open."""
        FreeCAD.closeDocument(self.document.Name)

    def test_design_comes_back_from_a_file(self) -> None:
        """Save, close, open."""
        with tempfile.TemporaryDirectory() as folder:
            file = str(Path(folder) / "column.FCStd")
            self.document.saveAs(file)
            FreeCAD.closeDocument(self.document.Name)
            self.document = FreeCAD.openDocument(file)
            (column,) = api.columns_in(self.document)
            assert [point.label for point in api.column_design(column).sleeves] == ["S1", "S2", "S3", "S4"]

    def test_a_column_without_scans_is_refused_with_a_sentence(self) -> None:
        """It says what to do."""
        with self.assertRaisesRegex(ScanError, "import one of its sleeves"):  # noqa: PT027 - FreeCAD runs unittest
            api.check(self.column)
