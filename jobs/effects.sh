#!/usr/bin/env bash
# What each effect costs in the nine scenes, and what leaving it out does: pbstudy effects and its page.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/effects.sh [--quick-look] [OUTDIR [pbstudy options]]

Writes OUTDIR/effects.h5, .html, .txt and .md (default: ./effects), and prints the last two: .md has the table of
docs/effects.md, one for each stepper. RANKS ranks (2); times need a core for each rank, and nothing else on the
machine. Takes minutes.

  --quick-look     2-Cars and CrashSk only
TEXT
}

scenes=(all)
out=effects
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --quick-look) scenes=(2-Cars CrashSk); shift ;;
    -*) echo "effects.sh: unknown option '$1'; see --help" >&2; exit 2 ;;
    *) out=$1; shift; break ;;
  esac
done

jobs=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$jobs/mpi_environment.sh"
bin=${PBMPI_BIN:-$jobs/../build/release/bin}
[[ -x $bin/pbstudy ]] || { echo "effects.sh: $bin/pbstudy is missing; build it with jobs/build.sh release" >&2; exit 2; }
mkdir -p "$out"
study=(--scene "${scenes[@]}" --progress never --quiet "$@")

mpirun -n "${RANKS:-2}" "$bin/pbstudy" effects "${study[@]}" --output "$out/effects.h5"
"$bin/pbreport" "$out/effects.h5" --html "$out/effects.html" | tee "$out/effects.txt"
echo
"$bin/pbreport" "$out/effects.h5" --markdown | tee "$out/effects.md"
