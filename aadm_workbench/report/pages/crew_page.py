"""crew.pdf: one A4 for each column, Chinese and English, to be read from two metres."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from aadm_workbench.model import ColumnReport, JobReport, Kind
from aadm_workbench.report.column_view import declared_up
from aadm_workbench.report.findings import Finding, findings
from aadm_workbench.report.pages.crew import CrewAdvice, Step, crew_advice
from aadm_workbench.report.pages.crew_sketch import crew_sketch, rings_of, sleeves_from_below
from aadm_workbench.report.pages.pdf_canvas import A4, MM, draw_sketch, end_page, pages, write, write_lines
from aadm_workbench.report.pages.pdf_text import lines_of, reportlab, width_of
from aadm_workbench.report.words.labels import COLOUR, FAINT, HEAD, INK, WARN, Language, phrase

_LIGHT = {"green": COLOUR["pass"], "amber": "#e0a100", "red": COLOUR["fail"]}
_ON_LIGHT = {"green": "#ffffff", "amber": INK, "red": "#ffffff"}
_LEFT, _RIGHT = 15.0 * MM, 195.0 * MM  # margins of 15 mm on A4: printers reach as far
_WIDTH = _RIGHT - _LEFT


def write_crew_pages(report: JobReport, path: Path, language: Language = "zh") -> None:
    """Write crew.pdf, whole or not at all; both languages are on every page, ``language`` stands first and larger.

    Raises
    ------
    MissingDependencyError
        Without the package reportlab.
    AadmError
        Where the file cannot be written.
    """
    title = f"{report.job['name']}: {phrase('crew.do_this').en}"
    with pages(path, title, "crew.pdf") as canvas:
        for finding in findings(report):
            _Page(canvas, language).draw(report, finding)
            end_page(canvas)


class _Page:
    """Draws one page from the top down; ``y`` is where it has come to, pt."""

    def __init__(self, canvas: Any, language: Language) -> None:
        self.canvas = canvas
        self.first: Language = language
        self.second: Language = "en" if language == "zh" else "zh"
        self.y = A4[1]

    def draw(self, report: JobReport, finding: Finding) -> None:
        """The whole page."""
        column, advice = finding.column, crew_advice(report, finding.column)
        self._band(column, advice)
        self._steps(advice)
        self._reasons(finding)
        self._foot(report, column, advice)

    def _band(self, column: ColumnReport, advice: CrewAdvice) -> None:
        """The traffic light, the column's name and what to do, across the page."""
        canvas, colors = self.canvas, reportlab("lib.colors")
        height = 62.0 * MM
        canvas.setFillColor(colors.HexColor(_LIGHT[advice.light]))
        canvas.rect(0, A4[1] - height, A4[0], height, stroke=0, fill=1)
        self._lamps(advice.light, A4[1] - height)
        ink = _ON_LIGHT[advice.light]
        x, wide = _LEFT + 30.0 * MM, _WIDTH - 30.0 * MM
        place = " · ".join(str(part) for part in (column.grid, column.storey, column.piece_mark) if part)
        size = next((s for s in (40.0, 30.0, 22.0) if len(lines_of(column.id, s, wide)) == 1), 16.0)
        write_lines(canvas, (x, A4[1] - 21.0 * MM), column.id, size, wide, colour=ink, bold=True, most=1)
        write_lines(canvas, (x, A4[1] - 29.0 * MM), place, 14.0, wide, colour=ink, most=1)
        said = advice.headline
        write(canvas, (x, A4[1] - 44.0 * MM), said.in_language(self.first), 30.0, colour=ink, bold=True)
        write(canvas, (x, A4[1] - 54.0 * MM), said.in_language(self.second), 18.0, colour=ink, bold=True)
        self.y = A4[1] - height - 11.0 * MM

    def _lamps(self, light: str, low: float) -> None:
        """Red above, green below, as on a street: the place says it where colours do not."""
        canvas, colors = self.canvas, reportlab("lib.colors")
        canvas.setFillColor(colors.HexColor(INK))
        canvas.roundRect(_LEFT, low + 5.0 * MM, 19.0 * MM, 52.0 * MM, 4.0 * MM, stroke=0, fill=1)
        for k, (name, sign) in enumerate((("red", "×"), ("amber", "?"), ("green", "✓"))):
            centre = (_LEFT + 9.5 * MM, low + (48.0 - 17.0 * k) * MM)
            lit = name == light
            canvas.setFillColor(colors.HexColor(_LIGHT[name] if lit else "#44505b"))
            canvas.circle(*centre, 7.2 * MM, stroke=0, fill=1)
            if lit:
                write(
                    canvas, (centre[0], centre[1] - 8.0), sign, 24.0, colour=_ON_LIGHT[name], bold=True, anchor="middle"
                )

    def _title(self, name: str) -> None:
        text = phrase(name)
        said = f"{text.in_language(self.first)}  {text.in_language(self.second)}"
        self.y -= 1.0 * MM
        write(self.canvas, (_LEFT, self.y), said, 12.0, colour=FAINT, bold=True)
        self.y -= 8.0 * MM

    def _steps(self, advice: CrewAdvice) -> None:
        """Numbered, in both languages; what needs the engineer's release says so at the step itself."""
        self._title("crew.do_this")
        large = 17.0 if len(advice.steps) <= 4 else 12.0
        for number, step in enumerate(advice.steps, start=1):
            if self.y < 120.0 * MM and number <= len(advice.steps) and len(advice.steps) > 6:
                large = 10.0
            self._step(number, step, large)

    def _step(self, number: int, step: Step, size: float) -> None:
        canvas, colors = self.canvas, reportlab("lib.colors")
        canvas.setFillColor(colors.HexColor(HEAD))
        canvas.circle(_LEFT + 5.0 * MM, self.y + 0.32 * size, 0.62 * size, stroke=0, fill=1)
        write(canvas, (_LEFT + 5.0 * MM, self.y), str(number), 0.8 * size, colour="#ffffff", bold=True, anchor="middle")
        x, wide = _LEFT + 13.0 * MM, _WIDTH - 13.0 * MM
        top = self.y
        self.y = write_lines(canvas, (x, self.y), step.text.in_language(self.first), size, wide, bold=True)
        self.y = write_lines(canvas, (x, self.y + 0.1 * size), step.text.in_language(self.second), 0.72 * size, wide)
        if step.release:
            said = phrase("crew.after_release")
            both = f"{said.in_language(self.first)}  {said.in_language(self.second)}"
            self.y = write_lines(canvas, (x, self.y), both, 0.72 * size, wide, colour=WARN, bold=True)
        if step.left is not None:
            self.y = write_lines(canvas, (x, self.y), step.left.in_language(self.first), 0.72 * size, wide)
            self.y = write_lines(
                canvas, (x, self.y), step.left.in_language(self.second), 0.6 * size, wide, colour=FAINT
            )
        self.y = min(self.y, top - 1.6 * size) - 0.8 * size

    def _reasons(self, finding: Finding) -> None:
        """The decisive ones; the second language below the first where there is room."""
        if not finding.key_reasons or self.y < 135.0 * MM:
            return
        self._title("crew.why")
        for reason in finding.key_reasons:
            self.y = write_lines(self.canvas, (_LEFT, self.y), reason.in_language(self.first), 12.0, _WIDTH, most=2)
            if reason.en != reason.zh:
                said = reason.in_language(self.second)
                self.y = write_lines(self.canvas, (_LEFT, self.y), said, 9.0, _WIDTH, colour=FAINT, most=2)
            self.y -= 5.0
        if finding.more:
            more = phrase("crew.more_reasons", number=finding.more)
            said = f"{more.in_language(self.first)}  {more.in_language(self.second)}"
            write(self.canvas, (_LEFT, self.y), said, 9.0, colour=FAINT)
            self.y -= 4.0 * MM

    def _foot(self, report: JobReport, column: ColumnReport, advice: CrewAdvice) -> None:
        """The sketch in the lower half, beside it the foot from below and the box for the engineer's signature."""
        canvas = self.canvas
        low = 20.0 * MM
        side = max(60.0 * MM, min(112.0 * MM, self.y - low - 16.0 * MM))
        beside, narrow = _LEFT + side + 6.0 * MM, _WIDTH - side - 6.0 * MM
        below = sleeves_from_below(column)
        bars_matter = rings_of(column, Kind.REBAR) or any(p.verdict != "pass" for p in column.points(Kind.REBAR))
        if below is not None and not bars_matter and not advice.shifts:
            self._caption("crew.from_below", (_LEFT, low + side + 2.0 * MM), _WIDTH)
            draw_sketch(canvas, below, (_LEFT, low), side)
        elif column.rebars or column.sleeves or advice.shifts:
            shown = "crew.sleeves_from_above" if column.sleeves and not column.rebars else "crew.from_above"
            self._caption(shown, (_LEFT, low + side + 2.0 * MM), side if below is not None else _WIDTH)
            draw_sketch(canvas, crew_sketch(column, advice, self.first), (_LEFT, low), side)
            if below is not None:
                width = min(narrow, side - 40.0 * MM)
                self._caption("crew.from_below", (beside, low + side + 2.0 * MM), narrow)
                draw_sketch(canvas, below, (beside, low + side - width - 4.0 * MM), width)
        if any(step.release for step in advice.steps) or advice.light == "red":
            self._signature((beside, low), narrow)
        up = declared_up(column)
        if up is not None:
            word = phrase("ui.as_declared")
            said = f"{word.in_language(self.first)} / {word.in_language(self.second)}: {up}"
            write_lines(canvas, (_LEFT, 15.5 * MM), said, 9.0, 0.7 * _WIDTH, bold=True, most=1)
        job = f"{report.job['name']} · {report.capture.get('date', '')}".rstrip(" ·")
        write_lines(canvas, (_LEFT, 11.0 * MM), f"{job} · report.json", 8.0, 0.7 * _WIDTH, colour=FAINT, most=1)
        number = f"{report.job['sha256'][:12]}"
        write(canvas, (_RIGHT, 11.0 * MM), number, 8.0, colour=FAINT, anchor="end")

    def _caption(self, name: str, at: tuple[float, float], width: float) -> None:
        text = phrase(name)
        said = f"{text.in_language(self.first)} · {text.in_language(self.second)}"
        size = next((size for size in (9.0, 8.0, 7.0, 6.0) if width_of(said, size) <= width), 6.0)
        write_lines(self.canvas, at, said, size, width, colour=FAINT, most=1)

    def _signature(self, at: tuple[float, float], width: float) -> None:
        canvas, colors = self.canvas, reportlab("lib.colors")
        canvas.setStrokeColor(colors.HexColor(WARN))
        canvas.setLineWidth(1.2)
        canvas.rect(at[0], at[1], width, 34.0 * MM, stroke=1, fill=0)
        said = phrase("crew.signature")
        inside = (at[0] + 3.0 * MM, at[1] + 28.0 * MM)
        y = write_lines(canvas, inside, said.in_language(self.first), 10.0, width - 6.0 * MM, bold=True)
        write_lines(canvas, (inside[0], y), said.in_language(self.second), 8.0, width - 6.0 * MM)
