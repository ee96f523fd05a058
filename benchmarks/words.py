"""Write ``batch/journal_words.json``: what reports have in common, so that entries of the journal need not repeat it.

    python -m benchmarks.words

To be run again where reports have new keys or sentences; entries that were kept before are then checked again.
"""

from __future__ import annotations

import json
from pathlib import Path

from batch.job.file import read_job
from batch.runner.packed import words_of
from batch.runner.record import kept_text
from batch.runner.run import RunOptions, run_job
from benchmarks.floors import SAMPLE

_COLUMNS = ("C-304", "C-302")
"""One that fails, with all that reports can hold, nearest to the end, where it is reached in fewest bits."""

_WINDOW_BYTES = 32_000  # deflate looks back no further


def main() -> None:
    """Check two columns of the sample floor and keep the words of their reports."""
    job = read_job(SAMPLE / "job.toml")
    found = {column.id: column for column in run_job(job, RunOptions(only=_COLUMNS)).report.columns}
    words = "".join(words_of(kept_text(found[name])) for name in _COLUMNS)
    path = Path(__file__).resolve().parents[1] / "batch" / "journal_words.json"
    path.write_text(json.dumps(words[-_WINDOW_BYTES:], ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
