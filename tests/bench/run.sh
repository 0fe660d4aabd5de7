#!/usr/bin/env bash
# Prints the ratios of all benchmarks, each a median over alternated runs: `tests/bench/run.sh`, after jobs/build.sh.
# Nothing else should run on the machine. The tables of the documents are made by docs/figures.py.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. jobs/mpi_environment.sh
build/release/tests/bench/bench_worlds 100CrSk 0 20 5
build/release/tests/bench/bench_worlds --effects
build/release/tests/bench/bench_worlds --substeps 100CrSk 0 8
build/release/tests/bench/bench_worlds --substeps 100CrSk 0 100
python3 tests/bench/spheres.py
python3 tests/bench/interest.py
build/release/tests/bench/bench_worlds --sleeping
for quiet in "Environ 5" "Battle2 5" "Battle2 30" "Warehouse 5" "100CrSk 0"; do
  # shellcheck disable=SC2086
  build/release/tests/bench/bench_worlds --quiet $quiet
done
build/release/tests/bench/bench_worlds --guards
build/release/tests/bench/batch/bench_batch 4096 24 3
python3 tests/bench/batch/batch_python.py
python3 tests/bench/ranks.py 100CrSk 7 --stepper quick
python3 tests/bench/ranks.py 100CrSk 7
python3 tests/bench/decompose.py 7
python3 tests/bench/engines/engines.py --markdown
