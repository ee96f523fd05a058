#!/bin/sh
# The tests that run FreeCAD, on the versions of several Debian releases: sh tests/freecad_versions.sh [trixie] [sid]
#
# Each release is set up once, in a folder of its own below build/freecad (3 GB each; AADM_CHROOTS names another place);
# this tree is not changed. Needs root and debootstrap. trixie has FreeCAD 1.0, sid 1.1; the machine's own version is
# tested first. Documents that one version has saved are opened by the others. Packages come from this machine's own
# Debian mirror, or from AADM_MIRROR.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)
chroots=${AADM_CHROOTS:-"$root/build/freecad"}
documents="$chroots/documents"
mirror=${AADM_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' | head -n 1)}
packages="ca-certificates fonts-noto-cjk freecad libegl1 libgl1-mesa-dri python3-pip python3-pytest xvfb"
# What the tests themselves need, beside FreeCAD; what FreeCAD's checks run with is made by the workbench's own button.
wheels="numpy scipy opencv-python-headless ifcopenshell msgspec psutil python-neo-lzf rich"
# The newest with which FreeCAD's native opening works, as its user may have put it there.
shown_by="ifcopenshell==0.8.4"
[ "$#" -gt 0 ] || set -- trixie sid
[ "$(id -u)" = 0 ] || { echo "this needs root, for chroot" >&2; exit 2; }
mkdir -p "$documents"
rm -f "$documents"/*.FCStd

say() { printf 'freecad_versions: %s\n' "$*" >&2; }

# inside DIR COMMAND...: in a chroot, without this machine's environment.
inside() {
    place=$1
    shift
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        PIP_CERT=/etc/ssl/certs/ca-certificates.crt AADM_ENVIRONMENTS=/opt/environments AADM_DOCUMENTS=/opt/documents \
        AADM_FREECAD_PACKAGES=/opt/ifc:/opt/packages \
        PYTHONPATH=/opt/aadm:/opt/packages chroot "$place" "$@"
}

set_up() {
    release=$1
    place=$2
    if [ ! -e "$place/usr/bin/apt-get" ]; then
        say "setting up $release in $place"
        debootstrap --variant=minbase --include=ca-certificates "$release" "$place" "$mirror"
        cp /etc/ssl/certs/ca-certificates.crt "$place/etc/ssl/certs/ca-certificates.crt"
        # Where the clock of a machine is not that of the mirror.
        echo 'Acquire::Check-Valid-Until "false"; Acquire::Check-Date "false";' >"$place/etc/apt/apt.conf.d/99clock"
    fi
    mountpoint -q "$place/proc" || mount -t proc proc "$place/proc"
    mountpoint -q "$place/dev" || mount --bind /dev "$place/dev"
    # A chroot of an earlier version of this script lacks what was added since: what it was set up with is its stamp.
    wanted=$(printf '%s\n' "$packages" "$wheels" "$shown_by" | cat - "$root/requirements/test.txt" | sha256sum)
    if [ "$(cat "$place/opt/ready" 2>/dev/null)" != "$wanted" ]; then
        rm -rf "$place/opt/packages" "$place/opt/ifc"
        inside "$place" apt-get update
        # shellcheck disable=SC2086  # names of packages hold no spaces
        inside "$place" apt-get install --yes --no-install-recommends $packages
        cp /etc/ssl/certs/ca-certificates.crt "$place/etc/ssl/certs/ca-certificates.crt"
        cp "$root/requirements/test.txt" "$place/opt/pins.txt"
        # shellcheck disable=SC2086
        inside "$place" python3 -m pip install --quiet --disable-pip-version-check --target /opt/packages \
            --constraint /opt/pins.txt $wheels
        inside "$place" python3 -m pip install --quiet --disable-pip-version-check --target /opt/ifc --no-deps \
            "$shown_by"
        printf '%s\n' "$wanted" >"$place/opt/ready"
    fi
}

tests() {
    place=$1
    rm -rf "$place/opt/aadm"
    mkdir -p "$place/opt/aadm" "$place/opt/documents"
    tar -C "$root" --exclude=./.git --exclude=./.venv --exclude=./build --exclude=__pycache__ -cf - . |
        tar -C "$place/opt/aadm" -xf -
    cp "$documents"/*.FCStd "$place/opt/documents/" 2>/dev/null || true
    inside "$place" sh -c 'cd /opt/aadm && python3 -m pytest -q -p no:cacheprovider --basetemp=/tmp/aadm tests/gui tests/document'
    cp "$place"/opt/documents/*.FCStd "$documents/"
}

failed=0
say "FreeCAD of this machine"
python=${AADM_PYTHON:-"$root/.venv/bin/python"}
(cd "$root" && AADM_DOCUMENTS="$documents" "$python" -m pytest -q -p no:cacheprovider tests/gui tests/document) || failed=1
for release in "$@"; do
    place="$chroots/$release"
    set_up "$release" "$place"
    say "FreeCAD of $release"
    tests "$place" || failed=1
done
say "documents of the newest, opened by this machine's"
(cd "$root" && AADM_DOCUMENTS="$documents" "$python" -m pytest -q -p no:cacheprovider tests/document/test_other_versions.py) || failed=1
exit "$failed"
