"""Built-in profiles, profiles of the user, and what is wrong with a profile's text."""

from pathlib import Path

import pytest

from aadm_workbench.assembly.tolerances import (
    QUANTITIES,
    describe_clause,
    load_profile,
    parse_profile,
    profile_names,
    rules_for,
)
from aadm_workbench.errors import JobError

RULE = """
[[rules]]
name = "sleeve_position"
limits = "sleeve_position"
upper_mm = 2.0
clause = "our own"
severity = "shall"
source = "verified"
"""


def text(*changes: tuple[str, str]) -> str:
    whole = "schema = 1\n" + RULE
    for old, new in changes:
        assert old in whole
        whole = whole.replace(old, new)
    return whole


def test_default_profile_holds_the_two_published_rules() -> None:
    cn = load_profile("cn")
    limits = {rule.name: (rule.lower, rule.upper, rule.clause, rule.source) for rule in cn.rules}
    assert limits["sleeve_rebar_distance"] == (None, 3.0, "GB/T 51231-2016, 10.4", "verified")
    for kind in ("sleeve", "rebar"):
        assert limits[f"{kind}_position"] == (None, 2.0, "T/CCES 30-2022, 4.3.3", "verified")
        assert limits[f"{kind}_spacing"] == (-2.0, 2.0, "T/CCES 30-2022, 4.3.3", "verified")
    assert limits["rebar_exposed_length"][:2] == (0.0, 10.0)
    assert limits["rebar_exposed_length"][3] == "unverified"
    adjustment = cn.rule("rebar_adjustment")
    assert adjustment is not None
    assert adjustment.source == "unverified"
    assert cn.adjustment_limit_mm == adjustment.upper


def test_every_built_in_profile_loads_and_is_honest() -> None:
    names = profile_names()
    assert {"cn", "cn-gbt51231-2016", "cn-tcces30-2022", "cn-jgj355-2015", "cn-jgj1-2014", "cn-gb50204-2015"} < set(
        names
    )
    assert "us-nmb-2014" in names
    for name in names:
        profile = load_profile(name)
        assert profile.name == name
        for rule in profile.rules:
            assert rule.clause
            assert rule.limits in QUANTITIES
            assert rule.note or rule.source == "verified", f"{name}: {rule.name} does not say what it rests on"
            assert ("unverified" in describe_clause(rule)) == (rule.source == "unverified")


@pytest.mark.parametrize(
    ("name", "quantity", "upper_mm", "source"),
    [
        ("cn-jgj355-2015", "rebar_position", 3.0, "unverified"),
        ("cn-jgj355-2015", "rebar_exposed_length", 15.0, "unverified"),
        ("cn-jgj1-2014", "sleeve_rebar_distance", 5.0, "unverified"),
        ("cn-gb50204-2015", "rebar_position", 5.0, "verified"),
        ("us-nmb-2014", "rebar_position", 3.175, "verified"),
        ("us-nmb-2014", "group_position", 6.35, "verified"),
    ],
)
def test_limits_of_other_profiles(name: str, quantity: str, upper_mm: float, source: str) -> None:
    rule = rules_for(load_profile(name), quantity)[0]
    assert (rule.upper, rule.source) == (upper_mm, source)


def test_unknown_profile_lists_those_there_are() -> None:
    with pytest.raises(JobError, match=r"'dwarf'.*cn, cn-gb50204-2015"):
        load_profile("dwarf")


def test_profile_beside_the_job(tmp_path: Path) -> None:
    (tmp_path / "yard.toml").write_text(text(("upper_mm = 2.0", "upper_mm = 1.5\nadvisory = true")), encoding="utf-8")
    profile = load_profile("yard.toml", beside=tmp_path)
    assert profile.name == "yard"
    assert profile.rules[0].upper == 1.5
    assert profile.rules[0].advisory
    assert load_profile(str(tmp_path / "yard.toml")).rules == profile.rules
    with pytest.raises(JobError, match=r"lost\.toml cannot be read"):
        load_profile("lost.toml", beside=tmp_path)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ((("schema = 1", "schema = 2"),), "schema must be 1"),
        ((("schema = 1", "schema = 1\ncolour = 3"),), "unknown key 'colour'"),
        ((("schema = 1", "schema = 1\ntitle = 3"),), "title must be text"),
        ((("upper_mm = 2.0", ""),), "'upper_mm' is missing"),
        ((("upper_mm = 2.0", "upper_mm = '2'"),), "upper_mm must be a number"),
        ((("upper_mm = 2.0", "upper_mm = true"),), "upper_mm must be a number"),
        ((("upper_mm = 2.0", "upper_mm = nan"),), "finite"),
        ((("upper_mm = 2.0", "upper_mm = -2.0"),), "above zero"),
        ((("upper_mm = 2.0", "upper_mm = 2.0\nlower_mm = -2.0"),), "no lower end"),
        ((("upper_mm = 2.0", "upper_mm = 2.0\nfloor = 1"),), "unknown key 'floor'"),
        ((('limits = "sleeve_position"', 'limits = "sleeves"'),), "limits must be one of"),
        ((('severity = "shall"', 'severity = "must"'),), "severity must be one of shall, should"),
        ((('source = "verified"', 'source = "sure"'),), "source must be one of"),
        ((("upper_mm = 2.0", 'upper_mm = 2.0\nkind = "signed"'),), "cannot be signed"),
        ((("upper_mm = 2.0", 'upper_mm = 2.0\nlevel = "house"'),), "level must be one of"),
        (
            (
                ('limits = "sleeve_position"', 'limits = "sleeve_spacing"'),
                ("upper_mm = 2.0", "upper_mm=2.0\nlower_mm=3"),
            ),
            "must be below",
        ),
        (((RULE, ""),), "at least one"),
        (((RULE, RULE + RULE),), "two rules have the name 'sleeve_position'"),
        (((RULE, "[[rules\n"),), "not TOML.*line 2"),
    ],
)
def test_wrong_text_names_the_file_and_the_key(changes: tuple[tuple[str, str], ...], said: str) -> None:
    with pytest.raises(JobError, match=said) as caught:
        parse_profile(text(*changes), "yard", "jobs/yard.toml")
    assert "jobs/yard.toml" in str(caught.value)


def test_the_tightest_counted_rule_governs() -> None:
    more = RULE.replace('name = "sleeve_position"', 'name = "{}"').replace("2.0", "{}")
    whole = text() + more.format("loose", 5.0) + more.format("tight", 1.0) + "advisory = true\n"
    ordered = rules_for(parse_profile(whole, "yard", "yard.toml"), "sleeve_position")
    assert [rule.name for rule in ordered] == ["sleeve_position", "loose", "tight"]
