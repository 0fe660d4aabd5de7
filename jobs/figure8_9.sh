#!/usr/bin/env bash
# Figures 8 and 9 of the paper: `jobs/figure8_9.sh [OUTDIR [scene ...]]`, default ./figure8_9 and all nine scenes.
# Records each scene on RANKS ranks (2) by quick with 20, 19 and 1 iterations and with FEEC (the paper's estimate of one
# iteration, and one of 5 by sor with ODE's law in single precision), REPEATS times each (5; the time of a frame is the least of them), and
# with SEEDS other solver seeds (8; the noise floor). Writes OUTDIR/figure8_9.html and .txt. Needs python3-h5py. Takes minutes
# on 2 cores.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
. "$source_dir/jobs/mpi_environment.sh"
export PBMPI_BIN=${PBMPI_BIN:-$source_dir/build/release/bin}
PATH=$PBMPI_BIN:$PATH
out=${1:-figure8_9}
shift || true
scenes=("$@")
if [[ ${#scenes[@]} -eq 0 ]]; then
  mapfile -t scenes < <(pbmpi --list-scenes | awk '/:$/ { exit } { print $1 }')
fi
python3 -c 'import h5py' 2>/dev/null || { echo "figure8_9.sh: python3 has no h5py; install python3-h5py (jobs/install_packages.sh)" >&2; exit 2; }
mkdir -p "$out"

files=()
# record NAME option...: one run, into $out/NAME.h5
record() {
  local file=$out/$1.h5
  shift
  mpirun -n "${RANKS:-2}" pbmpi --quiet --progress never --output "$file" "$@"
  files+=("$file")
}

for scene in "${scenes[@]}"; do
  echo "$scene" >&2
  name=$(basename "$scene" .toml)
  setting=(--scene "$scene" --stepper quick)
  for ((repeat = 1; repeat <= ${REPEATS:-5}; ++repeat)); do
    record "$name.iter20.$repeat" "${setting[@]}"
    record "$name.iter19.$repeat" "${setting[@]}" --iterations 19
    record "$name.iter1.$repeat" "${setting[@]}" --iterations 1
    record "$name.feec.$repeat" "${setting[@]}" --feec
    record "$name.feec_sor.$repeat" "${setting[@]}" "--feec=sor iterations=5 precision=single"
  done
  for ((seed = 2; seed <= ${SEEDS:-8} + 1; ++seed)); do
    record "$name.seed$seed" "${setting[@]}" --solver-seed "$seed"
  done
done
python3 "$source_dir/jobs/paper/paper.py" figures "${files[@]}" --html "$out/figure8_9.html" | tee "$out/figure8_9.txt"
