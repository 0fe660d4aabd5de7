#!/usr/bin/env bash
# What each effect costs in the nine scenes, and what leaving it out does: pbstudy effects and its page.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/effects.sh [--quick-look] [--instructions] [OUTDIR [pbstudy options]]

Writes OUTDIR/effects.h5, .html, .txt and .md (default: ./effects), and prints the last two: .md has the table of
docs/effects.md, one for each stepper. RANKS ranks (2); times need a core for each rank, and nothing else on the
machine. Takes minutes.

  --quick-look     2-Cars and CrashSk only
  --instructions   count instructions, too: the same cases first under callgrind (valgrind), with --repeats 2;
                   up to an hour for all nine
TEXT
}

scenes=(all)
count=no
out=effects
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --quick-look) scenes=(2-Cars CrashSk); shift ;;
    --instructions) count=yes; shift ;;
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

counted=()
if [[ $count == yes ]]; then
  command -v valgrind >/dev/null || { echo "effects.sh: no valgrind found; install it (jobs/install_packages.sh --tests)" >&2; exit 2; }
  export PBMPI_CALLGRIND_OUT=$out/callgrind.%p
  mpirun -n "${RANKS:-2}" valgrind --quiet --tool=callgrind --dump-line=no --callgrind-out-file="$PBMPI_CALLGRIND_OUT" \
    "$bin/pbstudy" effects "${study[@]}" --repeats 2 --output "$out/counted.h5" 2>"$out/callgrind.log" \
    || { cat "$out/callgrind.log" >&2; exit 1; }
  rm -f "$out"/callgrind.*
  counted=(--instructions-from "$out/counted.h5")
fi
mpirun -n "${RANKS:-2}" "$bin/pbstudy" effects "${study[@]}" --output "$out/effects.h5"
"$bin/pbreport" "$out/effects.h5" "${counted[@]}" --html "$out/effects.html" | tee "$out/effects.txt"
echo
"$bin/pbreport" "$out/effects.h5" "${counted[@]}" --markdown | tee "$out/effects.md"
