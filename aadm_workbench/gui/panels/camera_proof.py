"""The panel in which a camera proves itself: a plate for the workshop, its profile, the check before a shift."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD
from PySide import QtCore, QtGui

from aadm_workbench.document.display.camera_figures import learned_lines, verified_lines
from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.private_process import Work
from aadm_workbench.errors import AadmError
from aadm_workbench.gui import settings
from aadm_workbench.gui.language import language
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.task_panel import WorkingPanel, show_panel
from aadm_workbench.gui.sentences import sentences
from aadm_workbench.scan.file import DEPTH_MAPS

translate = FreeCAD.Qt.translate

_VERIFIED = frozenset({0, 10})  # both are answers: it holds, or it does not
_SCANS = " ".join(f"*{suffix}" for suffix in DEPTH_MAPS)


class CameraProofPanel(WorkingPanel):
    """Three pages, one button that does what the page in front is about, and what came of it above."""

    ICON = "camera-proof"

    def __init__(self) -> None:
        super().__init__(translate("AADM_Camera", "Camera profile"))
        self.in_use = QtGui.QLabel(wordWrap=True)
        self.stop_using = QtGui.QPushButton(translate("AADM_Camera", "Use no profile"))
        self.stop_using.clicked.connect(lambda checked=False: self.use(""))
        self.pages = QtGui.QTabWidget()
        self._add_plate()
        self._add_learn()
        self._add_verify()
        self.pages.currentChanged.connect(self._page_changed)
        self.found = QtGui.QLabel(wordWrap=True)
        self.found.setTextInteractionFlags(QtCore.Qt.TextBrowserInteraction)
        self.found.setOpenExternalLinks(True)
        for part in (self.in_use, self.stop_using, self.found, self.pages):
            self.layout.addWidget(part)
        self.add_start("")
        self.layout.addStretch(1)
        self._page_changed(0)
        self._show_used()

    def _add_plate(self) -> None:
        self.holes, self.diameter = QtGui.QSpinBox(minimum=12, maximum=32, value=12, singleStep=4), _length(36.0)
        self.pitch, self.pins = _length(160.0), _length(20.0)
        self.plate_folder = FileLine(translate("AADM_Camera", "Folder"), "", str(Path.home() / "aadm-plate"))
        self._add_page(
            translate("AADM_Camera", "Plate"),
            translate("AADM_Camera", "A plate with holes like sleeves and pins like bars, for a workshop to make."),
            (
                (translate("AADM_Camera", "Holes"), self.holes),
                (translate("AADM_Camera", "Their diameter"), self.diameter),
                (translate("AADM_Camera", "Pitch"), self.pitch),
                (translate("AADM_Camera", "Pins, diameter"), self.pins),
                (translate("AADM_Camera", "Folder"), self.plate_folder),
            ),
        )

    def _add_learn(self) -> None:
        self.plate = FileLine(translate("AADM_Camera", "Plate"), "*.toml")
        self.captures = QtGui.QListWidget()
        self.captures.setMaximumHeight(90)
        self.add_captures = QtGui.QPushButton(translate("AADM_Camera", "Choose captures…"))
        self.add_captures.clicked.connect(lambda checked=False: self._choose_captures())
        self.camera = FileLine(translate("AADM_Camera", "Intrinsics"), "*.toml *.json *.txt", settings.camera_file())
        self.depth_step = QtGui.QDoubleSpinBox(decimals=5, maximum=1000.0, singleStep=0.01, suffix=" mm")
        self.depth_step.setSpecialValueText(translate("AADM_Camera", "not given"))
        self.serial, self.settings, self.date = QtGui.QLineEdit(), QtGui.QLineEdit(), QtGui.QLineEdit()
        self.date.setPlaceholderText("2026-11-20")
        self.profile = FileLine(translate("AADM_Camera", "Profile"), "*.toml", save=True)
        self._add_page(
            translate("AADM_Camera", "Learn"),
            translate(
                "AADM_Camera",
                "Six to twelve captures of the whole plate: two distances, tilted up to 5°, turned by quarter turns.",
            ),
            (
                (translate("AADM_Camera", "Plate"), self.plate),
                (translate("AADM_Camera", "Captures"), self.captures),
                ("", self.add_captures),
                (translate("AADM_Camera", "Intrinsics"), self.camera),
                (translate("AADM_Camera", "Depth step"), self.depth_step),
                (translate("AADM_Camera", "Serial number"), self.serial),
                (translate("AADM_Camera", "Settings"), self.settings),
                (translate("AADM_Camera", "Date"), self.date),
                (translate("AADM_Camera", "Profile to write"), self.profile),
            ),
        )

    def _add_verify(self) -> None:
        self.today = FileLine(translate("AADM_Camera", "Capture"), _SCANS, folder=True)
        self.verified_profile = FileLine(translate("AADM_Camera", "Profile"), "*.toml", settings.camera_profile())
        self._add_page(
            translate("AADM_Camera", "Verify"),
            translate("AADM_Camera", "One capture before the shift. Plate, intrinsics and date are those of Learn."),
            (
                (translate("AADM_Camera", "Capture"), self.today),
                (translate("AADM_Camera", "Profile"), self.verified_profile),
            ),
        )

    def _add_page(self, title: str, said: str, rows: tuple[tuple[str, Any], ...]) -> None:
        page, form = QtGui.QWidget(), QtGui.QFormLayout()
        form.setRowWrapPolicy(QtGui.QFormLayout.WrapLongRows)
        form.addRow(QtGui.QLabel(said, wordWrap=True))
        for text, widget in rows:
            form.addRow(text, widget)
        page.setLayout(form)
        self.pages.addTab(page, title)

    def _page_changed(self, page: int) -> None:
        # the button stands right below the page in front, however long the others are
        for number in range(self.pages.count()):
            policy = QtGui.QSizePolicy.Preferred if number == page else QtGui.QSizePolicy.Ignored
            self.pages.widget(number).setSizePolicy(QtGui.QSizePolicy.Preferred, policy)
        self.start_button.setText(
            (
                translate("AADM_Camera", "Draw the plate"),
                translate("AADM_Camera", "Learn the camera"),
                translate("AADM_Camera", "Verify the camera"),
            )[page]
        )

    def _choose_captures(self) -> None:
        title = translate("AADM_Camera", "Captures of the plate")
        files, _ = QtGui.QFileDialog.getOpenFileNames(self.form, title, "", f"{title} ({_SCANS})")
        self.set_captures(files)

    def set_captures(self, files: list[str]) -> None:
        """Show these captures instead of those before."""
        self.captures.clear()
        for file in files:
            item = QtGui.QListWidgetItem(Path(file).name, self.captures)
            item.setToolTip(file)

    def use(self, profile: str) -> None:
        """Check with this profile from now on; empty: with none."""
        settings.remember_camera_profile(profile)
        self._show_used()

    def _show_used(self) -> None:
        used = settings.camera_profile()
        said = translate("AADM_Camera", "Checks use {file}").format(file=Path(used).name)
        self.in_use.setText(said if used else translate("AADM_Camera", "Checks use no profile of a camera."))
        self.in_use.setToolTip(used)
        self.stop_using.setVisible(bool(used))

    def start(self) -> None:
        """Do what the page in front is about."""
        with sentences(self.title):
            self.found.setText("")
            (self._draw, self._learn, self._verify)[self.pages.currentIndex()]()

    def _draw(self) -> None:
        folder = _named(self.plate_folder, translate("AADM_Camera", "Choose the folder to write into."))
        numbers = (("holes", self.holes), ("diameter", self.diameter), ("pitch", self.pitch), ("pins", self.pins))
        words = [word for name, box in numbers for word in (f"--{name}", f"{box.value():g}")]
        arguments = ["camera", "plate", *words, "--out", str(folder), "--language", language(), "--quiet"]
        self.have_done(Work(arguments), lambda _: self._drawn(folder))

    def _drawn(self, folder: Path) -> None:
        self.plate.set_text(str(folder / "plate.toml"))
        tell(translate("AADM_Camera", "Written: {folder}").format(folder=folder))
        self._show([translate("AADM_Camera", "plate.pdf, plate.dxf, plate.step and plate.toml are in")], folder)

    def _learn(self) -> None:
        plate = _named(self.plate, translate("AADM_Camera", "Choose the plate.toml of the plate."))
        profile = _named(self.profile, translate("AADM_Camera", "Choose the file that the profile is written to."))
        files = [self.captures.item(row).toolTip() for row in range(self.captures.count())]
        if not files:
            raise AadmError(translate("AADM_Camera", "Choose the captures of the plate."))
        arguments = ["camera", "learn", str(plate), *files, "--out", str(profile), *self._words()]
        arguments += ["--serial", self.serial.text().strip(), "--settings", self.settings.text().strip()]
        self.have_done(Work(arguments), lambda _: self._learned(profile))

    def _learned(self, profile: Path) -> None:
        self.verified_profile.set_text(str(profile))
        self.use(str(profile))
        self._show(learned_lines(profile), profile)

    def _verify(self) -> None:
        plate = _named(self.plate, translate("AADM_Camera", "Choose the plate.toml of the plate, on the page Learn."))
        today = _named(self.today, translate("AADM_Camera", "Choose the capture of the plate."))
        profile = _named(self.verified_profile, translate("AADM_Camera", "Choose the profile of the camera."))
        log, chart = (profile.with_name(f"{profile.stem}-{end}") for end in ("log.csv", "chart.html"))
        arguments = ["camera", "verify", str(plate), str(today), "--profile", str(profile), "--log", str(log)]
        arguments += ["--html", str(chart), *self._words()]
        self.have_done(Work(arguments, codes=_VERIFIED), lambda _: self._show(verified_lines(log), chart))

    def _words(self) -> list[str]:
        """What learning and verifying are told alike."""
        words = ["--date", self.date.text().strip()]
        if self.camera.text():
            words += ["--camera", str(Path(self.camera.text()).resolve())]
        if self.depth_step.value() > 0.0:
            words += ["--depth-scale", f"{self.depth_step.value():g}"]
        return words

    def _show(self, lines: list[str], place: Path) -> None:
        url = QtCore.QUrl.fromLocalFile(str(place)).toString()
        self.found.setText("<br>".join([*lines, f'<a href="{url}">{place.name}</a>']))


def _named(line: FileLine, otherwise: str) -> Path:
    """The path that a line holds; AadmError, which says what to choose, where it is empty."""
    if not line.text():
        raise AadmError(otherwise)
    return Path(line.text()).resolve()


def _length(value: float) -> Any:
    return QtGui.QDoubleSpinBox(decimals=2, minimum=1.0, maximum=2000.0, value=value, suffix=" mm")


def open_panel() -> CameraProofPanel:
    """Show the panel."""
    panel = CameraProofPanel()
    show_panel(panel)
    return panel
