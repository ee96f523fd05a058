"""Columns of a job grouped by mould, and what the report says about each mould."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.inspect import inspect_group
from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.mould.moulds import assess_moulds
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.model import Array, ColumnReport, Kind, Rule, Verdict

CN = load_profile("cn")


def feet(
    build: Any, square: Array, count: int, drift: Array, mark: str | None = "PCZ-1", up: Any = (0.0, 1.0)
) -> list[ColumnReport]:
    """Reports on the feet of columns of one mould; scatter 0.3 mm per axis."""
    rng = np.random.default_rng(1)
    design = build.column(square, size_mm=(600.0, 600.0))
    reports = []
    for number in range(count):
        offsets = drift + rng.normal(0.0, 0.3, (12, 2))
        seen = build.see(square + np.column_stack([offsets, np.zeros(12)]), rng)
        found = build.extraction(Kind.SLEEVE, seen, 36.0)
        chosen = None if up is None else np.array(up)
        match = match_extraction(design.sleeves, found, up=chosen, image_up_scan=seen.image_up)
        group = inspect_group(design.sleeves, found, match, CN)
        reports.append(
            ColumnReport(
                f"C-{number}",
                group.verdict,
                Verdict.NOT_ASSESSED,
                sleeves=group,
                piece_mark=mark,
                size_mm=(600.0, 600.0),
            )
        )
    return reports


def drift_of(label: int, by: tuple[float, float]) -> Array:
    drift = np.zeros((12, 2))
    drift[label - 1] = by
    return drift


def test_a_mould_that_displaces_a_sleeve(build: Any, square: Array) -> None:
    (mould,) = assess_moulds(feet(build, square, 6, drift_of(4, (1.0, 0.2))), CN)
    assert mould.piece_mark == "PCZ-1"
    assert mould.columns == tuple(f"C-{number}" for number in range(6))
    assert [sleeve.label for sleeve in mould.drifting] == ["S4"]
    (sleeve,) = mould.drifting
    assert sleeve.mean_mm == pytest.approx((1.0, 0.2), abs=0.35)
    assert sleeve.columns == 6
    assert mould.scatter_mm == pytest.approx(0.3, abs=0.06)
    assert mould.conclusion.startswith("displaced alike in 6 columns: S4 by (+")
    assert (mould.limit_mm, mould.axis_limit_mm) == (2.0, pytest.approx(2.0 / np.sqrt(2.0)))
    assert "inscribed in the circle" in mould.axis_limit_from
    for entry in sleeve.capability:
        assert entry.cp is not None
        assert entry.cpk is not None
        assert entry.cpk <= entry.cp
        assert entry.cp_interval is not None
        assert entry.cp_interval[0] < entry.cp < entry.cp_interval[1]
    assert sleeve.capability[0].cpk < sleeve.capability[1].cpk  # type: ignore[operator]


def test_scatter_alone_is_no_drift(build: Any, square: Array) -> None:
    (mould,) = assess_moulds(feet(build, square, 5, np.zeros((12, 2))), CN)
    assert mould.drifting == ()
    assert mould.conclusion.startswith("no sleeve is displaced alike in these 5 columns")


def test_what_all_scans_may_share_is_no_drift(build: Any, square: Array) -> None:
    """A tenth of a millimetre, in many columns: significant, and still no more than 2 u of a single centre."""
    many = feet(build, square, 60, drift_of(7, (0.25, 0.0)))
    assert [sleeve.label for sleeve in assess_moulds(many, CN)[0].drifting] == ["S7"]
    vague = [
        replace(
            report, sleeves=replace(report.sleeves, points=tuple(replace(p, u_mm=0.2) for p in report.sleeves.points))
        )
        for report in many
        if report.sleeves is not None
    ]
    assert assess_moulds(vague, CN)[0].drifting == ()


def test_moulds_are_kept_apart_and_small_ones_left_out(build: Any, square: Array) -> None:
    first, second = feet(build, square, 3, np.zeros((12, 2))), feet(build, square, 2, np.zeros((12, 2)), "PCZ-2")
    inline = feet(build, square, 4, np.zeros((12, 2)), None)
    found = assess_moulds([*first, *second, *inline], CN)
    assert [(mould.piece_mark, len(mould.columns)) for mould in found] == [("PCZ-1", 3), (None, 4)]
    bare = ColumnReport("C-9", Verdict.ERROR, Verdict.NOT_ASSESSED, piece_mark="PCZ-2")
    assert assess_moulds([*second, bare], CN) == ()


def test_feet_of_unknown_turn_are_left_out(build: Any, square: Array) -> None:
    open_ = feet(build, square, 4, np.zeros((12, 2)), up=None)
    assert all(report.sleeves is not None and report.sleeves.fit is not None for report in open_)
    assert assess_moulds(open_, CN) == ()


def test_a_scan_that_is_named_for_several_columns_counts_once(build: Any, square: Array) -> None:
    """Three columns of one file are one foot: they agree to the last digit, which is no mould's doing."""
    columns = feet(build, square, 3, drift_of(5, (1.5, 0.0)))
    once = [replace(columns[0].sleeves, sha256=f"{number:064x}") for number in (7, 7, 7)]
    same = [replace(column, sleeves=foot) for column, foot in zip(columns, once, strict=True)]
    assert assess_moulds(same, CN) == ()
    others = [replace(column, sleeves=replace(column.sleeves, sha256=column.id)) for column in columns]
    assert len(assess_moulds(others, CN)[0].columns) == 3


def test_limits_per_axis_and_none(build: Any, square: Array) -> None:
    reports = feet(build, square, 3, np.zeros((12, 2)))
    each = Rule("p", "sleeve_position", 1.5, None, "our spec", "shall", "verified", kind="per_axis")
    (mould,) = assess_moulds(reports, build.profile(each))
    assert mould.axis_limit_mm == 1.5
    (silent,) = assess_moulds(reports, build.profile())
    assert silent.axis_limit_mm is None
    assert silent.sleeves[0].capability[0].cp is None
