#!/bin/bash
# Runs the nine scenes and writes one page: the paper's Figure 6 and Tables 1 and 2 beside this machine's.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/figure6.sh [--quick-look] [--no-stills] [--gallery DIR] [OUTDIR [SCENE ...]]

Writes OUTDIR/figure6.html and the runs' files (default: ./figure6). Needs python3-h5py, and chromium for the
stills. Minutes.

  --quick-look   CrashSk and Fight only
  --no-stills    no pictures of the scenes, and no need of chromium
  --gallery DIR  put the stills into DIR as SCENE.png, too
TEXT
}

scenes=(2-Cars 10-Cars CrashSk CrashWa Environ 100CrSk Battle Fight Battle2)
# The frame that shows most of what happens, and where to look at it from: camera and target, x,y,z each [m].
declare -A frame=([2-Cars]=5 [10-Cars]=7 [CrashSk]=7 [CrashWa]=7 [Environ]=6 [100CrSk]=7 [Battle]=7 [Fight]=8 [Battle2]=7)
declare -A camera=([2-Cars]="13,-9,4,4,0,0.5" [CrashWa]="8,-9,4.5,-2,0,1" [Environ]="7,-10,5,-3,1,1" [Battle]="-6,-5,3,1,2,1"
  [Fight]="5,-7,3.5,0,0,0.6" [Battle2]="7,-12,9,0,0,0.5")
out=figure6
gallery=""
stills=yes
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --quick-look) scenes=(CrashSk Fight); shift ;;
    --no-stills) stills=no; shift ;;
    --gallery) [[ $# -ge 2 ]] || { usage >&2; exit 2; }; gallery=$2; shift 2 ;;
    -*) echo "figure6.sh: unknown option '$1'; see --help" >&2; exit 2 ;;
    *) out=$1; shift; break ;;
  esac
done
[[ $# -eq 0 ]] || scenes=("$@")

jobs=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$jobs/mpi_environment.sh"
bin=${PBMPI_BIN:-$jobs/../build/release/bin}
[[ -x $bin/pbmpi ]] || { echo "figure6.sh: $bin/pbmpi is missing; build it with jobs/build.sh release" >&2; exit 2; }
python3 -c 'import h5py' 2>/dev/null || { echo "figure6.sh: python3 has no h5py; install python3-h5py (jobs/install_packages.sh)" >&2; exit 2; }
mkdir -p "$out/stills" ${gallery:+"$gallery"}

files=()
for scene in "${scenes[@]}"; do
  echo "$scene"
  # One rank: the serial time is what Figure 6 starts from.
  "$bin/pbmpi" --scene "$scene" --stepper quick --record islands --quiet --output "$out/$scene.h5"
  files+=("$out/$scene.h5")
  [[ $stills == yes ]] || continue
  "$bin/pbreport" "$out/$scene.h5" --quiet --html "$out/$scene.html"
  view=(--size 560x280)
  [[ -z ${camera[$scene]:-} ]] || view+=(--camera "${camera[$scene]}")
  [[ $scene == 100CrSk ]] && view+=(--world 0)
  "$jobs/stills.sh" "${view[@]}" --bare "$out/$scene.html" "$out/stills" "${frame[$scene]}" >/dev/null
  mv "$out/stills/$scene-00${frame[$scene]}.png" "$out/stills/$scene.png"
  [[ -z $gallery ]] || cp "$out/stills/$scene.png" "$gallery/"
done
pictures=()
[[ $stills == no ]] || pictures=(--stills "$out/stills")
python3 "$jobs/paper/paper.py" islands "${files[@]}"
export PBMPI_BIN=$bin
python3 "$jobs/paper/paper.py" cores "${files[@]}"
python3 "$jobs/paper/paper.py" figure6 "${files[@]}" ${pictures[@]+"${pictures[@]}"} --html "$out/figure6.html"
