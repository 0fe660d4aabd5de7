#!/usr/bin/env bash
# The main job on a fresh Debian 12, packages included: installs, builds, runs 100CrSk on 2 ranks and writes the report
# page. Leaves 100CrSk.h5, 100CrSk.xdmf (for ParaView) and 100CrSk.html (for a browser) in the current folder.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$source_dir/jobs/install_packages.sh"
"$source_dir/jobs/build.sh" release -DPBMPI_BUILD_TESTS=OFF -DPBMPI_BUILD_BENCHMARKS=OFF
. "$source_dir/jobs/mpi_environment.sh"
PATH=$source_dir/build/release/bin:$PATH
mpirun -n 2 pbmpi --scene 100CrSk
pbreport 100CrSk.h5 --html 100CrSk.html --xdmf 100CrSk.xdmf --quiet
ls -l 100CrSk.h5 100CrSk.xdmf 100CrSk.html
