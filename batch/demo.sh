#!/bin/sh
# Shows the product at work: sh batch/demo.sh
#
# Makes .venv, checks the sample floor from its scans and compares each column's verdict with the truth that the scans
# were made from. Needs Python 3.11 or newer with venv (Debian: python3-venv) and the package index; ends with 0 only
# when every verdict agrees.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)
. "$root/batch/setup.sh"
make_environment demo

report="$root/build/demo-report"
rm -rf "$report"
say "checking the columns of samples/floor"
exit_code=0
"$venv/bin/aadm" check "$root/samples/floor/job.toml" --out "$report" || exit_code=$?
"$venv/bin/python" -m aadm_batch.demo_verdicts "$root/samples/floor/truth.json" "$report/report.json" --exit-code "$exit_code"
