#!/bin/sh
# Tests the Debian packages. Packing twice gives the same bytes, and lintian finds no error. apt installs them in a bare Debian 12, where the
# program makes a report and Python imports the module, if it was built.
#   tests/end_to_end/slow_bare_root.sh [BUILD]   default: build/release, with a built program
# Needs root, mmdebstrap, lintian and the Debian mirror that apt uses; ends with 77 without them.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
build=${1:-$root/build/release}
mirror=$(sed -n 's/^URIs: *//p; s/^deb \(\[[^]]*\] \)*\([^ ]*\) .*/\2/p' /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | grep -m1 '/debian/*$' || true)
if [ "$(id -u)" != 0 ] || ! command -v mmdebstrap >/dev/null || ! command -v lintian >/dev/null || [ -z "$mirror" ]; then
    echo "skipped: needs root, mmdebstrap, lintian and a Debian mirror of apt" >&2
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for time in one two; do
    (cd "$build" && cpack -G DEB -B "$work/$time" >"$work/log" 2>&1) || { cat "$work/log" >&2; exit 1; }
    mv "$work/$time"/meshfolio_*.deb "$work/$time.deb"
    mv "$work/$time"/python3-meshfolio_*.deb "$work/$time-python.deb" || echo "no Python module was built" >&2
done
module=
if [ -e "$work/one-python.deb" ]; then module=-python; fi
for package in "" $module; do
    cmp "$work/one$package.deb" "$work/two$package.deb"
    lintian --fail-on error --allow-root "$work/one$package.deb"
done

cat >"$work/inside" <<'END'
set -eu
cd /tmp
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
apt-get -qq update
began=$(date +%s)
apt-get install -qq -y /tmp/one.deb >/tmp/log 2>&1 || { cat /tmp/log; exit 1; }
installed=$(date +%s)
meshfolio report --quick
test -s out/index.html
echo "apt install $((installed - began)) s, report --quick $(($(date +%s) - installed)) s: $(($(date +%s) - began)) s to index.html"
meshfolio --version
meshfolio sample torus -o torus.ply
if [ -e /tmp/one-python.deb ]; then
    apt-get purge -qq -y meshfolio >/tmp/log 2>&1   # the module needs nothing of it
    began=$(date +%s)
    apt-get install -qq -y /tmp/one-python.deb >/tmp/log 2>&1 || { cat /tmp/log; exit 1; }
    echo "apt install python3-meshfolio $(($(date +%s) - began)) s"
    python3 -c "import meshfolio
mesh = meshfolio.load('/tmp/torus.ply')
assert mesh.euler_number == 0 and meshfolio.render(mesh, 'h-cotan').ndim == 3
print('Python', meshfolio.__version__, meshfolio.spectrum(mesh, 5).certificate)"
fi
END
mmdebstrap --quiet --mode=root --variant=apt --format=null --customize-hook="copy-in $work/one.deb ${module:+$work/one$module.deb} $work/inside /tmp" \
    --customize-hook='chroot "$1" sh /tmp/inside' bookworm - "$mirror"
