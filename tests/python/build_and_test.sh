#!/bin/sh
# The Python module, built beside the program, and its tests: against NumPy and SciPy, and the example notebook.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
. "$root/tests/setup.sh"
install_packages $build_packages $python_packages python3-matplotlib python3-nbclient python3-ipykernel
cmake -S "$root" -B "$root/build/module" -G Ninja -DMESHFOLIO_PYTHON=ON -DPython_EXECUTABLE=/usr/bin/python3 -DMESHFOLIO_TESTS=OFF -DMESHFOLIO_JOIN_SOURCES=ON
cmake --build "$root/build/module" --target meshfolio_python
for test in module notebook; do PYTHONPATH="$root/build/module/python" /usr/bin/python3 "$root/tests/python/test_$test.py"; done
