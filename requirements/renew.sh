#!/bin/sh
# Renews the pins: sh requirements/renew.sh [uv options, e.g. --no-upgrade to add what is new, --upgrade-package rich]
#
# Reads the ranges of pyproject.toml and writes requirements/demo.txt, freecad.txt and test.txt: whole closures, one
# version for every Python from 3.11 to 3.14. Without options everything moves to its newest version. Fails where a pin
# has no wheel for one of those Pythons on Linux x86_64, or a pin of freecad.txt none for Windows or macOS either.
# Fetches the pip that the workbench installs freecad.txt with. Afterwards: sh batch/demo.sh && sh tests/run.sh
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)
cd "$root"
tools="$root/build/renew-pins"

python3 -m venv "$tools"
"$tools/bin/python" -m pip install --quiet --upgrade pip uv
[ "$#" -gt 0 ] || set -- --upgrade

# pin TARGET CONSTRAINTS ALSO [--extra NAME]: one closure, with what ALSO names.
pin() {
    target=$1 constraints=$2 also=$3
    shift 3
    printf '%s\n' "$also" | "$tools/bin/uv" pip compile --quiet --universal --python-version 3.11 \
        --fork-strategy fewest --no-emit-package aadm-workbench --no-annotate \
        --custom-compile-command 'sh requirements/renew.sh' \
        --constraints "$constraints" --output-file "$target" "$@" pyproject.toml -
}
# setuptools builds the editable install inside the environment.
pin requirements/demo.txt /dev/null 'setuptools>=77' "$@" --extra reports
# What FreeCAD's private environment holds; psutil is all that processes of one machine need of the extra batch.
pin requirements/freecad.txt requirements/demo.txt psutil "$@" --extra reports --extra formats --extra mesh
pin requirements/test.txt requirements/freecad.txt 'setuptools>=77' --extra test "$@"

# Its pip: FreeCAD's Python may have none.
rm -f requirements/pip-*.whl
"$tools/bin/python" -m pip download --quiet --no-deps --only-binary=:all: --dest requirements pip

for version in 3.11 3.12 3.13 3.14; do
    echo "wheels for Python $version"
    "$tools/bin/python" -m pip install --quiet --dry-run --ignore-installed --no-deps --only-binary=:all: --no-binary=odfpy \
        --python-version "$version" --target "$tools/none" --requirement requirements/test.txt
done

missing=''
for platform in win_amd64 macosx_14_0_arm64 macosx_14_0_x86_64 manylinux_2_28_aarch64; do
    echo "wheels of the private environment for $platform"
    "$tools/bin/python" -m pip install --quiet --dry-run --ignore-installed --no-deps --only-binary=:all: \
        --python-version 3.11 --platform "$platform" --target "$tools/none" \
        --requirement requirements/freecad.txt || missing="$missing $platform"
done
[ -z "$missing" ] || { echo "FreeCAD's private environment cannot be installed on:$missing" >&2; exit 1; }
