"""Which element of a model is meant by what a report says of it; GlobalIds that several elements have mean none."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from aadm_workbench.design.ifc.columns import names
from aadm_workbench.design.ifc.ids import elements_by_id
from aadm_workbench.errors import ReportError
from aadm_workbench.model import ColumnDesign, ColumnReport, PointResult, Reason
from aadm_workbench.model.reason import listed


class Elements:
    """The elements of one model, by GlobalId."""

    def __init__(self, file: Any) -> None:
        self._by_id = elements_by_id(file)

    def column(self, column: ColumnReport | ColumnDesign) -> Any:
        """The element of a column; of several with its GlobalId the one that is called like it, else None."""
        found = self._by_id.get(column.global_id or "", [])
        if len(found) > 1:
            found = [element for element in found if column.id in names(element)]
        return found[0] if len(found) == 1 else None

    def point(self, point: PointResult) -> Any:
        """The element of a sleeve or a bar; None where there is none, or several have its GlobalId."""
        return self.called(point.global_id)

    def called(self, global_id: str | None) -> Any:
        """The one element of a GlobalId; None where there is none, or several have it."""
        found = self._by_id.get(global_id or "", [])
        return found[0] if len(found) == 1 else None

    def is_shared(self, global_id: str | None) -> bool:
        """Whether several elements have a GlobalId."""
        return len(self._by_id.get(global_id or "", ())) > 1

    def notes(self, entries: Iterable[ColumnReport | PointResult]) -> Iterator[str]:
        """What to say of those columns and points that nothing was written to because of their GlobalIds."""
        shared = {entry.global_id or "" for entry in entries if self.is_shared(entry.global_id)}
        if shared:
            yield Reason("report.shared_ids", count=len(shared), shown=listed(sorted(shared), _SHOWN))


_SHOWN = 4  # names in a message


def check_named_once(of_column: Mapping[str, Any]) -> None:
    """Refuse a report in which two columns are one element: the second would overwrite the first.

    Parameters
    ----------
    of_column
        Elements by the ids of their columns.

    Raises
    ------
    ReportError
        Naming both.
    """
    first: dict[int, str] = {}
    for name, element in of_column.items():
        other = first.setdefault(element.id(), name)
        if other != name:
            raise ReportError.because("report.one_element", first=other, second=name, global_id=element.GlobalId)
