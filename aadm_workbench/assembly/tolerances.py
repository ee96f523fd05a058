"""Tolerance profiles: named sets of limits, each with its clause and how far it was verified.

A profile is a TOML file, one of this package's or the user's own::

    schema = 1
    title = "Our yard"

    [[rules]]
    name = "sleeve_position"        # unique within the profile
    limits = "sleeve_position"      # what it limits, one of QUANTITIES
    upper_mm = 2.0
    clause = "T/CCES 30-2022, 4.3.3"
    edition = "2022"
    severity = "shall"              # or "should"
    source = "verified"             # or "unverified": recalled, nobody has opened the text

and, where they differ from the default: ``lower_mm`` (signed limits), ``kind`` (``radial``, ``per_axis`` or
``signed``), ``level`` (``bar_in_group``, ``group_to_datum`` or ``component``), ``advisory`` (reported, not
counted), ``note``.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeAlias

from aadm_workbench.errors import JobError
from aadm_workbench.model import (
    GroupReport,
    PointResult,
    Profile,
    Reason,
    Rule,
    RuleResult,
    SpacingResult,
    TrialReport,
    Verdict,
    in_one,
    worst,
)

QUANTITIES = {
    "sleeve_position": "radial",
    "rebar_position": "radial",
    "sleeve_spacing": "signed",
    "rebar_spacing": "signed",
    "sleeve_rebar_distance": "radial",
    "rebar_exposed_length": "signed",
    "rebar_adjustment": "radial",
    "group_position": "radial",
    "column_axis": "radial",
    "elevation": "signed",
    "verticality": "signed",
    "section_size": "signed",
    "pattern_in_section": "per_axis",
    "face_flatness": "signed",
    "bearing_length": "signed",
    "flushness": "signed",
    "inclination": "signed",
}
"""What a rule can limit, and how its deviation is taken unless the rule says otherwise."""

_KINDS = ("radial", "per_axis", "signed")
_LEVELS = ("bar_in_group", "group_to_datum", "component")
_SEVERITIES = ("shall", "should")
_SOURCES = ("verified", "unverified")
_TYPES: dict[str, tuple[type, ...]] = {
    "name": (str,),
    "limits": (str,),
    "upper_mm": (int, float),
    "lower_mm": (int, float),
    "clause": (str,),
    "edition": (str,),
    "severity": (str,),
    "source": (str,),
    "kind": (str,),
    "level": (str,),
    "advisory": (bool,),
    "working_figure": (bool,),
    "note": (str,),
}
_NOT = {str: "jobfile.not_text", float: "jobfile.not_number", bool: "jobfile.not_boolean"}
"""What is said of a value of another type."""

_REQUIRED = ("name", "limits", "upper_mm", "clause", "severity", "source")

_Table: TypeAlias = dict[str, Any]

_OF_THE_ERECTED_COLUMN = ("column_axis", "elevation", "verticality")


def profile_names() -> tuple[str, ...]:
    """Names of the built-in profiles, sorted."""
    return tuple(sorted(path.stem for path in _folder().glob("*.toml")))


def load_profile(name: str, beside: Path | None = None) -> Profile:
    """Read a built-in profile by its name, or a profile file by its path.

    Parameters
    ----------
    name
        Name of a built-in profile, or a path that ends in ``.toml``.
    beside
        Folder that a relative path starts from: the folder of the job.

    Raises
    ------
    JobError
        If there is no such profile (the message lists those there are) or its text is wrong.
    """
    if not name.endswith(".toml"):
        path = _folder() / f"{name}.toml"
        if name not in profile_names():
            known = ", ".join(profile_names())
            raise JobError.because("jobfile.profile_unknown", name=repr(name), known=known)
    else:
        path = (beside or Path()) / name
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise JobError.because("jobfile.profile_unread", path=path, why=error) from error
    return parse_profile(text, path.stem, str(path))


def parse_profile(text: str, name: str, source: str) -> Profile:
    """Read the text of a profile; ``source`` is the file that errors name.

    Raises
    ------
    JobError
        With the file and the key, or the line, that is wrong.
    """
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        from aadm_workbench.bounded import toml_fault

        raise JobError.about(source, "jobfile.profile_no_toml", why=toml_fault(error)) from error
    if table.get("schema") != 1:
        raise JobError.about(source, "jobfile.profile_schema", found=repr(table.get("schema")))
    unknown = sorted(set(table) - {"schema", "name", "title", "rules"})
    if unknown:
        raise JobError.about(
            source, "jobfile.profile_unknown_key", key=repr(unknown[0]), known="name, rules, schema, title"
        )
    for key in ("name", "title"):
        if not isinstance(table.get(key, ""), str):
            raise JobError.about(source, "jobfile.not_text", key=key, shown=repr(table[key]))
    entries = table.get("rules", [])
    if not isinstance(entries, list) or not entries or not all(isinstance(entry, dict) for entry in entries):
        raise JobError.about(source, "jobfile.profile_no_rules")
    rules = tuple(_rule(entry, f"{source}: rules[{number}]") for number, entry in enumerate(entries, start=1))
    names = [rule.name for rule in rules]
    for rule_name in names:
        if names.count(rule_name) > 1:
            raise JobError.about(source, "jobfile.profile_same_name", name=repr(rule_name))
    adjustment = next((rule.upper for rule in rules if rule.limits == "rebar_adjustment"), None)
    return Profile(table.get("name", name), table.get("title", name), rules, adjustment)


def rules_for(profile: Profile, quantity: str) -> tuple[Rule, ...]:
    """The rules that limit one quantity, the governing one first: counted before advisory, then the tightest."""
    found = [rule for rule in profile.rules if rule.limits == quantity]
    return tuple(sorted(found, key=lambda rule: (rule.advisory, rule.upper)))


def describe_clause(rule: Rule) -> str:
    """The clause as messages print it, with the mark of a limit that nobody has verified."""
    return rule.clause if rule.source == "verified" else Reason("assembly.unverified", clause=rule.clause)


def describe_limit(rule: Rule | None) -> Reason:
    """The upper limit of a rule as messages print it, with its clause."""
    if rule is None:
        return Reason("assembly.no_limit")
    return Reason("assembly.limit", upper=rule.upper, clause=describe_clause(rule))


def _folder() -> Path:
    return Path(__file__).resolve().parents[1] / "resources" / "tolerances"


def _rule(entry: _Table, where: str) -> Rule:
    where = f"{where} ({entry['name']})" if isinstance(entry.get("name"), str) else where
    for key, value in entry.items():
        if key not in _TYPES:
            raise JobError.about(where, "jobfile.profile_unknown_key", key=repr(key), known=sorted(_TYPES))
        if not isinstance(value, _TYPES[key]) or (isinstance(value, bool) and bool not in _TYPES[key]):
            raise JobError.about(where, _NOT[_TYPES[key][-1]], key=key, shown=repr(value))
    for key in _REQUIRED:
        if key not in entry:
            raise JobError.about(where, "jobfile.profile_missing", key=repr(key))
    _one_of(entry["limits"], tuple(QUANTITIES), where, "limits")
    kind = entry.get("kind", QUANTITIES[entry["limits"]])
    _one_of(kind, _KINDS, where, "kind")
    if (kind == "signed") != (QUANTITIES[entry["limits"]] == "signed"):
        raise JobError.about(where, "jobfile.profile_kind", limits=entry["limits"], kind=kind)
    _one_of(entry["severity"], _SEVERITIES, where, "severity")
    _one_of(entry["source"], _SOURCES, where, "source")
    _one_of(entry.get("level", "bar_in_group"), _LEVELS, where, "level")
    _check_limits(entry, kind, where)
    return Rule(
        name=entry["name"],
        limits=entry["limits"],
        upper_mm=float(entry["upper_mm"]),
        lower_mm=float(entry["lower_mm"]) if "lower_mm" in entry else None,
        clause=entry["clause"],
        severity=entry["severity"],
        source=entry["source"],
        advisory=entry.get("advisory", False),
        edition=entry.get("edition", ""),
        note=entry.get("note", ""),
        kind=kind,
        level=entry.get("level", "bar_in_group"),
        working_figure=entry.get("working_figure", False),
    )


def _one_of(value: str, known: tuple[str, ...], where: str, key: str) -> None:
    if value not in known:
        raise JobError.about(where, "jobfile.profile_one_of", key=key, known=known, found=repr(value))


def _check_limits(entry: _Table, kind: str, where: str) -> None:
    upper, lower = float(entry["upper_mm"]), float(entry.get("lower_mm", -math.inf))
    if not math.isfinite(upper) or ("lower_mm" in entry and not math.isfinite(lower)):
        raise JobError.about(where, "jobfile.profile_finite")
    if kind == "signed":
        if lower >= upper:
            raise JobError.about(where, "jobfile.profile_order", lower=lower, upper=upper)
    elif "lower_mm" in entry:
        raise JobError.about(where, "jobfile.profile_no_lower", kind=kind)
    elif upper <= 0.0:
        raise JobError.about(where, "jobfile.profile_positive", upper=upper)


def applicable_rules(profile: Profile, quantity: str) -> tuple[tuple[Rule, ...], tuple[Rule, ...]]:
    """Rules that hold within the group, the governing one first, and those that hold against a datum."""
    rules = rules_for(profile, quantity)
    within = tuple(rule for rule in rules if rule.level == "bar_in_group")
    return within, tuple(rule for rule in rules if rule.level != "bar_in_group")


def position_result(rule: Rule, points: Sequence[PointResult]) -> RuleResult:
    """What one rule of position came to over all points of a group."""
    deviations = [point.deviation_mm for point in points if point.deviation_mm is not None]
    verdict, reason = _worst_of([point.verdict for point in points], [point.reason for point in points])
    return rule_result(rule, verdict, reason, max(deviations, default=None))


def spacing_result(rule: Rule, spacing: Sequence[SpacingResult]) -> RuleResult:
    """What one rule of spacing came to over all adjacent pairs of a group."""
    deviations = [pair.deviation_mm for pair in spacing if pair.deviation_mm is not None]
    verdict, reason = _worst_of([pair.verdict for pair in spacing], [pair.reason for pair in spacing])
    return rule_result(rule, verdict, reason, max(deviations, key=abs, default=None))


def _worst_of(verdicts: Sequence[Verdict], reasons: Sequence[str]) -> tuple[Verdict, str]:
    """The worst verdict, and the reasons of all that are not a pass, the worst first."""
    order = (Verdict.FAIL, Verdict.NOT_MEASURED, Verdict.INCONCLUSIVE)
    ordered = [reason for kind in order for verdict, reason in zip(verdicts, reasons, strict=True) if verdict is kind]
    return worst(verdicts), in_one(reason for reason in ordered if reason)


def rule_result(rule: Rule, verdict: Verdict, reason: str, worst_mm: float | None = None) -> RuleResult:
    """The result of one rule, marked with its clause, its source and whether it counts."""
    return RuleResult(rule.name, describe_clause(rule), rule.source, verdict, not rule.advisory, reason, worst_mm)


def not_assessed(rule: Rule, reason: str) -> RuleResult:
    """The result of a rule for which there is no input."""
    return rule_result(rule, Verdict.NOT_ASSESSED, reason)


def counted_verdict(rules: Sequence[RuleResult]) -> Verdict:
    """Worst of the rules that count; not assessed where there is none."""
    counted = [rule.verdict for rule in rules if rule.counted and rule.verdict is not Verdict.NOT_ASSESSED]
    return worst(counted) if counted else Verdict.NOT_ASSESSED


def sum_up(
    sleeves: GroupReport | None, rebars: GroupReport | None, trial: TrialReport | None
) -> tuple[Verdict, Verdict, tuple[str, ...]]:
    """Verdict of a column, whether it goes on its bars, and the reasons.

    The verdict is the worst of what was asked for (None: not asked for): error, fail, not measured, inconclusive,
    pass. Whether it goes on is the trial's verdict alone: a bar may be 4 mm from design and the column still go on.
    What is in the way is the first reason.
    """
    parts = [part for part in (sleeves, rebars, trial) if part is not None]
    goes_on = Verdict.NOT_ASSESSED if trial is None else trial.verdict
    said = tuple(reason for part in parts if part.verdict is not Verdict.PASS for reason in part.reasons)
    if trial is not None and trial.in_the_way:
        said = (trial.reasons[0], *said)
    return worst(part.verdict for part in parts), goes_on, tuple(dict.fromkeys(said))


def rules_of_the_erected_column(profile: Profile) -> tuple[RuleResult, ...]:
    """The rules of a profile that no scan before hoisting can answer, as not assessed."""
    return tuple(
        not_assessed(rule, Reason("assembly.erected"))
        for rule in profile.rules
        if rule.limits in _OF_THE_ERECTED_COLUMN
    )
