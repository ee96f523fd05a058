"""docs/recompute.py comes to what a report says, and notices where it does not."""

import copy
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.report.checked_floor import CASES, floor_report

SCRIPT = Path(__file__).resolve().parents[2] / "docs" / "recompute.py"


@pytest.fixture(scope="module")
def report() -> dict[str, Any]:
    return floor_report(*CASES)


def recomputed(report: dict[str, Any]) -> tuple[int, str]:
    given = json.dumps(report)
    done = subprocess.run([sys.executable, str(SCRIPT)], input=given, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def test_sixty_lines_and_numpy_alone() -> None:
    text = SCRIPT.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 60
    assert set(re.findall(r"^(?:import|from) (\w+)", text, re.MULTILINE)) == {"json", "sys", "numpy"}


def test_it_comes_to_what_the_report_says(report: dict[str, Any]) -> None:
    code, said = recomputed(report)
    assert code == 0, said
    for name in ("position", "spacing", "least squares", "distance", "room"):
        found = re.search(rf"^{name}: (\d+) values", said, re.MULTILINE)
        assert found, said
        assert int(found[1]) >= 48


@pytest.mark.parametrize("key", ["deviation_mm", "distance_mm", "room_mm", "spacing"])
def test_it_notices_a_value_that_is_wrong(report: dict[str, Any], key: str) -> None:
    wrong = copy.deepcopy(report)
    column = wrong["columns"][1]
    if key == "deviation_mm":
        column["rebars"]["points"][3][key] += 0.01
    elif key == "spacing":
        column["sleeves"]["spacing"][2]["deviation_mm"] -= 0.01
    else:
        column["trial_assembly"]["best"]["pairs"][5][key] += 0.01
    code, said = recomputed(wrong)
    assert code == 1, said
