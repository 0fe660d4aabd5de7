#!/usr/bin/env bash
# The main job on a fresh Debian 12, packages included: installs, builds, runs 100CrSk on 2 ranks and writes the report
# page. Leaves 100CrSk.h5, 100CrSk.xdmf (for ParaView) and 100CrSk.html (for a browser) in the current folder.
# Compiled is what this takes: pbmpi and pbreport, for this machine's processor. jobs/build.sh compiles the rest.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$source_dir/jobs/install_packages.sh"
"$source_dir/jobs/build.sh" release -DPBMPI_BUILD_TESTS=OFF -DPBMPI_BUILD_BENCHMARKS=OFF -DPBMPI_SIMD=native -- \
  --target pbmpi pbreport
. "$source_dir/jobs/environment.sh"
mpirun -n 2 pbmpi --scene 100CrSk
pbreport 100CrSk.h5 --html 100CrSk.html --xdmf 100CrSk.xdmf --quiet
ls -l 100CrSk.h5 100CrSk.xdmf 100CrSk.html
cat <<TEXT

Done. The programs are found, and mpirun starts them, after

    . $source_dir/jobs/environment.sh

(Without it mpirun refuses to start as root, and finds "not enough slots" for more ranks than cores.) Next:

    xdg-open 100CrSk.html                  # the page in a browser: times against the budget, and a replay
    mpirun -n 2 pbmpi --scene Battle2      # another scene; pbmpi --list-scenes has all
    $source_dir/jobs/build.sh              # the rest: pbstudy, the library, the Python module; minutes
TEXT
