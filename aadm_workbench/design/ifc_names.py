"""What an element is called and what that says: sleeve, connecting rebar, column, or something else in steel."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from aadm_workbench.errors import DesignError

SLEEVE = re.compile(
    r"灌[浆漿]套[筒管]|[全半]灌[浆漿]|钢筋套筒|鋼筋套筒|连接套筒|連接套筒|套筒|波[纹紋]管|浆锚孔|漿錨孔|预留孔|預留孔"
    # Marks of JG/T 398 such as GTQ4Z-20, GTB4J-20-A, GTZQ4 20.
    r"|GT[ZJQB]{1,2}\d[ZJ]?[- ]?\d{2}(/\d{2})?[A-Z]?"
    r"|grout(ed|ing)?[ _-]?(splice[ _-]?)?(sleeve|coupler)|splice[ _-]?sleeve|grout[ _-]?tube|corrugated duct"
    r"|\bsleeves?\b|rebar[ _-]?coupler|\bcouplers?\b|\bNMB\b|Interlok|Groutec|Sleeve-?Lock"
    r"|スプライススリーブ|スリーブ|モルタル充填(式)?継手|機械式継手"
    r"|\bMuffe|Bewehrungsanschluss|Wellrohr|Hüllrohr|koppelhuls|gainebuis|\bgaine\b|stekkenbuis",
    re.IGNORECASE,
)
NOT_SLEEVE = re.compile(
    r"防水套管|刚性套管|剛性套管|柔性套管|穿墙套管|穿牆套管|止水|吊装|吊裝|斜撑|斜撐|脱模|脫模|预埋螺母|預埋螺母|预埋管|线管|线盒"
    r"|lifting|\bbrac(e|ing)\b|pipe[ _-]?sleeve|threaded[ _-]?(insert|socket)|\banchor[ _-]?nut|吊り|Durchführung",
    re.IGNORECASE,
)
REBAR = re.compile(
    r"连接钢筋|連接鋼筋|连接筋|插筋|预留钢筋|預留鋼筋|外露钢筋|伸出钢筋|甩筋|锚筋|錨筋|竖向(受力)?钢筋|纵筋|縱筋|纵向钢筋|主筋"
    r"|\bdowels?\b|\bstarter|projecting[ _-]?(bar|rebar|reinforcement)|connecting[ _-]?(re)?bar|差し?筋"
    r"|Anschlussbewehrung|Steckeisen|Anschlusseisen|\bstek(ken|eind|staaf|wapening)",
    re.IGNORECASE,
)
NOT_REBAR = re.compile(
    r"箍|拉筋|拉结筋|拉結筋|螺旋筋|分布筋|吊环|吊環|帯筋|フープ|あばら筋|スターラップ"
    r"|stirrup|ligature|\bhoops?\b|spiral|\blinks?\b|(single|cross)[ _-]?tie|\bties?\b|beugel|\bBügel|\bWendel",
    re.IGNORECASE,
)
COLUMN = re.compile(
    r"预制柱|預製柱|PC柱|预制框架柱|\bPCZ|YZZ|\bKZ\d+|precast[ _-]?column|プレキャスト柱|PCa柱",
    re.IGNORECASE,
)

_PIECE_MARK = frozenset(
    {"piecemark", "piece mark", "assembly/cast unit mark", "cast unit mark", "castunitmark", "构件编号", "構件編號"}
)


def texts(element: Any, *, with_properties: bool = False) -> str:
    """All that an element and its type are called, in one line; optionally the texts of its property sets too."""
    from ifcopenshell.util.element import get_type

    kind = get_type(element)
    said = [getattr(element, "Name", None), getattr(element, "ObjectType", None), getattr(element, "Description", None)]
    if kind is not None:
        said += [kind.Name, getattr(kind, "ElementType", None), kind.Description]
    if with_properties:
        said += [value for _, value in properties(element) if isinstance(value, str)]
    return " | ".join(dict.fromkeys(text.strip() for text in said if text and text.strip()))


def properties(element: Any) -> Iterator[tuple[str, Any]]:
    """Names and values of all properties of an element and its type."""
    from ifcopenshell.util.element import get_psets

    for group in get_psets(element).values():
        yield from ((name, value) for name, value in group.items() if name != "id")


def piece_mark(element: Any) -> str | None:
    """The mark of the mould that a precast piece comes from, shared by all pieces cast in it."""
    marks = (str(value) for name, value in properties(element) if name.strip().lower() in _PIECE_MARK and value)
    return next(marks, None)


def predefined_type(element: Any) -> str:
    """PredefinedType of an element or its type, or BarRole in IFC2X3; empty where there is none."""
    from ifcopenshell.util.element import get_type

    for holder in (element, get_type(element)):
        for name in ("PredefinedType", "BarRole"):
            value = getattr(holder, name, None)
            if value and value not in ("NOTDEFINED", "USERDEFINED"):
                return str(value)
    return ""


def storey_name(element: Any) -> str | None:
    """Name of the storey that holds an element, or the assembly that it is a part of."""
    from ifcopenshell.util.element import get_container

    storey = get_container(element, ifc_class="IfcBuildingStorey")
    return None if storey is None else storey.Name or storey.LongName


def wholes(element: Any) -> list[Any]:
    """The assemblies that an element is a part of, from near to far."""
    from ifcopenshell.util.element import get_aggregate

    found: list[Any] = []
    whole: Any = get_aggregate(element)
    while whole is not None and whole.is_a("IfcElement") and whole not in found:
        found.append(whole)
        whole = get_aggregate(whole)
    return found


def parts(element: Any) -> list[Any]:
    """All parts that an element is made of, of their parts too."""
    found: list[Any] = []
    for relation in getattr(element, "IsDecomposedBy", ()):
        for part in relation.RelatedObjects:
            found += [part, *parts(part)]
    return found


def select(file: Any, source: str, key: str, query: str) -> list[Any]:
    """Elements that a selector of the job names, in the order of the file.

    The syntax is that of ``ifcopenshell.util.selector``; a /pattern/ may match anywhere in a text, so that
    ``Name=/套筒|sleeve/`` finds "灌浆套筒 GTQ4Z-20". ``^`` binds it to the beginning.

    Raises
    ------
    DesignError
        Where the selector is not understood or nothing answers to it.
    """
    from ifcopenshell.util.selector import filter_elements
    from lark.exceptions import LarkError

    found: set[Any]
    try:
        found = filter_elements(file, _unanchored(query))
    except LarkError as error:
        reason = str(error).strip().splitlines()[0]
        raise DesignError(f'The selector {key} = "{query}" is not understood: {reason}') from error
    elements: list[Any] = sorted(
        (element for element in found if element.is_a("IfcElement")), key=lambda element: element.id()
    )
    if not elements:
        raise DesignError(f'The selector {key} = "{query}" finds no element in {source}, which holds {holdings(file)}.')
    return elements


def _unanchored(query: str) -> str:
    def anywhere(found: re.Match[str]) -> str:
        flags, pattern = found["flags"] or "", found["pattern"]
        return f"{found['equals']}/{flags}.*(?:{pattern})/"

    return re.sub(r"(?P<equals>=\s*)/(?P<flags>\(\?[aiLmsux]+\))?(?P<pattern>[^/]+)/", anywhere, query)


def holdings(file: Any) -> str:
    """What a model holds, by class, the most frequent first: "8 IfcColumn, 96 IfcReinforcingBar"."""
    count: dict[str, int] = {}
    for element in file.by_type("IfcElement"):
        count[element.is_a()] = count.get(element.is_a(), 0) + 1
    ranked = sorted(count.items(), key=lambda item: (-item[1], item[0]))
    return ", ".join(f"{number} {ifc_class}" for ifc_class, number in ranked) or "no elements at all"
