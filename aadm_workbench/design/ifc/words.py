"""Words by which elements are told apart: sleeve, connecting rebar, column, or something else; for models of any kind.

What an element is follows from its class and PredefinedType, then from what it is called, by the same rules whether it
comes from an IFC file or from another program.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from functools import lru_cache

from aadm_workbench.model import Reason

SLEEVE = re.compile(
    r"灌[浆漿]套[筒管]|[全半]灌[浆漿]|钢筋套筒|鋼筋套筒|连接套筒|連接套筒|套筒|波[纹紋]管|浆锚孔|漿錨孔|预留孔|預留孔"
    # Marks of JG/T 398 such as GTQ4Z-20, GTB4J-20-A, GTZQ4 20.
    r"|GT[ZJQB]{1,2}\d[ZJ]?[- ]?\d{2}(/\d{2})?[A-Z]?"
    r"|grout(ed|ing)?[ _-]?(splice[ _-]?)?(sleeve|coupler|duct|tube)|splice[ _-]?sleeve|corrugated[ _-]?duct"
    r"|(?<![a-z])sleeves?(?![a-z])|rebar[ _-]?coupler|(?<![a-z])couplers?(?![a-z])"
    r"|\bNMB\b|Interlok|Groutec|Sleeve-?Lock"
    r"|スプライススリーブ|スリーブ|モルタル充填(式)?継手|機械式継手"
    r"|\bMuffe|Bewehrungsanschluss|Wellrohr|Hüllrohr|koppelhuls|gainebuis|\bgaine\b|stekkenbuis",
    re.IGNORECASE,
)
NOT_SLEEVE = re.compile(
    r"防水套管|刚性套管|剛性套管|柔性套管|穿墙套管|穿牆套管|止水|吊装|吊裝|斜撑|斜撐|脱模|脫模|预埋螺母|預埋螺母|预埋管|线管|线盒"
    r"|lifting|\bbrac(e|ing)\b|pipe[ _-]?sleeve|threaded[ _-]?(insert|socket)|\banchor[ _-]?nut|吊り|インサート"
    r"|Durchführung",
    re.IGNORECASE,
)
REBAR = re.compile(
    r"连接钢筋|連接鋼筋|连接筋|插筋|预留钢筋|預留鋼筋|预留连接钢筋|外露钢筋|伸出钢筋|甩筋|锚筋|錨筋"
    r"|竖向(受力)?钢筋|纵筋|縱筋|纵向钢筋|主筋"
    r"|(?<![a-z])dowels?(?![a-z])|(?<![a-z])starter|projecting[ _-]?(bar|rebar|reinforcement)"
    r"|connecting[ _-]?(re)?bar|差し?筋"
    r"|Anschlussbewehrung|Steckeisen|Anschlusseisen|\bstek(ken|eind|staaf|wapening)",
    re.IGNORECASE,
)
NOT_REBAR = re.compile(
    r"箍|拉筋|拉结筋|拉結筋|螺旋筋|分布筋|吊环|吊環|帯筋|フープ|あばら筋|スターラップ|スパイラル"
    r"|stirrup|ligature|\bhoops?\b|spiral|\blinks?\b|(single|cross)[ _-]?tie|\bties?\b|beugel|\bBügel|\bWendel",
    re.IGNORECASE,
)
COLUMN = re.compile(
    r"预制柱|預製柱|PC柱|框架柱|\bPCZ|YZZ|\bKZ-?\d+|(?<![a-z])columns?(?![a-z])|プレキャスト柱|PCa柱|柱"
    r"|\bStütze|Fertigteilstütze|\bkolom(men)?\b|\bpoteau",
    re.IGNORECASE,
)
NOT_COLUMN = re.compile(
    r"柱帽|柱脚|柱腳|构造柱|構造柱|柱头|柱頭|柱牛腿|capital|base[ _-]?plate|column[ _-]?base", re.IGNORECASE
)

BEAM = re.compile(
    r"梁|\bPCL|\bYZL|\bW?KL-?\d+|(?<![a-z])beams?(?![a-z])|girder|\bTräger|\bUnterzug|\bRiegel|\bpoutre|\bligger",
    re.IGNORECASE,
)
NOT_BEAM = re.compile(
    r"梁[筋箍侧側底]|过梁|過梁|圈梁|地梁|梯梁|梁垫|梁墊|牛腿"
    r"|lintel|ground[ _-]?beam|stair|bearing[ _-]?pad|corbel|Sturz",
    re.IGNORECASE,
)


@lru_cache(maxsize=65536)
def find(pattern: re.Pattern[str], text: str) -> str | None:
    """The first match of a pattern in a text, full-width letters and half-width kana as their usual forms.

    A floor has thousands of elements of one name.
    """
    found = pattern.search(text if text.isascii() else unicodedata.normalize("NFKC", text))
    return found.group() if found else None


COUPLERS = frozenset({"COUPLER", "GROUTING_DUCT"})
"""PredefinedTypes of couplers of bars, and of ducts that grout goes into."""

_NOT_CONNECTING = frozenset({"LIGATURE", "SHEAR", "STUD", "RING", "SPACEBAR", "PUNCHING"})


@dataclass(frozen=True)
class Said:
    """What an element says of itself: its own ``name``, and all ``texts`` that it and its type are called."""

    name: str
    texts: tuple[str, ...]

    def find(self, pattern: re.Pattern[str]) -> str | None:
        """The first match of a pattern in all that is said."""
        return next((found for text in self.texts if (found := find(pattern, text))), None)

    @property
    def is_column(self) -> bool:
        """Whether something says column, and nothing a part or the steel of one: 柱帽, 柱箍筋, "column dowel".

        What a column is described with ("with grouting sleeves") does not make it a sleeve; its own name does.
        """
        if _steel(self.name) or self.find(NOT_COLUMN):
            return False
        return any(find(COLUMN, text) and not _steel(text) for text in self.texts)

    @property
    def is_sleeve_or_bar(self) -> bool:
        """Whether it is called a sleeve or a connecting bar."""
        return bool(self.find(SLEEVE) or self.find(REBAR))

    @property
    def is_rebar(self) -> bool:
        """Whether it is called a connecting bar, and not after the sleeve that a bar goes into."""
        return bool(self.find(REBAR)) and not self.find(SLEEVE)

    def why_not_connecting(self, predefined_type: str) -> str | None:
        """Why a reinforcing bar is none that a column stands on; None where it may be one."""
        if predefined_type in _NOT_CONNECTING:
            return Reason("ifc.bar_kind", kind=predefined_type)
        word = self.find(NOT_REBAR)
        if word and not self.find(REBAR):
            return Reason("ifc.bar_called", named=repr(word))
        return None


def _steel(text: str) -> bool:
    return bool(find(SLEEVE, text) or find(REBAR, text) or find(NOT_REBAR, text))
