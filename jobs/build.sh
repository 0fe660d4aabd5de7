#!/usr/bin/env bash
# Builds pbmpi with a preset of CMakePresets.json: `jobs/build.sh [PRESET [cmake options ...]]`, default release.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}
shift || true
cmake --preset "$preset" "$@"
cmake --build --preset "$preset"
