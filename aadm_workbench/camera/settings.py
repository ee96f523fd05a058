"""What a camera does to its points before it sends them, read from its own settings by the names its vendor gives."""

from __future__ import annotations

import re
from collections.abc import Mapping

from aadm_workbench.camera.frame import Setting
from aadm_workbench.model import Reason

_SMOOTHS = re.compile(
    r"smooth|gauss|median|bilateral|denois|noise_?reduc|spatial_?filter|temporal_?filter", re.IGNORECASE
)
_FILLS = re.compile(r"(?:hole|gap|void|contour)\w*?fill|fill\w*?(?:hole|gap|void|missing)|interpolat", re.IGNORECASE)
_PART_OF_IT = re.compile(r"(?:size|kernel|radius|strength|threshold|sigma|window|iterations?|max\w*)$", re.IGNORECASE)
"""How much, not whether: it counts where no other setting says whether."""

_OFF = frozenset({"off", "none", "no", "false", "disable", "disabled", "sharp", "0", "inactive", "bypass"})
_NO_FILTER = re.compile(r"edge_?preserv", re.IGNORECASE)  # of Mech-Eye: what smoothing leaves of edges


def warnings_of(settings: Mapping[str, Setting]) -> tuple[str, ...]:
    """What of a camera's settings moves edges or invents points, one sentence each, with the vendor's name for it."""
    smoothed = [Reason("camera.smoothed", name=name, value=settings[name]) for name in _in_force(settings, _SMOOTHS)]
    filled = [Reason("camera.filled", name=name, value=settings[name]) for name in _in_force(settings, _FILLS)]
    return (*smoothed, *filled)


def _in_force(settings: Mapping[str, Setting], words: re.Pattern[str]) -> list[str]:
    """The settings of one kind of filter that are on; how much of it does not count where a switch says whether."""
    found = {name: match.end() for name in settings if (match := words.search(name)) and not _NO_FILTER.search(name)}
    switches = [name for name in found if not _PART_OF_IT.search(name)]
    return [
        name
        for name, end in found.items()
        if is_on(settings[name]) and (name in switches or not any(switch.startswith(name[:end]) for switch in switches))
    ]


def is_on(value: Setting) -> bool:
    """Whether a setting does something: true, a number above zero, or a word that is none of those for off."""
    if isinstance(value, str):
        return value.strip().lower() not in _OFF
    return bool(value)
