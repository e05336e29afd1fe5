#!/bin/sh
# Static analysis of src/ and render/ by clang-tidy and cppcheck; nothing found is exit code 0.
#     tests/static_analysis.sh [cppcheck|clang-tidy] [REGEX]      both if neither is named; only files whose path REGEX matches
# Which checks run is said in .clang-tidy, with the reasons for those that do not. Build in build/analysis: nothing is compiled there.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
. "$root/tests/setup.sh"
cd "$root"
tool=all
case "${1-}" in cppcheck | clang-tidy) tool=$1; shift ;; esac
files=${1-.}

run_cppcheck() {
    install_packages cppcheck
    # Headers of libraries are left out: the code is judged, not they, and Eigen's alone would take hours.
    find src render -name '*.cpp' | LC_ALL=C sort | grep -E "$files" |
        cppcheck --file-list=- --std=c++20 --language=c++ -I src -I render --enable=warning,performance,portability --inline-suppr \
            --quiet --error-exitcode=1 -j "$(nproc)" --template='{file}:{line}: {severity}: {message} [{id}]'
}

run_clang_tidy() {
    install_packages $build_packages clang-14 clang-tidy-14
    # Most of the time goes into the headers of libraries: judged together, sources cost a quarter. Named ones are judged one by one.
    joined=ON sources="/build/analysis/.*/Unity/|^$root/(src|render)/"
    if [ "$files" != . ]; then joined=OFF sources="^$root/(src|render)/.*($files)"; fi
    cmake -S . -B build/analysis -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++-14 -DMESHFOLIO_TESTS=OFF \
        -DMESHFOLIO_VIEWER=OFF -DMESHFOLIO_PYTHON=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DMESHFOLIO_JOIN_SOURCES=$joined >/dev/null
    # What it prints besides findings (its commands, how many warnings the headers of libraries have) stays in the files.
    run-clang-tidy-14 -quiet -p build/analysis -j "$(nproc)" -checks=-bugprone-suspicious-include "$sources" \
        >build/analysis/findings.txt 2>build/analysis/counts.txt && return 0
    grep -vE '^(clang-tidy-14|/usr/bin/clang-tidy|Enabled checks)' build/analysis/findings.txt
    return 1
}

status=0
if [ "$tool" != clang-tidy ]; then run_cppcheck || status=1; fi
if [ "$tool" != cppcheck ]; then run_clang_tidy || status=1; fi
exit $status
