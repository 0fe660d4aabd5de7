#!/usr/bin/env bash
# Contact problems of recorded steps of the reference in the form of FCLIB, solved again by Siconos: who has which residual.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/siconos.sh [--quick-look] [--keep-runs] [OUTDIR]

Writes OUTDIR/siconos.md, .csv and .json (default: ./siconos), and in OUTDIR/problems a file of FCLIB for each problem of the
reference. Needs python3-siconos and python3-h5py. Up to half an hour on one core.

  --quick-look   three scenes and four hard cases: a minute
  --keep-runs    go on with the runs that OUTDIR/runs has, e.g. after a change of the scripts alone
  PBMPI_REFERENCE_TIME    [s] a run of the reference may take, default 30; of a hard case a twelfth of it
TEXT
}

scenes=(2-Cars 10-Cars CrashSk CrashWa Environ 100CrSk Battle Fight Battle2)
sweeps=200  # of the reference, before Newton's method
time=${PBMPI_REFERENCE_TIME:-30}
steps=40
# The nine scenes at rest, and what consists of islands with more contacts than are exported here.
left_out=" 10-Cars 100CrSk 2-Cars Battle Battle2 Battle2_humans CrashSk CrashWa Environ Fight pyramid100 pyramid30_small kapla_tower wall400 cubes125 "
cases=()
keep=no
out=siconos
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --quick-look)
      scenes=(2-Cars CrashSk Fight) time=12 steps=20
      cases=(hard/rest/column10 hard/contact/ramp_mu05_24 hard/joints/bridge30 hard/free/bounce_half)
      shift ;;
    --keep-runs) keep=yes; shift ;;
    -*) echo "siconos.sh: unknown option '$1'; see --help" >&2; exit 2 ;;
    *) out=$1; shift ;;
  esac
done

jobs=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=jobs/mpi_environment.sh
. "$jobs/mpi_environment.sh"
bin=${PBMPI_BIN:-$jobs/../build/release/bin}
[[ -x $bin/pbmpi ]] || { echo "siconos.sh: $bin/pbmpi is missing; build it with jobs/build.sh release" >&2; exit 2; }
python=${PYTHON:-python3}
"$python" -c "import siconos.numerics, h5py" || {
  echo "siconos.sh: python3-siconos or python3-h5py is missing; apt-get install them" >&2; exit 2; }

if [[ ${#cases[@]} == 0 ]]; then
  mapfile -t cases < <("$bin/pbmpi" --list-scenes | awk '/^  hard\// { print $1 }')
fi

# What all three have: a frame is a step, so that a step stands between two states of the file.
common=(--steps-per-frame 1 --warmup 0 --record contacts --quiet --progress never)
# Rigid rows with the scene's ERP and CFM, cones of friction, one solve a step: the problem that docs/research/siconos.md writes down.
reference=(--law coulomb --iterations "$sweeps")

# record SCENE SECONDS option...
record() {
  local file=$out/runs/reference/${1//\//.}.h5 scene=$1 seconds=$2 status=0
  shift 2
  [[ ! -e $file ]] || return 0
  # A step that never ends is killed; its file is as good as that of a run that stopped.
  timeout -s KILL $((2 * seconds + 4)) "$bin/pbmpi" --scene "$scene" "${common[@]}" --frames "$steps" --max-time "$seconds" \
    --output "$file" "$@" || status=$?
  rm -f "${file%.h5}.checkpoint.h5" "$(dirname "$file")"/.*.lock
  # 75: the time was up; 1: a number is not finite. What was written is there.
  [[ $status == 0 || $status == 75 || $status == 1 || $status == 137 ]] || { echo "siconos.sh: $scene ended with $status" >&2; exit 1; }
}

[[ $keep == yes ]] || rm -rf "$out/runs"
rm -rf "$out/problems"
mkdir -p "$out/runs/reference" "$out/problems"
for scene in "${scenes[@]}" "${cases[@]}"; do
  seconds=$time
  [[ $scene != hard/rest/* || $left_out != *" ${scene##*/} "* ]] || continue
  [[ $scene != hard/* ]] || seconds=$((time / 12))
  more=()
  [[ $scene != 100CrSk ]] || more=(--replicas 16)
  record "$scene" "$seconds" "${reference[@]}" ${more[@]+"${more[@]}"}
done

"$python" "$jobs/siconos/fclib_export.py" --most-contacts 100 --each 60 --each-hard 20 --output "$out/problems/reference" \
  "$out/runs/reference"/*.h5
"$python" "$jobs/siconos/solve.py" --output "$out/siconos" "$out/problems/reference"
echo "$out/siconos.md"
