"""What contradicts the design, what was declared, or the camera."""

from __future__ import annotations

from dataclasses import dataclass, field

from aadm_workbench.model.measured import Figures


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing about a column that somebody should look at, as a value.

    Parameters
    ----------
    code
        What kind of thing: ``diameter_differs``, ``scale_differs``, ``mirrored``, ...
    about
        Labels of points, or ``sleeves``, ``rebars``, ``column``.
    values
        The numbers and names that ``text`` is made of; names of lengths end in ``_mm``.
    text
        One sentence, in English; :mod:`~aadm_workbench.model.sentences.finding` has it in Chinese too.
    holds_back
        Whether the column must not pass before this is settled.
    """

    code: str
    about: tuple[str, ...]
    values: Figures = field(default_factory=dict)
    text: str = ""
    holds_back: bool = False
