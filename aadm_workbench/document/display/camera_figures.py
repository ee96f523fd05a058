"""What a profile of a camera, or the last capture of its log, says, in lines for the panel."""

from __future__ import annotations

import csv
import html
import tomllib
from pathlib import Path
from typing import Any

import FreeCAD

from aadm_workbench.bounded import read_bounded
from aadm_workbench.document.words import in_words
from aadm_workbench.errors import AadmError

translate = FreeCAD.Qt.translate

_LARGEST_BYTES = 20_000_000  # a log of ten years with ten captures a day
_PER_MILLION = 1e6  # of relative figures: micrometres that a metre gains


def learned_lines(profile: Path) -> list[str]:
    """Scale, stretches and scatter of a profile that was just written."""
    learned = tomllib.loads(_text(profile))["learned"]
    lines = [_relative(translate("AADM_Camera", "scale"), learned["scale"])]
    named = (
        ("sleeves", translate("AADM_Camera", "stretch of sleeves")),
        ("rebars", translate("AADM_Camera", "of bars")),
    )
    lines += [_relative(said, learned[name]["stretch"]) for name, said in named]
    count = translate("AADM_Camera", "{count} captures, from {near:.0f} to {far:.0f} mm")
    near, far = learned["distance_mm"]
    return [count.format(count=learned["captures"], near=near, far=far), *lines]


def verified_lines(log: Path) -> list[str]:
    """The verdict on each figure of the log's last capture."""
    last = {row["name"]: row for row in csv.DictReader(_text(log).splitlines())}
    return [
        html.escape(f"{name}: {float(row['value']):+.2g} ({float(row['limit']):.2g}) {in_words(row['verdict'])}")
        for name, row in last.items()
    ]


def _relative(said: str, value: Any) -> str:
    return f"{said}: {value[0] * _PER_MILLION:+.0f} ± {value[1] * _PER_MILLION:.0f} µm/m"


def _text(path: Path) -> str:
    try:
        return read_bounded(path, _LARGEST_BYTES).decode("utf-8-sig")
    except OSError as error:
        raise AadmError(f"{path}: {error.strerror}") from error
