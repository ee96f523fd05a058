"""What a frame of a hanging column does not show: it may speak against the column, and never for it by itself."""

import pytest

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.hoisting.measure import HoistingSettings, measure_hoisting
from aadm_workbench.hoisting.unseen import unseen_in_words, verdict_unseen, would_pass
from aadm_workbench.model import HoistingPair, HoistingReport, Verdict
from aadm_workbench.report.words.reasons import in_both_languages
from aadm_workbench.twin.scenes import LAB
from tests import hoisting_scenes as scenes

DESIGN = inline_design(
    "L-1", {"sleeve_diameter": 26.0, "rebar_diameter": 18.0, "size": [250.0, 250.0], "centres": LAB.centres().tolist()}
)


def measured(**before: object) -> HoistingReport:
    """A frame whose hidden pairs would pass by their pattern: it is trusted to a tenth of a millimetre."""
    settings = HoistingSettings(load_profile("cn"), scatter_mm=0.1)
    return measure_hoisting(
        scenes.usual().frame.scan(),
        DESIGN,
        near=scenes.NEAR,
        settings=settings,
        **before,  # type: ignore[arg-type]
    ).report


def test_inferred_pairs_do_not_pass_and_keep_the_frame_from_passing() -> None:
    report = measured()
    hidden = [pair for pair in report.pairs if not pair.seen]
    surely_within = [pair for pair in hidden if (pair.probability or 0.0) >= 0.95]
    assert surely_within, "without the rule they would pass"
    assert {pair.verdict for pair in surely_within} == {Verdict.INCONCLUSIVE}
    assert any(pair.verdict is Verdict.PASS for pair in report.pairs if pair.seen)
    assert report.verdict in (Verdict.INCONCLUSIVE, Verdict.FAIL)
    said = next(reason for reason in report.reasons if "look from another corner" in reason)
    for pair in surely_within:
        assert (pair.sleeve in said) is not pair.sleeve_seen
        assert (pair.rebar in said) is not pair.rebar_seen
    assert "请从另一角拍摄" in in_both_languages(said)[1]


def test_scans_from_before_hoisting_may_speak_for_what_is_hidden() -> None:
    truth = scenes.usual()
    sleeves, rebars = scenes.before(truth.foot, 0.02, 0), scenes.before(truth.bars, 0.02, 1)
    report = measured(sleeves_before=sleeves, rebars_before=rebars)
    hidden = [pair for pair in report.pairs if not pair.seen and (pair.probability or 0.0) >= 0.95]
    assert hidden
    assert {pair.verdict for pair in hidden} == {Verdict.PASS}
    assert all("measured before hoisting" in pair.reason for pair in hidden)
    # A bar that was absent from its scan is not vouched for by the scan of the others.
    lost = next(pair for pair in hidden if not pair.rebar_seen)
    index = [bar.label for bar in DESIGN.rebars].index(lost.rebar)
    without = [None if k == index else bar for k, bar in enumerate(rebars)]
    again = measured(sleeves_before=sleeves, rebars_before=without)
    assert again.pairs[index].verdict is not Verdict.PASS


@pytest.mark.parametrize(
    ("verdict", "unseen", "before", "expected"),
    [
        (Verdict.PASS, [], [], Verdict.PASS),
        (Verdict.PASS, ["R1"], [], Verdict.INCONCLUSIVE),
        (Verdict.PASS, ["S1", "R1"], ["S1"], Verdict.INCONCLUSIVE),
        (Verdict.PASS, ["S1"], ["S1", "R1"], Verdict.PASS),
        (Verdict.FAIL, ["R1"], [], Verdict.FAIL),
        (Verdict.NOT_ASSESSED, ["R1"], [], Verdict.NOT_ASSESSED),
    ],
)
def test_only_evidence_makes_a_pass(verdict: Verdict, unseen: list[str], before: list[str], expected: Verdict) -> None:
    assert verdict_unseen(verdict, unseen, before) is expected


def test_each_hidden_point_is_named_with_where_its_place_comes_from() -> None:
    said = unseen_in_words(["S1", "R1"], ["S1"])
    assert said == "R1 not seen: inferred from the others; S1 not seen: where it was measured before hoisting"
    assert unseen_in_words([], ["S1"]) == ""


def test_by_value_alone_an_unseen_pair_is_not_called_too_close_to_its_limit() -> None:
    """A simple decision states no probability."""
    pair = HoistingPair("S1", "R1", None, None, (0.1, 0.0), 0.1, 0.2, False, verdict=Verdict.INCONCLUSIVE)
    assert would_pass(pair)
