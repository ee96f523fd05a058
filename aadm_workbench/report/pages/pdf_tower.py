"""The tower on A4: what comes of it, what to do, the plan, and the sheet of the next storey's crew on its own page."""

from __future__ import annotations

from collections.abc import Iterator

from aadm_workbench.report.pages.pdf_flow import Block
from aadm_workbench.report.pages.pdf_parts import Drawing, Paragraph, paragraph
from aadm_workbench.report.pages.pdf_tables import table
from aadm_workbench.report.tower import TowerShown, setting_out_table
from aadm_workbench.report.words.labels import COLOUR, FAINT, INK, MOVE, WARN, Language, phrase

_MOODS = {"good": COLOUR["pass"], "bad": COLOUR["fail"]}


def tower_blocks(tower: TowerShown, width: float, language: Language, share: float = 1.0) -> Iterator[Block]:
    """What the report shows of the tower, on pages ``width`` points wide, its plans smaller by a share."""
    yield _heading("title", width, 13.0, language, bookmark="tower")
    said = tower.headline.in_language(language)
    yield paragraph(said, width, 12.0, bold=True, colour=_MOODS.get(tower.mood, INK), after=4.0)
    yield _note("how_to_read", width, language)
    if tower.warning is not None:
        yield paragraph(tower.warning.in_language(language), width, 9.0, colour=WARN, after=4.0)
    yield from _to_do(tower, width, language)
    for plan in tower.plans:
        name = f"{phrase('stack.plan').in_language(language)} {plan.storey}"
        yield paragraph(name.strip(), width, 12.0, bold=True, keep=True)
        yield _note("plan_note", width, language, scale=plan.scale)
        yield Drawing(plan.sketch, share * width)
    yield from _open_ends(tower, width, language)


def setting_out_blocks(tower: TowerShown, width: float, language: Language) -> Iterator[Block]:
    """The sheet of the next storey's crew; nothing where there is none."""
    if not tower.setting_out:
        return
    yield _heading("setting_out", width, 13.0, language, bookmark="setting-out")
    yield paragraph(phrase("stack.setting_out_note").in_language(language), width, 9.0, after=4.0)
    if tower.warning is not None:
        yield paragraph(phrase("stack.setting_out_relative").in_language(language), width, 9.0, after=4.0)
    yield table(*setting_out_table(tower.setting_out, language), width, language)


def _to_do(tower: TowerShown, width: float, language: Language) -> Iterator[Block]:
    if not tower.to_do:
        return
    yield _heading("to_do", width, 12.0, language)
    for one in tower.to_do:
        colour = MOVE if one.set_pose else INK
        yield paragraph(f"{one.names}: {one.said.in_language(language)}", width, 9.5, colour=colour, after=1.0)
        if one.set_pose:
            yield paragraph(one.set_pose, width, 8.0, colour=FAINT, indent=8.0)
    if any(one.set_pose for one in tower.to_do):
        yield _note("set_pose_note", width, language)


def _open_ends(tower: TowerShown, width: float, language: Language) -> Iterator[Block]:
    if not tower.open_ends:
        return
    yield _heading("open_ends", width, 12.0, language)
    for name, reason in tower.open_ends:
        yield paragraph(f"{name}: {reason.in_language(language)}", width, 8.0, after=1.0)
    yield _note("more", width, language)


def _heading(name: str, width: float, size: float, language: Language, bookmark: str = "") -> Paragraph:
    said = phrase(f"stack.{name}").in_language(language)
    return paragraph(said, width, size, bold=True, keep=True, outline=0 if bookmark else None, bookmark=bookmark)


def _note(name: str, width: float, language: Language, **values: object) -> Paragraph:
    return paragraph(phrase(f"stack.{name}", **values).in_language(language), width, 8.0, colour=FAINT, after=4.0)
