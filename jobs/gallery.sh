#!/usr/bin/env bash
# Pictures of the scenes of effects (scenes/effects): `jobs/gallery.sh [DIR [SCENE...]]`, default ./gallery and all of them. Runs
# each scene and writes DIR/SCENE.png. Needs chromium. The nine scenes have theirs from `jobs/figure6.sh --gallery DIR`.
set -euo pipefail
jobs=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$jobs/mpi_environment.sh"
bin=${PBMPI_BIN:-$jobs/../build/release/bin}
[[ -x $bin/pbmpi ]] || { echo "gallery.sh: $bin/pbmpi is missing; build it with jobs/build.sh release" >&2; exit 2; }

# The frame that shows most of what happens, and where to look at it from: camera and target, x,y,z each [m].
declare -A frame=([Bowling]=76 [Feathers]=18 [Stadium]=8 [Warehouse]=41)
declare -A camera=([Bowling]="17.2,-0.35,0.9,18.9,0.05,0.05" [Feathers]="0.2,-3.3,4.15,0.2,0,4.05" [Stadium]="-10,-9,5,-3,1,1"
  [Warehouse]="10.2,1,3,4.6,-0.1,0.6")

out=${1:-gallery}
shift || true
scenes=("$@")
[[ ${#scenes[@]} -gt 0 ]] || scenes=(Bowling Feathers Stadium Warehouse)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$out"
for scene in "${scenes[@]}"; do
  [[ -n ${frame[$scene]:-} ]] || { echo "gallery.sh: '$scene' is no scene of effects; they are ${!frame[*]}" >&2; exit 2; }
  "$bin/pbmpi" --scene "$scene" --quiet --output "$folder/$scene.h5"
  "$bin/pbreport" "$folder/$scene.h5" --quiet --html "$folder/$scene.html"
  still=$("$jobs/stills.sh" --size 560x280 --camera "${camera[$scene]}" --bare "$folder/$scene.html" "$folder" "${frame[$scene]}")
  mv "$still" "$out/$scene.png"
  echo "$out/$scene.png"
done
