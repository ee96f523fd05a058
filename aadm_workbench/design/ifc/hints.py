"""What a model holds instead of columns with sleeves, and how a person can say what is what."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

from aadm_workbench.design.ifc.columns import ColumnBody
from aadm_workbench.design.ifc.names import text_of
from aadm_workbench.design.ifc.search import FoundFoot, SleeveSearch
from aadm_workbench.design.ifc.sleeves import Candidate
from aadm_workbench.design.ifc.text.file import OpenedIfc
from aadm_workbench.design.model_design import NotTaken

_SHOWN = 4  # of each: more make no sentence
_RUNNING_NUMBER = re.compile(r"[\s:#_.([-]*\d+[)\]]?$")
_NUMBER = re.compile(r"#\d+ ")
_MAY_BE_COLUMNS = ("IfcBuildingElementProxy", "IfcMember", "IfcBeam", "IfcPile", "IfcBuildingElementPart")


def explain(
    opened: OpenedIfc,
    feet: Sequence[tuple[ColumnBody, FoundFoot]],
    search: SleeveSearch,
    left: Sequence[NotTaken],
    loose_sleeves: int,
    loose_rebars: int,
) -> str:
    """Why a model gives no column with sleeves, and which selector would help; empty where it gives some."""
    if any(found.mouths for _, found in feet):
        return ""
    if not feet:
        return " ".join([_no_columns(opened, left), _lying_about(loose_sleeves, loose_rebars)]).strip()
    called = sorted({body.called for body, _ in feet})
    more = f" and {len(called) - _SHOWN} more" if len(called) > _SHOWN else ""
    number = f"{len(feet)} column{'s were' if len(feet) > 1 else ' was'}"
    looked = f"{number} looked at ({', '.join(called[:_SHOWN])}{more}); no grouting sleeve opens in a foot face."
    on_head = [entry for entry in left if entry.what == "column" and "on its head" in entry.reason]
    why = _on_head(on_head) if on_head else _in_feet(feet, search, left)
    return " ".join(text for text in (looked, why, _lying_about(loose_sleeves, loose_rebars)) if text)


def _on_head(left: Sequence[NotTaken]) -> str:
    called = [entry.names[0] if entry.names else entry.global_id for entry in left]
    more = f" and {len(called) - _SHOWN} more" if len(called) > _SHOWN else ""
    return f"Column {', '.join(called[:_SHOWN])}{more} {left[0].reason}."


def _no_columns(opened: OpenedIfc, left: Sequence[NotTaken]) -> str:
    if any(entry.what == "column" for entry in left):
        return "Its columns have no geometry that could be evaluated: export it with bodies, not as a reference only."
    names: Counter[tuple[str, str]] = Counter()
    for ifc_class in _MAY_BE_COLUMNS:
        names.update((e.is_a(), _kind(text_of(e.Name))) for e in opened.file.by_type(ifc_class))
    says = "There is no IfcColumn in it, and nothing called a column."
    if not names:
        return says
    shown = "; ".join(f"{count} {cls} called {name!r}" for (cls, name), count in names.most_common(_SHOWN))
    (ifc_class, name), _ = names.most_common(1)[0]
    return (
        f"{says} What may be one: {shown}. Say which are columns, for instance {_selector('columns', ifc_class, name)}."
    )


def _in_feet(feet: Sequence[tuple[ColumnBody, FoundFoot]], search: SleeveSearch, left: Sequence[NotTaken]) -> str:
    """What is round and lies in the feet without being a sleeve."""
    seen: dict[int, tuple[Candidate, str]] = {}
    for body, found in feet:
        for candidate, reason in (*found.refused, *search.refused_in(body, found.foot)):
            seen.setdefault(id(candidate), (candidate, reason))
    if not seen and (undrawn := [entry for entry in left if entry.what == "sleeve" and entry.point is None]):
        reasons = Counter(f"{entry.ifc_class}: each {_NUMBER.sub('', entry.reason)}" for entry in undrawn)
        return "Left out were " + "; ".join(f"{count} {why}" for why, count in reasons.most_common(_SHOWN)) + "."
    if not seen:
        return (
            "Nothing round lies in their feet: the export may leave out what is cast in (embedded parts, "
            "reinforcement, openings). Sleeves elsewhere, or drawn in another way, are named with "
            f"{_selector('sleeves', 'IfcDiscreteAccessory', '套筒')}."
        )
    groups = Counter((c.element.is_a(), _kind(text_of(c.element.Name)), reason) for c, reason in seen.values())
    ranked = groups.most_common(_SHOWN)
    shown = "; ".join(f"{count} {cls} called {name!r}: each {reason}" for (cls, name, reason), count in ranked)
    (ifc_class, name, _), _ = ranked[0]
    return f"Round things in their feet: {shown}. Where these are sleeves, say {_selector('sleeves', ifc_class, name)}."


def _lying_about(loose_sleeves: int, loose_rebars: int) -> str:
    counted = ((loose_sleeves, "sleeve"), (loose_rebars, "upright bar"))
    found = [f"{number} {what}{'s' if number > 1 else ''}" for number, what in counted if number]
    return f"{' and '.join(found)} of the model belong to no column (see loose)." if found else ""


def _kind(name: str) -> str:
    """A name without the number that programs append to tell elements apart."""
    return _RUNNING_NUMBER.sub("", name.strip())


def _selector(key: str, ifc_class: str, name: str) -> str:
    option = {"columns": "--column", "sleeves": "--sleeves"}[key]
    pattern = re.sub(r'[\\/"\'.^$*+?{}\[\]|()]', ".", name)
    query = f"{ifc_class}, Name=/{pattern}/" if pattern else ifc_class
    return f"{option} '{query}' (in a job: {key} = \"{query}\" in [model])"
