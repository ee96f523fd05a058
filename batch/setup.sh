# shellcheck shell=sh
# Sourced by batch/demo.sh and tests/run.sh, which set $root: finds a Python, makes .venv and keeps it up to date.
# AADM_PYTHON names the Python to make it with, AADM_VENV another place for it. Details go to build/setup.log.

venv=${AADM_VENV:-"$root/.venv"}
log="$root/build/setup.log"
mkdir -p "$root/build"
: >"$log"
# What the caller's shell points Python at must not decide what is imported here.
unset PYTHONPATH PYTHONHOME VIRTUAL_ENV
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_INPUT=1

say() { printf 'aadm: %s\n' "$*" >&2; }

die() {
    say "$*"
    exit 1
}

quietly() {
    "$@" >>"$log" 2>&1 </dev/null && return
    tail -n 25 "$log" >&2
    die "this failed: $*"
}

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi; }

may_install() {
    command -v apt-get >/dev/null || return 1
    [ "$(id -u)" = 0 ] || { command -v sudo >/dev/null && sudo -n true 2>/dev/null; }
}

# install_packages NAME...: Debian packages, or the command that installs them for whoever lacks the rights.
install_packages() {
    [ "$#" -gt 0 ] || return 0
    may_install || die "missing Debian packages: $*. Install them with: sudo apt-get install $*"
    say "installing Debian packages: $*"
    # A third-party source that cannot be reached does not matter as long as the packages are found.
    as_root apt-get -o DPkg::Lock::Timeout=300 update >>"$log" 2>&1 </dev/null || say "apt-get update failed; trying with the old lists"
    quietly as_root env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 \
        install --yes --no-install-recommends "$@"
}

is_new_enough() { "$1" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; }
makes_environments() { is_new_enough "$1" && "$1" -c 'import ensurepip, venv' 2>/dev/null; }

# Sets $python. The system's own comes first: FreeCAD's Debian package is built for it.
find_python() {
    if [ -n "${AADM_PYTHON:-}" ]; then
        makes_environments "$AADM_PYTHON" || die "AADM_PYTHON=$AADM_PYTHON is no Python 3.11 or newer with venv and pip"
        python=$AADM_PYTHON
        return
    fi
    if is_new_enough /usr/bin/python3 && ! makes_environments /usr/bin/python3 && may_install; then
        install_packages python3-venv
    fi
    for python in /usr/bin/python3 python3 python3.14 python3.13 python3.12 python3.11; do
        if makes_environments "$python"; then return; fi
    done
    if ! command -v python3 >/dev/null || is_new_enough python3; then
        install_packages python3-venv
        python=/usr/bin/python3
        if makes_environments "$python"; then return; fi
    fi
    die "no Python 3.11 or newer was found; name one with AADM_PYTHON=/path/to/python"
}

# What an environment is bound to: its Python, and its place, which pip writes into every command.
made_of() { "$venv/bin/python" -c 'import sys, pip; print(sys.version)' 2>/dev/null && printf '%s\n' "$venv"; }

is_sound() {
    if [ -e "$venv/aadm-busy" ]; then
        say "the last run was interrupted while it made $venv"
        return 1
    fi
    made=$(made_of) && is_new_enough "$venv/bin/python" || return 1
    # Without the record the environment is somebody's own, which runs: it is used as it is.
    [ ! -e "$venv/aadm-made" ] || [ "$made" = "$(cat "$venv/aadm-made")" ]
}

# make_environment demo|test: afterwards $venv holds the pinned packages and this project, editable.
make_environment() {
    if command -v flock >/dev/null; then
        exec 9>"$root/build/setup.lock"
        flock 9
    fi
    if ! is_sound; then
        if is_new_enough "$venv/bin/python" && [ ! -e "$venv/aadm-made" ] && [ ! -e "$venv/aadm-busy" ]; then
            die "$venv was not made by this script and has no pip; remove it, or name another place with AADM_VENV"
        fi
        find_python
        say "making a Python environment in $venv with $("$python" --version)"
        # What an interrupted run had started may still be writing there.
        rm -rf "$venv" 2>>"$log" || { sleep 3 && rm -rf "$venv"; }
        mkdir -p "$venv"
        : >"$venv/aadm-busy"
        quietly "$python" -m venv "$venv"
        rm "$venv/aadm-busy"
    fi
    wanted=$(cat "$root/requirements/demo.txt" "$root/requirements/test.txt" "$root/pyproject.toml")
    if [ "$wanted" != "$(cat "$venv/aadm-wanted" 2>/dev/null)" ]; then rm -f "$venv/aadm-has-demo" "$venv/aadm-has-test"; fi
    if [ -e "$venv/aadm-has-$1" ] || [ -e "$venv/aadm-has-test" ]; then
        say "the Python environment is up to date"
    else
        say "installing the pinned packages of requirements/$1.txt"
        : >"$venv/aadm-busy"
        # --no-deps and --no-index: nothing comes in that is not pinned. odfpy (of ifctester) was never built as a wheel.
        quietly "$venv/bin/python" -m pip install --no-deps --only-binary=:all: --no-binary=odfpy \
            --requirement "$root/requirements/$1.txt"
        quietly "$venv/bin/python" -m pip install --no-deps --no-index --no-build-isolation --editable "$root"
        # pip compiles what it copies; an editable tree would be compiled by its first check.
        quietly "$venv/bin/python" -m compileall -q "$root/aadm_workbench" "$root/batch"
        quietly "$venv/bin/python" -m pip check
        made_of >"$venv/aadm-made"
        printf '%s\n' "$wanted" >"$venv/aadm-wanted"
        : >"$venv/aadm-has-$1"
        rm "$venv/aadm-busy"
    fi
    if command -v flock >/dev/null; then exec 9>&-; fi
}
