#!/usr/bin/env bash
# The gates that a change passes beside the tests, packages included: `tests/gates.sh` runs all, `tests/gates.sh NAME...` some of
#   format    clang-format leaves every source as it is
#   python    autopep8 leaves every source in Python as it is, and flake8 finds nothing in it (.flake8)
#   js        ESLint finds nothing in the scripts of pages, their layout included (tests/gates/eslint.json)
#   avx       no AVX instruction outside the packs that are compiled for it (needs the build of tests/run.sh)
#   headers   every source of the programs compiles alone, without headers parsed ahead: it includes what it needs, and clang++
#             warns of nothing in it
#   tidy      clang-tidy finds nothing in the sources of the programs
#   arm64     the scenes have their golden hashes with another compiler on another CPU: a cross build by clang++, run by QEMU
#   sanitize  unit tests and the programs, built with the sanitizers of addresses and of undefined behaviour
#   threads   worlds that threads step, watched for races by Valgrind (needs the build of tests/run.sh)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

format() {
  git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror
}

python() {
  git ls-files -z '*.py' | xargs -0 autopep8 --diff --exit-code
  git ls-files -z '*.py' | xargs -0 flake8
}

# Only Debian's own Node.js looks for Debian's modules by itself.
js() {
  git ls-files -z '*.js' | NODE_PATH=/usr/share/nodejs xargs -0 eslint --no-eslintrc --config tests/gates/eslint.json --format unix
}

avx() {
  python3 tests/gates/avx_code.py build/release/bin/pbmpi build/release/bin/pbstudy
}

# Each source on its own, as the compiler reads it.
sources_alone() {
  cmake --preset alone -DPBMPI_BUILD_TESTS=OFF -DPBMPI_BUILD_BENCHMARKS=OFF >/dev/null
}

headers() {
  sources_alone
  python3 tests/gates/compile_alone.py build/alone
}

tidy() {
  sources_alone
  python3 tests/gates/joined_sources.py build/alone |
    xargs -P "$(nproc)" -n 1 clang-tidy -p build/alone/joined --quiet 2> >(grep -v -E '^[0-9]+ warnings? generated\.$' >&2)
}

# Debian's packages for arm64 are unpacked to build/arm64-sysroot, 0.7 GB; nothing is installed.
arm64() {
  tests/gates/arm64_sysroot.sh build/arm64-sysroot
  cmake --preset arm64
  cmake --build --preset arm64 --target pbmpi
  . jobs/mpi_environment.sh
  PBMPI_BIN=$PWD/build/arm64/bin PBMPI_EMULATOR="qemu-aarch64-static -L $PWD/build/arm64-sysroot" \
    python3 tests/app/golden/test_golden.py
}

# Unit tests (one program a folder, no ranks), then every scene in some settings, and each program on one. Packs are of one source
# and take clang++ with sanitizers minutes each: the widest of this machine stands for all.
sanitize() {
  local tests=(core model geometry effects stepping analysis estimate scenes app pbstudy pbreport io_table_file
    io_rows partition rebalance rebalancer space_plan)
  cmake --preset asan-ubsan -DPBMPI_BUILD_TESTS=ON -DPBMPI_BUILD_BENCHMARKS=OFF -DPBMPI_SIMD=native
  cmake --build --preset asan-ubsan --target pbmpi pbstudy pbreport "${tests[@]/%/_test}"
  . jobs/mpi_environment.sh
  # Open MPI and libfabric keep what they have allocated until the process ends.
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
  ctest --preset asan-ubsan --parallel "$(nproc)" -R "^($(IFS='|'; echo "${tests[*]}"))_test[.]"
  local bin=$PWD/build/asan-ubsan/bin folder
  PBMPI_BIN=$bin python3 tests/app/golden/test_many_hashes.py --ranks 2
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' RETURN
  (
    cd "$folder"
    for stepper in quick sor; do
      mpirun -n 2 --oversubscribe "$bin/pbmpi" --scene CrashSk --stepper "$stepper" --frames 2 --warmup 1 --output "$stepper.h5" --quiet
    done
    mpirun -n 2 --oversubscribe "$bin/pbmpi" --scene Fight --decompose spaces --precision single --substeps 2 --iterations 4 \
      --frames 2 --warmup 1 --output spaces.h5 --quiet
    "$bin/pbreport" sor.h5 --html sor.html --xdmf sor.xdmf --quiet
    "$bin/pbreport" diff quick.h5 sor.h5 >/dev/null
    mpirun -n 2 --oversubscribe "$bin/pbstudy" effects --scene CrashSk --frames 1 --output effects.h5 --quiet
    "$bin/pbreport" effects.h5 >/dev/null
  )
}

# With ODE's colliders, so that its code is watched, too.
threads() {
  valgrind --tool=helgrind --quiet --error-exitcode=1 build/release/tests/solver/worlds/solver_worlds_test \
    --gtest_filter='*of_any_number_give_the_same_bits/ode_colliders'
}

gates=("$@")
[[ ${#gates[@]} -gt 0 ]] || gates=(format python js avx headers arm64 tidy sanitize threads)
jobs/install_packages.sh --gates
for gate in "${gates[@]}"; do
  case $gate in
    format | python | js | avx | headers | arm64 | tidy | sanitize | threads) ;;
    *) echo "$0: there is no gate '$gate'; see its head" >&2; exit 2 ;;
  esac
  echo "gate $gate: begins at $(date +%T)"
  "$gate"
  echo "gate $gate: passed at $(date +%T)"
done
