#!/bin/sh
# All unit tests and a quick report under sanitizers; anything one of them reports is a failure.
#     tests/sanitizers/check.sh sanitize|thread [arguments of ctest…]
# sanitize: AddressSanitizer with leaks and vectors' spare capacity, UndefinedBehaviorSanitizer.
# thread:   ThreadSanitizer, over the layers that work in parallel; the scheduler it sees is tests/sanitizers/scheduler.
# The program stays in build/sanitize or build/thread, to be tried on more: it ends at the first finding, with exit code 1 or 66.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
. "$root/tests/setup.sh"
preset=${1:?sanitize or thread}
shift
install_packages $build_packages $test_packages clang-14 libclang-rt-14-dev llvm-14
cd "$root"

# The sanitizers' memory map does not fit the addresses that newer kernels choose; without randomness it does (google/sanitizers issue 1716).
if [ "$(cat /proc/sys/vm/mmap_rnd_bits 2>/dev/null || echo 28)" -gt 28 ] && [ -z "${MESHFOLIO_FIXED_ADDRESSES-}" ]; then
    export MESHFOLIO_FIXED_ADDRESSES=1
    exec setarch -R "$0" "$preset" "$@"
fi

cmake --preset "$preset"
cmake --build --preset "$preset"
# The tests that run the built program as a user does limit time and memory, which sanitizers need: a quick report takes their place here.
ctest --preset "$preset" --parallel "$(nproc)" --label-exclude slow --exclude-regex '^(end_to_end|browser|faults|hostile)_' "$@"
UBSAN_OPTIONS=print_stacktrace=1 "build/$preset/meshfolio" report --quick --no-cache --pdf off --threads 2 --out "build/$preset/report"
