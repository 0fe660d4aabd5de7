#!/bin/bash
# Counts instructions with callgrind: the paper's Figure 3 (instructions a frame, quick and direct) and its mix of section 3.3.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/figure3.sh [--quick-look] [--long] [--runs DIR] [OUTDIR [SCENE ...]]

Writes OUTDIR/figure3.html and OUTDIR/figure3.json (default: ./figure3). Needs valgrind, objdump and
python3-h5py. Up to 10 minutes for all nine scenes.

  --quick-look   2-Cars and CrashSk only
  --long         direct of 100CrSk, Battle and CrashWa, too, however long it takes: hours
  --runs DIR     has the runs of quick with --record islands (SCENE.h5); else they are recorded into OUTDIR

The 3 warm-up and 5 measured frames of each scene run under callgrind, which counts inside the stepper only. Where
direct is not counted it is extrapolated from the rows of the islands.
TEXT
}

quick=(Environ 100CrSk Battle2 Battle CrashWa Fight 10-Cars CrashSk 2-Cars)
# The big matrix of CrashWa takes a minute without callgrind, of Battle2 nine, of Environ ten a frame, and some
# fifty times that with it. 100CrSk (3 s) and Battle (2 s) would fit into limit_s on an idle machine at best.
long=(CrashWa 100CrSk Battle)
direct=(Fight 10-Cars CrashSk 2-Cars)
limit_s=200
runs=""
out=figure3
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --quick-look) quick=(2-Cars CrashSk) direct=(2-Cars); shift ;;
    --long) direct=("${long[@]}" "${direct[@]}") limit_s=86400; shift ;;
    --runs) [[ $# -ge 2 ]] || { usage >&2; exit 2; }; runs=$2; shift 2 ;;
    -*) echo "figure3.sh: unknown option '$1'; see --help" >&2; exit 2 ;;
    *) out=$1; shift; break ;;
  esac
done

if [[ $# -gt 0 ]]; then
  quick=("$@")
  # Those of the scenes that direct is counted in.
  mapfile -t direct < <(printf '%s\n' "${direct[@]}" | grep -Fx -f <(printf '%s\n' "$@") || true)
fi

jobs=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$jobs/mpi_environment.sh"
bin=${PBMPI_BIN:-$jobs/../build/release/bin}
for tool in valgrind objdump python3; do
  command -v "$tool" >/dev/null || { echo "figure3.sh: no $tool found; install it (jobs/install_packages.sh --tests)" >&2; exit 2; }
done
[[ -x $bin/pbmpi ]] || { echo "figure3.sh: $bin/pbmpi is missing; build it with jobs/build.sh release" >&2; exit 2; }
python3 -c 'import h5py' 2>/dev/null || { echo "figure3.sh: python3 has no h5py; install python3-h5py (jobs/install_packages.sh)" >&2; exit 2; }
mkdir -p "$out"

# One dump a frame: callgrind writes what it has counted after each call of the stepper's advance().
count() {
  local stepper=$1 scene=$2 frame='pbmpi::stepping::SlotStepper::advance(int, pbmpi::core::PhaseTimes&)'
  rm -f "$out/$scene-$stepper.callgrind"*
  if timeout "$limit_s" valgrind --quiet --tool=callgrind --callgrind-out-file="$out/$scene-$stepper.callgrind" \
    --toggle-collect="$frame" --dump-after="$frame" --dump-instr=yes --dump-line=no --compress-pos=no --compress-strings=no \
    "$bin/pbmpi" --scene "$scene" --stepper "$stepper" --no-output --quiet >"$out/$scene-$stepper.log" 2>&1; then
    echo "$scene $stepper"
  else
    echo "$scene $stepper: not done within $limit_s s" >&2
    rm -f "$out/$scene-$stepper.callgrind"*
  fi
}
export -f count
export out bin limit_s
{
  for scene in ${direct[@]+"${direct[@]}"}; do echo "direct $scene"; done
  for scene in "${quick[@]}"; do echo "quick $scene"; done
} | xargs -P "$(nproc)" -L 1 bash -c 'count "$0" "$1"'
python3 "$jobs/figure3.py" "$out" "$out/figure3.json"
rm -f "$out"/*.callgrind*
if [[ -z $runs ]]; then
  runs=$out
  for scene in "${quick[@]}"; do
    "$bin/pbmpi" --scene "$scene" --stepper quick --record islands --quiet --output "$runs/$scene.h5"
  done
fi
files=()
for scene in "${quick[@]}"; do files+=("$runs/$scene.h5"); done
PBMPI_BIN=$bin python3 "$jobs/paper/paper.py" figure3 "$out/figure3.json" "${files[@]}" --html "$out/figure3.html"
echo "$out/figure3.html"
