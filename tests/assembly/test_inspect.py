"""Position, spacing and exposed length of one group, up to its verdict."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.inspect import NO_ABSOLUTE_POSITION, inspect_group
from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.assembly.position import residual_covariances
from aadm_workbench.assembly.tolerances import load_profile, rules_of_the_erected_column, sum_up
from aadm_workbench.model import Array, GroupReport, Kind, Profile, Rule, TrialReport, Verdict

Y_UP = np.array([0.0, 1.0])
CN = load_profile("cn")


def inspected(
    build: Any,
    built: Array,
    design: Array,
    *,
    kind: Kind = Kind.SLEEVE,
    u_mm: float | None = 0.02,
    profile: Profile = CN,
    declared: bool = True,
    seed: int = 1,
    missing: tuple[int, ...] = (),
    **more: Any,
) -> GroupReport:
    """The group as a camera would have found it, matched and inspected."""
    seen = build.see(built, np.random.default_rng(seed), missing=missing)
    found = build.extraction(kind, seen, 36.0, u_mm)
    points = build.points_of(kind, design, 36.0)
    match = match_extraction(points, found, up=Y_UP if declared else None, image_up_scan=seen.image_up)
    return inspect_group(points, found, match, profile, **more)


def test_a_perfect_group_passes(build: Any, square: Array) -> None:
    report = inspected(build, square, square, source="foot.ply", sha256="ab")
    assert report.verdict is Verdict.PASS
    assert (report.expected, report.found, report.source, report.sha256) == (12, 12, "foot.ply", "ab")
    assert report.reasons == ()
    assert NO_ABSOLUTE_POSITION in report.notes
    assert [point.label for point in report.points] == [f"S{k}" for k in range(1, 13)]
    assert all(point.deviation_mm < 1e-9 for point in report.points if point.deviation_mm is not None)
    assert len(report.spacing) == 12
    assert report.spacing[0].between == ("S1", "S2")
    assert report.fit is not None
    assert report.fit.orientation == "declared"
    skipped = [rule for rule in report.rules if rule.verdict is Verdict.NOT_ASSESSED]
    assert [(rule.rule, rule.reason) for rule in skipped] == [("group_position", NO_ABSOLUTE_POSITION)]


def test_one_sleeve_1_mm_beyond_the_limit_is_reported(build: Any, square: Array) -> None:
    """Least squares leaves 21/24 of a single displacement; the direction of the offset is measured minus design."""
    displaced = square.copy()
    displaced[6] += np.array([3.0 / (1.0 - residual_share(square, 6)), 0.0, 0.0])
    report = inspected(build, displaced, square)
    assert report.verdict is Verdict.FAIL
    worst = report.points[6]
    assert worst.verdict is Verdict.FAIL
    assert worst.offset_mm is not None
    assert worst.offset_mm[0] == pytest.approx(3.0, abs=0.02)
    assert worst.deviation_mm == pytest.approx(3.0, abs=0.2)
    expected = f"S7 is {worst.deviation_mm:.2f} mm from design, limit 2 mm (T/CCES 30-2022, 4.3.3)"
    assert expected in report.reasons
    assert [point.label for point in report.points if point.verdict is Verdict.FAIL] == ["S7"]
    beside = {pair.between: pair for pair in report.spacing}
    assert beside["S7", "S8"].deviation_mm == pytest.approx(displaced[6, 0] - 240.0, abs=1e-6)
    assert beside["S7", "S8"].verdict is Verdict.FAIL
    assert any(reason.startswith("S7–S8 are spaced +3.") for reason in report.reasons)
    assert beside["S1", "S2"].verdict is Verdict.PASS


def residual_share(centres: Array, index: int) -> float:
    """How much of a displacement along x of one point the rigid fit takes up there."""
    spoke = centres[:, :2] - centres[:, :2].mean(axis=0)
    return float(1.0 / len(centres) + spoke[index, 1] ** 2 / (spoke**2).sum())


def test_aligned_points_and_transform_agree_with_the_scan(build: Any, square: Array) -> None:
    rng = np.random.default_rng(3)
    report = inspected(build, square + rng.normal(0.0, 0.5, square.shape) * np.array([1.0, 1.0, 0.0]), square)
    assert report.fit is not None
    T = report.fit.T_design_scan
    for point in report.points:
        assert point.scan_mm is not None
        np.testing.assert_allclose(T[:3, :3] @ point.scan_mm + T[:3, 3], point.aligned_mm, atol=1e-9)
    offsets = np.array([point.offset_mm for point in report.points])
    np.testing.assert_allclose(offsets.sum(axis=0), 0.0, atol=1e-9)
    assert report.fit.rms_mm == pytest.approx(np.sqrt((offsets**2).sum(axis=1).mean()))
    assert report.fit.max_mm == pytest.approx(np.hypot(*offsets.T).max())


def test_a_missing_point_is_listed_with_its_reason_and_never_passes(build: Any, square: Array) -> None:
    report = inspected(build, square, square, missing=(4,))
    assert report.verdict is Verdict.NOT_MEASURED
    assert (report.expected, report.found) == (12, 11)
    lost = report.points[4]
    assert (lost.label, lost.verdict, lost.scan_mm, lost.deviation_mm) == ("S5", Verdict.NOT_MEASURED, None, None)
    assert "not found" in lost.reason
    assert [pair.between for pair in report.spacing if pair.measured_mm is None] == [("S4", "S5"), ("S5", "S6")]
    displaced = square.copy()
    displaced[0, 0] += 8.0
    assert inspected(build, displaced, square, missing=(4,)).verdict is Verdict.FAIL


def test_nothing_found_is_not_measured_in_every_point(build: Any, square: Array) -> None:
    report = inspected(build, square, square, missing=tuple(range(11)))
    assert report.verdict is Verdict.NOT_MEASURED
    assert report.fit is None
    assert len(report.points) == len(report.spacing) == 12
    assert all("only 1 points were found" in point.reason for point in report.points)


@pytest.mark.parametrize(("u_mm", "verdict"), [(0.05, Verdict.PASS), (0.3, Verdict.INCONCLUSIVE), (None, Verdict.PASS)])
def test_close_to_the_limit_the_uncertainty_decides(
    u_mm: float | None, verdict: Verdict, build: Any, square: Array
) -> None:
    """1.75 mm of 2 mm; without a covariance the value alone is compared and u is null."""
    displaced = square.copy()
    displaced[6, 0] += 1.75 / (1.0 - residual_share(square, 6))
    rules = tuple(rule for rule in CN.rules if rule.name == "sleeve_position")
    report = inspected(build, displaced, square, u_mm=u_mm, profile=replace(CN, rules=rules))
    assert report.verdict is verdict
    assert (report.points[6].u_mm is None) == (u_mm is None)
    assert (report.points[6].probability is None) == (u_mm is None)
    if verdict is Verdict.INCONCLUSIVE:
        assert "rescan closer" in report.points[6].reason
        assert inspected(build, displaced, square, u_mm=u_mm, decision="simple").points[6].verdict is Verdict.PASS


def test_uncertainty_of_a_deviation_holds_the_part_of_the_fit(square: Array) -> None:
    """Against 20,000 draws of all centres, each fitted anew."""
    rng = np.random.default_rng(7)
    roots = rng.normal(0.0, 0.1, (12, 2, 2))
    predicted = residual_covariances(square[:, :2], list(roots @ roots.transpose(0, 2, 1)), scale_error=2e-4)
    spoke = square[:, :2]
    noise = np.einsum("nij,knj->kni", roots, rng.standard_normal((20_000, 12, 2)))
    noise += 2e-4 * rng.standard_normal((20_000, 1, 1)) * spoke
    shift = noise.mean(axis=1, keepdims=True)
    across = (spoke[:, 0] * noise[..., 1] - spoke[:, 1] * noise[..., 0]).sum(axis=1) / (spoke**2).sum()
    residual = noise - shift - across[:, None, None] * np.column_stack([-spoke[:, 1], spoke[:, 0]])
    for index, covariance in enumerate(predicted):
        assert covariance is not None
        np.testing.assert_allclose(covariance, np.cov(residual[:, index].T), rtol=0.06, atol=3e-5)


def test_one_unknown_covariance_spoils_only_its_own_point(square: Array) -> None:
    known = [np.eye(2) * 0.01] * 11
    mixed = residual_covariances(square[:, :2], [*known, None])
    assert mixed[11] is None
    full = residual_covariances(square[:, :2], [*known, np.eye(2) * 0.01])
    np.testing.assert_allclose(mixed[0], full[0])  # type: ignore[arg-type]


def test_spacing_uncertainty_is_along_the_line_and_holds_the_scale(build: Any, square: Array) -> None:
    report = inspected(build, square, square, u_mm=0.03, scale_error=1e-4)
    assert report.spacing[0].u_mm == pytest.approx(np.hypot(0.03 * np.sqrt(2.0), 160.0 * 1e-4))


def test_a_fit_hides_a_group_off_the_grid_and_spacing_is_free_of_fits(build: Any, square: Array) -> None:
    """Turned and moved as a whole: nothing deviates. Stretched by 1 %: every spacing does, by 1.6 mm."""
    moved = square.copy()
    moved[:, :2] = square[:, :2] @ turn(0.01).T + 50.0
    assert inspected(build, moved, square).verdict is Verdict.PASS
    stretched = inspected(build, square * 1.01, square)
    assert {round(pair.deviation_mm or 0.0, 6) for pair in stretched.spacing} == {1.6}
    assert stretched.fit is not None
    assert stretched.fit.scale == pytest.approx(1.0 / 1.01)


def test_square_ring_without_up_is_ambiguous_and_only_agreement_stands(build: Any, square: Array) -> None:
    rng = np.random.default_rng(4)
    good = square + rng.normal(0.0, 0.2, square.shape) * np.array([1.0, 1.0, 0.0])
    report = inspected(build, good, square, declared=False)
    assert report.fit is not None
    assert report.fit.orientation == "ambiguous"
    assert [candidate.verdict for candidate in report.fit.candidates] == [Verdict.PASS] * 4
    assert sorted(round(candidate.up_deg or 0.0) % 360 for candidate in report.fit.candidates) == [0, 90, 180, 270]
    assert report.verdict is Verdict.PASS, "all four turns agree"
    assert any("fits in 4 turns" in note for note in report.notes)
    bad = good.copy()
    bad[1, 0] += 6.0
    report = inspected(build, bad, square, declared=False)
    assert report.verdict is Verdict.FAIL, "whichever way it is turned, one sleeve fails"
    labels = {point.label for point in report.points if point.verdict is Verdict.INCONCLUSIVE}
    assert {"S2", "S5", "S8", "S11"} <= labels, "which one it is depends on the turn"
    assert Verdict.FAIL not in {point.verdict for point in report.points}
    assert "fits in 4 turns" in report.reasons[0]


def test_ambiguous_turns_that_disagree_are_inconclusive(build: Any) -> None:
    """A nearly square ring, one side 2.1 mm longer: the right turn passes, the wrong one does not."""
    design = build.rectangle(2, 2, 240.0, 240.0 + 1.05)
    report = inspected(build, design, design, declared=False)
    assert report.fit is not None
    verdicts = [candidate.verdict for candidate in report.fit.candidates]
    assert report.fit.orientation == "ambiguous"
    assert Verdict.PASS in verdicts
    assert Verdict.FAIL in verdicts
    assert report.verdict is Verdict.INCONCLUSIVE


def test_extra_points_are_told(build: Any, square: Array) -> None:
    seen = build.see(square, np.random.default_rng(1), extra=np.array([[0.0, 0.0, 0.0]]))
    found = build.extraction(Kind.SLEEVE, seen, 36.0)
    points = build.column(square).sleeves
    match = match_extraction(points, found, up=Y_UP, image_up_scan=seen.image_up)
    report = inspect_group(points, found, match, CN)
    assert "1 further sleeve found that belongs to no design point" in report.notes
    assert report.verdict is Verdict.PASS


@pytest.mark.parametrize(
    ("exposed_mm", "verdict"),
    [
        (150.0, Verdict.PASS),
        (160.0, Verdict.PASS),
        (149.0, Verdict.FAIL),
        (161.0, Verdict.FAIL),
        (None, Verdict.NOT_ASSESSED),
    ],
)
def test_exposed_length_of_rebars(exposed_mm: float | None, verdict: Verdict, build: Any, square: Array) -> None:
    seen = build.see(square, np.random.default_rng(1))
    lengths = (150.0 if exposed_mm else None,) * 11 + (exposed_mm,)
    found = build.extraction(Kind.REBAR, seen, 20.0, exposed_length_mm=lengths)
    points = build.points_of(Kind.REBAR, square, 20.0)
    match = match_extraction(points, found, up=Y_UP, image_up_scan=seen.image_up)
    report = inspect_group(points, found, match, CN, design_exposed_mm=150.0)
    result = next(rule for rule in report.rules if rule.rule == "rebar_exposed_length")
    assert result.verdict is verdict
    assert "unverified" in result.clause
    assert report.verdict is (Verdict.FAIL if verdict is Verdict.FAIL else Verdict.PASS)
    if verdict is Verdict.FAIL:
        assert any("sticks out" in reason for reason in report.reasons)
    unknown = inspect_group(points, found, match, CN)
    assert next(rule for rule in unknown.rules if rule.rule == "rebar_exposed_length").verdict is Verdict.NOT_ASSESSED
    assert {point.exposed_length_mm for point in report.points} == set(lengths)


def test_advisory_rules_are_reported_and_not_counted(build: Any, square: Array) -> None:
    displaced = square.copy()
    displaced[6, 0] += 3.0
    advisory = Rule("a", "sleeve_position", 1.0, None, "advice", "should", "verified", advisory=True)
    counted = Rule("c", "sleeve_position", 5.0, None, "rule", "shall", "verified")
    report = inspected(build, displaced, square, profile=build.profile(advisory, counted))
    assert report.verdict is Verdict.PASS
    assert {rule.rule: rule.verdict for rule in report.rules} == {"a": Verdict.FAIL, "c": Verdict.PASS}
    assert report.points[6].limit_mm == 5.0
    alone = inspected(build, displaced, square, profile=build.profile(advisory))
    assert alone.verdict is Verdict.NOT_ASSESSED


def test_a_rule_against_a_datum_is_not_applied_to_the_fit(build: Any, square: Array) -> None:
    displaced = square.copy()
    displaced[6, 0] += 15.0
    report = inspected(build, displaced, square, profile=load_profile("us-abc-2018"))
    assert report.verdict is Verdict.NOT_ASSESSED
    assert report.points[6].verdict is Verdict.NOT_ASSESSED
    assert report.points[6].deviation_mm == pytest.approx(12.7, abs=0.6)


def test_sum_of_a_column(build: Any, square: Array) -> None:
    """The verdict is the worst; whether it goes on is the trial's alone; nothing assessed is not measured."""
    displaced = square.copy()
    displaced[0, 0] += 4.0
    sleeves, rebars = inspected(build, square, square), inspected(build, displaced, square, kind=Kind.REBAR)
    trial = TrialReport(Verdict.PASS)
    verdict, goes_on, reasons = sum_up(sleeves, rebars, trial)
    assert (verdict, goes_on) == (Verdict.FAIL, Verdict.PASS)
    assert reasons[0].startswith("R1 is ")
    assert sum_up(sleeves, None, None)[:2] == (Verdict.PASS, Verdict.NOT_ASSESSED)
    nothing = inspected(build, square, square, profile=load_profile("us-nmb-2014"))
    assert nothing.verdict is Verdict.NOT_ASSESSED
    assert sum_up(nothing, None, None)[0] is Verdict.NOT_MEASURED
    assert sum_up(nothing, None, trial)[0] is Verdict.PASS
    listed = rules_of_the_erected_column(load_profile("cn-gbt51231-2016"))
    assert {rule.rule for rule in listed} == {"column_axis", "elevation", "verticality_to_6m", "verticality_above_6m"}


