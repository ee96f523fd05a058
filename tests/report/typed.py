"""From the dictionaries that tests edit to the report that readers take."""

import json
from typing import Any

from aadm_workbench.model import ColumnReport, JobReport
from aadm_workbench.report.read import parsed_column, parsed_report


def typed(document: Any) -> JobReport:
    """The report of a document as report.json holds it."""
    return parsed_report(json.dumps(document), "made")


def of_column(entry: Any) -> ColumnReport:
    """One entry of its columns."""
    return parsed_column(json.dumps(entry))
