#!/bin/sh
# Cross-compiles the library for arm64 with warnings as errors, runs its unit tests by qemu-user, and draws a mesh there and here: the same bytes.
#   tests/elsewhere/slow_arm64.sh [BUILD]   default: build/release, configured where it is not
# Needs root and the Debian 12 mirror that apt knows; ends with 77 without them. All is kept in build/arm64: apt's own architectures stay as they are.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
here=${1:-$root/build/release}
. "$root/tests/setup.sh"
mirror=$(sed -n 's/^URIs: *//p; s/^deb \(\[[^]]*\] \)*\([^ ]*\) .*/\2/p' /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | grep -m1 '/debian/*$' || true)
if [ "$(id -u)" != 0 ] || [ -z "$mirror" ]; then
    echo "skipped: needs root and a Debian mirror of apt" >&2
    exit 77
fi
install_packages $build_packages $test_packages mmdebstrap g++-12-aarch64-linux-gnu qemu-user
packages=$root/build/arm64/packages build=$root/build/arm64/build
mkdir -p "$root/build/arm64"

if [ ! -e "$packages/usr" ]; then
    names=$(for name in $build_packages $test_packages; do echo "$name"; done | grep -E '^(lib.*|nettle|nlohmann-json3)-dev$|^fonts-' | paste -sd ,)
    mmdebstrap --quiet --mode=root --variant=extract --architectures=arm64 --include="libc6-dev,$names" bookworm "$packages" "$mirror"
fi

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$root/tests/elsewhere/arm64.cmake" -DMESHFOLIO_ARM64_ROOT="$packages" \
    -DCMAKE_BUILD_TYPE=Release -DMESHFOLIO_WERROR=ON -DMESHFOLIO_VIEWER=OFF -DMESHFOLIO_JOIN_SOURCES=ON >/dev/null
tests="base_tests render_tests mesh_tests geometry_tests"
cmake --build "$build" --target six_views $tests
for test in $tests; do
    qemu-aarch64 -L "$packages" "$build/tests/$test" --gtest_brief=1
done

[ -e "$here/build.ninja" ] || cmake -S "$root" -B "$here" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMESHFOLIO_JOIN_SOURCES=ON >/dev/null
cmake --build "$here" --target six_views
mkdir -p "$build/there" "$build/here"
(cd "$build/there" && qemu-aarch64 -L "$packages" "$build/tests/six_views" "$root/data/creature.obj")
(cd "$build/here" && "$here/tests/six_views" "$root/data/creature.obj")
for picture in "$build"/here/*.png; do
    cmp "$picture" "$build/there/${picture##*/}"
done
