#!/usr/bin/env bash
# Builds pbmpi with a preset of CMakePresets.json, for all processors: `jobs/build.sh [PRESET [cmake options ...] [-- build
# options ...]]`, default release.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}
shift || true
options=(-DPBMPI_SIMD=all)
while [[ $# -gt 0 && $1 != -- ]]; do
  options+=("$1")
  shift
done
shift || true
cmake --preset "$preset" "${options[@]}"
cmake --build --preset "$preset" "$@"
