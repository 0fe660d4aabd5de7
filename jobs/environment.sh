# shellcheck shell=bash
# To be sourced, from bash or zsh: the programs and the Python module of build/release on their paths, manual pages, and Open MPI
# told that it may start as root, and more ranks than there are cores.
pbmpi_source=$(cd "$(dirname "${BASH_SOURCE[0]:-$0}")/.." && pwd)
export PATH=$pbmpi_source/build/release/bin:$PATH
export PYTHONPATH=$pbmpi_source/build/release/python${PYTHONPATH:+:$PYTHONPATH}
export MANPATH=$pbmpi_source/build/release/manual:${MANPATH:-}
. "$pbmpi_source/jobs/mpi_environment.sh"
unset pbmpi_source