def test_the_covariance_before_the_fit_is_that_of_the_scan_turned_into_the_column_frame(
    build: Any, square: Array
) -> None:
    """Drawn anew: a camera whose lengths are wrong by a common factor, points with noise across the foot."""
    seen = build.see(square, np.random.default_rng(4))
    u = np.array([[0.03, 0.0, 0.0], [0.01, 0.02, 0.0], [0.0, 0.0, 0.05]])
    own = seen.turned @ u @ u.T @ seen.turned.T
    lean = seen.turned @ np.diag([4e-6, 9e-6, 0.0]) @ seen.turned.T
    found = build.extraction(Kind.SLEEVE, seen, 36.0, None)
    points = tuple(replace(point, covariance=own, axis_covariance=lean) for point in found.points)
    design = build.points_of(Kind.SLEEVE, square, 36.0)
    match = match_extraction(design, found, up=Y_UP, image_up_scan=seen.image_up)
    report = inspect_group(design, replace(found, points=points), match, CN, scale_error=1e-3)
    rng, index = np.random.default_rng(5), 6
    point = report.points[index]
    assert point.scan_mm is not None
    assert point.cov_mm2 is not None
    scales = 1.0 + rng.normal(0.0, 1e-3, (200_000, 1))
    draws = np.array(point.scan_mm) * scales + rng.normal(size=(200_000, 3)) @ (seen.turned @ u).T
    in_plane = draws @ seen.turned[:, :2]
    assert np.allclose(point.cov_mm2, np.cov(in_plane.T), rtol=0.02, atol=1e-5)
    assert point.axis == pytest.approx((0.0, 0.0, 1.0), abs=1e-9)
    assert point.u_axis_deg == pytest.approx(np.rad2deg(np.sqrt(6.5e-6)))


def test_what_has_no_covariance_has_none_before_the_fit(build: Any, square: Array) -> None:
    report = inspected(build, square, square, u_mm=None, missing=(3,))
    assert all(point.cov_mm2 is None and point.u_axis_deg is None for point in report.points)
    assert [point.axis is None for point in report.points] == [k == 3 for k in range(12)]
