# shellcheck shell=bash
# To be sourced. Open MPI refuses to start as root, and to start more ranks than cores, unless told so. In the second
# case it makes waiting ranks yield by itself.
if [[ $EUID -eq 0 ]]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
export OMPI_MCA_rmaps_base_oversubscribe=1
