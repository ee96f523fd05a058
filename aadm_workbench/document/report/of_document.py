"""The results of a document as one report.json, from which every other report is made."""

from __future__ import annotations

from collections import Counter
from typing import Any

from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.result import JOB_KEYS, found_of, job_of
from aadm_workbench.errors import ReportError
from aadm_workbench.model import SUMMED


def report_of(document: Any) -> dict[str, Any]:
    """The content of a report.json with all results of a document, in its order.

    What the results say of job, tool and profile is taken from the first.

    Raises
    ------
    ReportError
        Where no column has a result yet, or they were judged by different tolerance profiles.
    """
    results = [column.Result for column in columns_in(document) if column.Result is not None]
    if not results:
        raise ReportError.because("document.no_result")
    jobs = [job_of(result) for result in results]
    profiles = sorted({(job.get("profile") or {}).get("name", "") for job in jobs})
    if len(profiles) > 1:
        raise ReportError.because("document.profiles", profiles=profiles)
    entries = [found_of(result) for result in results]
    counted = Counter(entry["verdict"] for entry in entries)
    return {
        **{key: jobs[0].get(key) for key in JOB_KEYS},
        "summary": {verdict.value: counted[verdict] for verdict in SUMMED},
        "columns": entries,
        "mould_drift": [],
    }
