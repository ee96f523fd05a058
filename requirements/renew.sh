#!/bin/sh
# Renews the pins: sh requirements/renew.sh [uv options, e.g. --no-upgrade to add what is new, --upgrade-package rich]
#
# Reads the ranges of pyproject.toml and writes requirements/demo.txt and requirements/test.txt: whole closures, one
# version for every Python from 3.11 to 3.14. Without options everything moves to its newest version. Fails where a pin
# has no wheel for one of those Pythons on Linux x86_64. Afterwards: sh batch/demo.sh && sh tests/run.sh
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)
cd "$root"
tools="$root/build/renew-pins"

python3 -m venv "$tools"
"$tools/bin/python" -m pip install --quiet --upgrade pip uv
[ "$#" -gt 0 ] || set -- --upgrade

# pin TARGET CONSTRAINTS [--extra NAME]: one closure. setuptools builds the editable install inside the environment.
pin() {
    target=$1 constraints=$2
    shift 2
    printf 'setuptools>=77\n' | "$tools/bin/uv" pip compile --quiet --universal --python-version 3.11 \
        --fork-strategy fewest --no-emit-package aadm-workbench --no-annotate \
        --custom-compile-command 'sh requirements/renew.sh' \
        --constraints "$constraints" --output-file "$target" "$@" pyproject.toml -
}
pin requirements/demo.txt /dev/null "$@" --extra reports
pin requirements/test.txt requirements/demo.txt --extra test "$@"

for version in 3.11 3.12 3.13 3.14; do
    echo "wheels for Python $version"
    "$tools/bin/python" -m pip install --quiet --dry-run --ignore-installed --no-deps --only-binary=:all: --no-binary=odfpy \
        --python-version "$version" --target "$tools/none" --requirement requirements/test.txt
done
