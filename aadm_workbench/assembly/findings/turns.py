"""What the pattern says against the declared ``up``, and where a declaration is hardly one."""

from __future__ import annotations

import math
from collections.abc import Iterator

from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.assembly.matching.match import FAR_FROM_DECLARED
from aadm_workbench.assembly.pose.upright import wrap
from aadm_workbench.model import Finding


def turn_findings(group: SeenGroup) -> Iterator[Finding]:
    """A contradicted ``up``, a mirrored scan, an ``up`` that lies nearly half-way between two turns."""
    match, name = group.match, group.kind.plural
    if match.contradiction == "mirrored":
        yield make_finding("mirrored", [name], group=name)
    elif match.contradiction == "turn_contradicted":
        yield _contradicted(group)
    elif match.open_turn is not None and match.open_turn > FAR_FROM_DECLARED and match.declared is not None:
        off = abs(wrap((match.placements[0].up or 0.0) - match.declared))
        yield make_finding("turn_doubtful", [name], group=name, off_deg=math.degrees(off))


def _contradicted(group: SeenGroup) -> Finding:
    match, name = group.match, group.kind.plural
    fitting, *as_declared = match.contradicting
    values = {
        "group": name,
        "declared_deg": _direction_deg(match.declared),
        "fitting_deg": _direction_deg(fitting.up),
        "fitting_mm": fitting.rms_mm,
    }
    if as_declared:
        return make_finding("turn_contradicted.worse", [name], **values, declared_mm=as_declared[0].rms_mm)
    return make_finding("turn_contradicted", [name], **values)


def _direction_deg(angle: float | None) -> float:
    """Degrees from +x, from 0 up, whole."""
    return float(round(math.degrees(angle or 0.0)) % 360)
