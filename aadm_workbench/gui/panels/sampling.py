"""The panel while columns are looked for: in the shapes of a document, or in the file of a model."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtGui

from aadm_workbench.document.display.messages import complain, tell
from aadm_workbench.document.ifc_file import native_file_of
from aadm_workbench.document.report.annotate import global_ids_of
from aadm_workbench.document.sampling import columns_work, file_work, take_columns
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import AadmError, NoEnvironmentError
from aadm_workbench.gui.chosen import NoColumnError, look_at, select
from aadm_workbench.gui.panels.task_panel import WorkingPanel, close_panel, show_panel
from aadm_workbench.gui.sentences import WAYS_ON, Offer, sentences, show_error
from aadm_workbench.gui.settings import decision, method, tolerances
from aadm_workbench.gui.view_camera import active_view
from aadm_workbench.private.answers import FoundColumns

translate = FreeCAD.Qt.translate


class SamplingPanel(WorkingPanel):
    """Waits for the columns, puts them into the document in one undo step, and opens the panel of the first."""

    ICON = "sample-design"

    def __init__(self, document: Any, objects: Sequence[Any] | None, file: Path | None) -> None:
        super().__init__(translate("AADM_SampleDesign", "Sample design"), document)
        self.document, self.objects = document, objects
        self.file = file or native_file_of(document)
        self.after: After = _open_design
        self.is_alone = not document.Objects
        self.layout.addWidget(QtGui.QLabel(self.file.name if self.file is not None else document.Label))
        self.add_start(translate("AADM_SampleDesign", "Sample"))
        self.layout.addStretch(1)

    def start(self) -> None:
        """Look for columns."""
        try:
            work = columns_work(self.document, self.objects) if self.file is None else file_work(self.file)
            self.have_done(work, self._take, self.show_error)
        except AadmError as error:
            self.show_error(error)

    def _take(self, answer: FoundColumns) -> None:
        objects = None if self.file is not None else self.objects
        if self.file is not None and self.objects:
            kept = _of_selected(answer["columns"], self.objects)
            bodies = dict(zip(answer["columns"], answer["bodies"], strict=False))
            answer = {**answer, "columns": kept, "bodies": [bodies.get(text, []) for text in kept]}
        with undo_step(self.document, translate("AADM_SampleDesign", "Sample design")):
            columns = take_columns(self.document, answer, objects=objects, file=self.file)
            for column in columns:
                column.Method, column.Tolerances, column.Decision = method(), tolerances(), decision()
        for warning in answer["warnings"]:
            complain(warning)
        tell(translate("AADM_SampleDesign", "{count} columns were sampled").format(count=len(columns)))
        close_panel(self)
        select(columns[:1])
        view = active_view()
        if view is not None and self.is_alone:
            view.viewIsometric()  # seen from above, columns are squares
        look_at(columns)
        self.after(columns)

    def show_error(self, error: BaseException) -> None:
        """Say it, and offer the other way in."""
        close_panel(self)
        offers = () if isinstance(error, NoEnvironmentError) else (of_ifc_file(self.document),)
        show_error(self.title, error, *offers)


def sample(document: Any, objects: Sequence[Any] | None = None, file: Path | None = None) -> SamplingPanel:
    """Show the panel and begin."""
    panel = SamplingPanel(document, objects, file)
    show_panel(panel)
    panel.start()
    return panel


After = Callable[[list[Any]], object]


def of_ifc_file(document: Any, after: After | None = None) -> Offer:
    """The offer to take the columns of an IFC file, which FreeCAD need not be able to open; ``after`` gets them.

    Where there is no document, one is made for them.
    """
    return translate("AADM_SampleDesign", "IFC file…"), lambda: _choose(document, after)


def ways_to_columns() -> tuple[Offer, ...]:
    """What leads from a document without columns, or from none, to one with some."""
    document = FreeCAD.ActiveDocument
    from_file = of_ifc_file(document)
    if document is None or not document.Objects:
        return (from_file,)
    return ((translate("AADM_SampleDesign", "Sample design"), lambda: sample(document)), from_file)


def _choose(document: Any, after: After | None) -> None:
    title = translate("AADM_SampleDesign", "Take the columns of an IFC file")
    chosen, _ = QtGui.QFileDialog.getOpenFileName(FreeCADGui.getMainWindow(), title, "", "IFC (*.ifc *.ifczip)")
    if chosen:
        with sentences(title):
            panel = sample(document or FreeCAD.newDocument(Path(chosen).stem), None, Path(chosen))
            if after is not None:
                panel.after = after


def _of_selected(columns: list[str], objects: Sequence[Any]) -> list[str]:
    """The columns that the selected objects are; all where none of them is one."""
    known = {name for obj in objects for name in global_ids_of(obj)}
    return [text for text in columns if json.loads(text)["global_id"] in known] or columns


def _open_design(columns: list[Any]) -> None:
    from aadm_workbench.gui.panels.design import open_panel

    open_panel(columns[0])


WAYS_ON[NoColumnError] = ways_to_columns
