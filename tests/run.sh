#!/bin/sh
# All checks: sh tests/run.sh [pytest's options, e.g. -k plane]
#
# Lint, format, types, tests. Needs FreeCAD, Xvfb, Chromium and the graphics libraries that open3d loads; root, or sudo
# without a password, installs them. AADM_SKIP_FREECAD=1 and AADM_SKIP_CHROMIUM=1 leave out the tests that need these.
# Writes into this tree, the folder for temporary files and the caches of pip and apt alone.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)
. "$root/batch/setup.sh"
make_environment test

has_library() { "$venv/bin/python" -c 'import ctypes, sys; ctypes.CDLL(sys.argv[1])' "$1" 2>/dev/null; }
has_command() { command -v "$1" >/dev/null; }

missing=''
# What open3d loads when it is imported.
has_library libEGL.so.1 || missing="$missing libegl1"
has_library libGL.so.1 || missing="$missing libgl1"
has_library libusb-1.0.so.0 || missing="$missing libusb-1.0-0"
has_library libX11.so.6 || missing="$missing libx11-6"
# What gige:// cameras are reached with; it brings a simulated one.
has_library libaravis-0.8.so.0 || missing="$missing libaravis-0.8-0"
# What Mitsuba compiles with; without it the tests of the fringe camera are skipped.
has_renderer() { "$venv/bin/python" -c 'from aadm_workbench.twin.fringe.renderer import mitsuba_ready; mitsuba_ready()' 2>/dev/null; }
has_renderer || missing="$missing libllvm19"
if [ "${AADM_SKIP_CHROMIUM:-0}" != 1 ]; then
    has_command chromium || missing="$missing chromium"
fi
if [ "${AADM_SKIP_FREECAD:-0}" != 1 ]; then
    has_command freecadcmd || has_command FreeCADCmd || missing="$missing freecad"
    has_command Xvfb || missing="$missing xvfb"
fi
# shellcheck disable=SC2086  # names of packages hold no spaces
install_packages $missing

# The library of Mech-Eye's maker has wheels for few systems; without it its tests are skipped.
has_mecheye() { "$venv/bin/python" -c 'import mecheye' >/dev/null 2>&1; }
has_mecheye || "$venv/bin/python" -m pip install --no-deps --only-binary=:all: \
    --requirement "$root/requirements/mecheye.txt" >>"$log" 2>&1 || say "no mecheyeapi for this Python"

# The schemas that BCF files are valid against, which are read where they are published; without them that test is skipped.
schemas="$root/build/bcf-schemas"
[ -n "$(ls "$schemas" 2>/dev/null)" ] || "$venv/bin/python" -m pip download --no-deps --only-binary=:all: --dest "$schemas" \
    --requirement "$root/requirements/bcf-schemas.txt" >>"$log" 2>&1 || say "no schemas of BCF"

# Matplotlib, Dask, FreeCAD and others keep their settings at home, and read them there.
unset XDG_CACHE_HOME XDG_CONFIG_HOME XDG_DATA_HOME XDG_STATE_HOME
HOME="$root/build/home"
export HOME
mkdir -p "$HOME"

cd "$root"
say "ruff: lint and format"
"$venv/bin/python" -m ruff check --quiet
"$venv/bin/python" -m ruff format --quiet --check
say "mypy: types"
"$venv/bin/python" -m mypy
say "pytest"
exec "$venv/bin/python" -m pytest -n 2 "$@"
