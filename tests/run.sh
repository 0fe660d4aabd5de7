#!/usr/bin/env bash
# Passes the tests on a fresh Debian 12, packages included: installs, builds, runs ctest. Options go to ctest, e.g.
# `tests/run.sh -R partition`. `-LE slow` is the default; `tests/run.sh -L slow` runs the long matrices.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs/install_packages.sh --tests
jobs/build.sh release -DPBMPI_BUILD_TESTS=ON -DPBMPI_BUILD_BENCHMARKS=ON
if [[ $# -eq 0 ]]; then
  set -- -LE slow
fi
# Many tests wait more than they compute, for mpirun, Chromium and Slurm.
ctest --preset release --parallel "$(($(nproc) + 2))" "$@" && exit
code=$?
# What a failed test said stands among the output of thousands: once more, at the end.
awk '/^[0-9]+\/[0-9]+ Test: / { text = "" } { text = text $0 "\n" } /^Test Failed\./ { printf "%s", text }' \
  build/release/Testing/Temporary/LastTest.log | tail -n 200
exit "$code"
