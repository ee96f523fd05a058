"""Reading and writing a report.json inside FreeCAD: quickly, and without the packages that hold it against its schema.

Only what makes a file a report is looked at here; what a column of it should hold is looked at when it is shown.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from aadm_workbench.bounded import BoundsError, read_bounded
from aadm_workbench.errors import ReportError

SCHEMA = 1  # of report.json
LARGEST_REPORT_BYTES = 2**28
"""As :mod:`aadm_workbench.report.read` has it, which FreeCAD's own Python may not be able to import."""


def load_report(path: Path) -> dict[str, Any]:
    """The content of a report.json.

    Raises
    ------
    ReportError
        Where the file is missing, cut off, or no report of a check.
    """
    try:
        document = json.loads(read_bounded(path, LARGEST_REPORT_BYTES).decode("utf-8-sig"))
    except BoundsError as error:
        raise ReportError.about(path, "report.unusable", why=error) from error
    except OSError as error:
        raise ReportError.about(path, "report.unread", why=error.strerror) from error
    except (ValueError, RecursionError) as error:
        raise ReportError.about(path, "report.broken", why=error) from error
    columns = document.get("columns") if isinstance(document, dict) else None
    if not isinstance(columns, list) or not all(isinstance(one, dict) and "id" in one for one in columns):
        raise ReportError.about(path, "report.no_columns")
    if document.get("schema") != SCHEMA:
        raise ReportError.about(path, "report.schema", found=document.get("schema"), schema=SCHEMA)
    return document


def encoded(report: Mapping[str, Any]) -> bytes:
    """The bytes of a report.json; its numbers are those of the reports that it was made from."""
    return (json.dumps(report, ensure_ascii=False, indent=1) + "\n").encode(errors="replace")
