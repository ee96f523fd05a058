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
from aadm_workbench.model import Reason, codes_of
from aadm_workbench.model.reason import listed

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
        return _told(_no_columns(opened, left), _lying_about(loose_sleeves, loose_rebars))
    called = sorted({body.called for body, _ in feet})
    code = "ifc.looked_at" if len(feet) == 1 else "ifc.looked_at.several"
    looked = Reason(code, count=len(feet), called=listed(called, _SHOWN))
    on_head = [entry for entry in left if entry.what == "column" and "ifc.on_head" in codes_of(entry.reason)]
    why = _on_head(on_head) if on_head else _in_feet(feet, search, left)
    return _told(looked, why, _lying_about(loose_sleeves, loose_rebars))


def _told(*sentences: str) -> str:
    """Whole sentences, one behind the other."""
    return Reason("said.sentences", parts=[text for text in sentences if text])


def _on_head(left: Sequence[NotTaken]) -> str:
    called = [entry.names[0] if entry.names else entry.global_id for entry in left]
    return Reason("ifc.column_is", called=listed(called, _SHOWN), why=left[0].reason)


def _no_columns(opened: OpenedIfc, left: Sequence[NotTaken]) -> str:
    if any(entry.what == "column" for entry in left):
        return Reason("ifc.reference_only")
    names: Counter[tuple[str, str]] = Counter()
    for ifc_class in _MAY_BE_COLUMNS:
        names.update((e.is_a(), _kind(text_of(e.Name))) for e in opened.file.by_type(ifc_class))
    says = Reason("ifc.no_column")
    if not names:
        return says
    ranked = names.most_common(_SHOWN)
    shown = [Reason("ifc.called", count=count, type=cls, name=repr(name)) for (cls, name), count in ranked]
    (ifc_class, name), _ = names.most_common(1)[0]
    selector = _selector("columns", ifc_class, name)
    return Reason("said.sentences", parts=[says, Reason("ifc.may_be", shown=shown, selector=selector)])


def _in_feet(feet: Sequence[tuple[ColumnBody, FoundFoot]], search: SleeveSearch, left: Sequence[NotTaken]) -> str:
    """What is round and lies in the feet without being a sleeve."""
    seen: dict[int, tuple[Candidate, str]] = {}
    for body, found in feet:
        for candidate, reason in (*found.refused, *search.refused_in(body, found.foot)):
            seen.setdefault(id(candidate), (candidate, reason))
    if not seen and (undrawn := [entry for entry in left if entry.what == "sleeve" and entry.point is None]):
        reasons = Counter((entry.ifc_class, _of_any(entry.reason)) for entry in undrawn).most_common(_SHOWN)
        return Reason(
            "ifc.left_out", shown=[Reason("ifc.each", count=n, type=cls, why=why) for (cls, why), n in reasons]
        )
    if not seen:
        return Reason("ifc.nothing_round", selector=_selector("sleeves", "IfcDiscreteAccessory", "套筒"))
    groups = Counter((c.element.is_a(), _kind(text_of(c.element.Name)), reason) for c, reason in seen.values())
    ranked = groups.most_common(_SHOWN)
    shown = [
        Reason("ifc.called_each", count=count, type=cls, name=repr(name), why=why) for (cls, name, why), count in ranked
    ]
    (ifc_class, name, _), _ = ranked[0]
    return Reason("ifc.round_things", shown=shown, selector=_selector("sleeves", ifc_class, name))


def _lying_about(loose_sleeves: int, loose_rebars: int) -> str:
    counted = ((loose_sleeves, "sleeve"), (loose_rebars, "upright bar"))
    found = [
        Reason("ifc.counted" if number == 1 else "ifc.counted.several", count=number, what=what)
        for number, what in counted
        if number
    ]
    return Reason("ifc.lying_about", found=found) if found else ""


def _of_any(reason: str) -> str:
    """A reason without the number of the entity that it names, so that those of many elements are alike."""
    return _NUMBER.sub("", reason) if _NUMBER.search(reason) else reason


def _kind(name: str) -> str:
    """A name without the number that programs append to tell elements apart."""
    return _RUNNING_NUMBER.sub("", name.strip())


def _selector(key: str, ifc_class: str, name: str) -> str:
    option = {"columns": "--column", "sleeves": "--sleeves"}[key]
    pattern = re.sub(r'[\\/"\'.^$*+?{}\[\]|()]', ".", name)
    query = f"{ifc_class}, Name=/{pattern}/" if pattern else ifc_class
    return Reason("ifc.selector", option=option, query=query, key=key)
