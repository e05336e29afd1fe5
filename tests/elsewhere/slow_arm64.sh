#!/bin/sh
# Cross-compiles the layers for arm64 with warnings as errors, runs their unit tests by qemu-user, and draws one mesh: the bytes of this machine.
#   tests/elsewhere/slow_arm64.sh [TARGETS…]   default: base_tests render_tests mesh_tests geometry_tests
# Needs root and the Debian 12 mirror that apt knows; ends with 77 without them. Everything is in build/arm64, and packages of this machine stay as they are.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
. "$root/tests/setup.sh"
mirror=$(sed -n 's/^URIs: *//p; s/^deb \(\[[^]]*\] \)*\([^ ]*\) .*/\2/p' /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | grep -m1 '/debian/*$' || true)
if [ "$(id -u)" != 0 ] || [ -z "$mirror" ]; then
    echo "skipped: needs root and a Debian mirror of apt" >&2
    exit 77
fi
install_packages $build_packages mmdebstrap g++-12-aarch64-linux-gnu qemu-user
packages=$root/build/arm64/packages build=$root/build/arm64/build
mkdir -p "$root/build/arm64"

if [ ! -e "$packages/usr" ]; then
    names=$(for name in $build_packages $test_packages; do echo "$name"; done | grep -E '^(lib.*|nettle|nlohmann-json3)-dev$|^fonts-' | paste -sd ,)
    mmdebstrap --quiet --mode=root --variant=extract --architectures=arm64 --include="libc6-dev,$names" bookworm "$packages" "$mirror"
    ln -sf openblas-serial/libblas.so.3 openblas-serial/liblapack.so.3 "$packages/usr/lib/aarch64-linux-gnu"   # as its postinst would
fi

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$root/tests/elsewhere/arm64.cmake" -DMESHFOLIO_ARM64_ROOT="$packages" \
    -DCMAKE_BUILD_TYPE=Release -DMESHFOLIO_WERROR=ON -DMESHFOLIO_VIEWER=OFF -DMESHFOLIO_JOIN_SOURCES=ON -DMESHFOLIO_PATIENCE=5
# TODO
