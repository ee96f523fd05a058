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

# uv, since pip holds markers against the machine that it runs on. macOS: 14, for which OpenCV is built; Linux: glibc
# 2.31, that of Debian 11.
missing=''
for platform in x86_64-pc-windows-msvc aarch64-apple-darwin x86_64-apple-darwin aarch64-manylinux_2_31; do
    for version in 3.11 3.14; do
        echo "wheels of the private environment for $platform, Python $version"
        MACOSX_DEPLOYMENT_TARGET=14.0 "$tools/bin/uv" pip install --quiet --dry-run --no-deps --only-binary :all: \
            --python-platform "$platform" --python-version "$version" --target "$tools/none" \
            --requirement requirements/freecad.txt || missing="$missing $platform"
    done
done
[ -z "$missing" ] || { echo "FreeCAD's private environment cannot be installed on:$missing" >&2; exit 1; }
