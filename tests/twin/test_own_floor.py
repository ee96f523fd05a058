"""A floor of one's own: each defect is where it was asked for, and what cannot be made is refused in both languages."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import AadmError
from aadm_workbench.model import Reason
from aadm_workbench.twin.own_floor import defect_of, make_own_floor
from batch.job.file import read_job


def test_a_defect_stands_where_it_was_asked_for(tmp_path: Path) -> None:
    pytest.importorskip("open3d")
    defects = [defect_of("C-301: R5 +7.5,0"), defect_of(" C-301 : S7 plugged ")]
    assert list(make_own_floor(tmp_path, 7, 1, defects)) == [
        "C-301: R5 stands +7.5, +0 mm off its place, S7 is plugged"
    ]
    truth = json.loads((tmp_path / "truth.json").read_text(encoding="utf-8"))["columns"]["C-301"]
    assert truth["verdict"] == "fail"
    off = {
        point["label"]: np.subtract(point["column_mm"], point["design_mm"])[:2] for point in truth["rebars"]["points"]
    }
    np.testing.assert_allclose(off.pop("R5"), (7.5, 0.0), atol=1e-4)
    assert max(np.hypot(*one) for one in off.values()) <= 0.8001
    job = read_job(tmp_path / "job.toml")
    assert [column.id for column in job.columns] == ["C-301"]
    assert all((tmp_path / "scans" / f"C-301-{part}.tiff").exists() for part in ("foot", "bars"))


@pytest.mark.parametrize(
    "text", ["R5 +7.5,0", "C-301: R5 7.5", "C-301: R13 1,1", "C-301: R5 90,0", "C-301: R5 plugged"]
)
def test_what_cannot_be_made_is_refused(text: str) -> None:
    with pytest.raises(AadmError) as refused:
        defect_of(text)
    reason = refused.value.reason
    assert isinstance(reason, Reason)
    assert text in reason
    assert re.search(r"[\u4e00-\u9fff]", reason.in_language("zh"))


def test_a_column_that_is_not_made(tmp_path: Path) -> None:
    with pytest.raises(AadmError, match="C-309, but these are made: C-301, C-302"):
        list(make_own_floor(tmp_path, 1, 2, [defect_of("C-309: R5 1,1")]))
