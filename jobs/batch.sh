#!/usr/bin/env bash
# To be sourced by the job scripts, with source_dir set: finds the programs, and runs one scene such that a request to
# stop closes its file and saves it.
: "${source_dir:?}"
# shellcheck source=jobs/mpi_environment.sh
. "$source_dir/jobs/mpi_environment.sh"
# shellcheck source=jobs/scheduler.sh
. "$source_dir/jobs/scheduler.sh"
if [[ -n $scheduler ]]; then
  unset OMPI_MCA_rmaps_base_oversubscribe  # in an allocation, more ranks than cores are a mistake
fi

# fail MESSAGE: bad usage.
fail() {
  echo "${SLURM_JOB_NAME:-${PBS_JOBNAME:-${LSB_JOBNAME:-$(basename "$0")}}}: $1" >&2
  exit 2
}

# Puts pbmpi and pbreport first on PATH: from PBMPI_BIN, or from this checkout's release build, or as PATH has them.
find_programs() {
  local built=$source_dir/build/release/bin program
  if [[ -n ${PBMPI_BIN:-} ]]; then
    PATH=$PBMPI_BIN:$PATH
  elif [[ -x $built/pbmpi ]]; then
    PATH=$built:$PATH
  fi
  for program in mpirun pbmpi pbstudy pbreport; do
    command -v "$program" >/dev/null ||
      fail "no $program found; build it with $source_dir/jobs/build.sh, or name its folder in PBMPI_BIN"
  done
}

# name_of_scene NAME|FILE: the scene's name.
name_of_scene() { basename "$1" | sed -E 's/\.(toml|xml|mjcf|urdf)$//'; }

# number_of_parts NAME: how many of NAME.h5, NAME.2.h5, NAME.3.h5 ... are there.
number_of_parts() {
  local count=0 file=$1.h5
  while [[ -e $file ]]; do
    count=$((count + 1))
    file=$1.$((count + 1)).h5
  done
  echo "$count"
}

# values_of OPTION OPTIONS...: what follows OPTION, or stands behind its equals sign (or, of -o, right behind it).
values_of() {
  local option=$1
  shift
  while [[ $# -gt 0 ]]; do
    case $1 in
      "$option") echo "${2:-}" ;;
      "$option"=*) echo "${1#"$option"=}" ;;
      -o?*) [[ $option != -o ]] || echo "${1#-o}" ;;
    esac
    shift
  done
}

# without OPTION OPTIONS...: the others, each ended by a NUL.
without() {
  local option=$1
  shift
  while [[ $# -gt 0 ]]; do
    case $1 in
      "$option") [[ $# -eq 1 ]] || shift ;;
      "$option"=*) ;;
      -o?*) [[ $option == -o ]] || printf '%s\0' "$1" ;;
      *) printf '%s\0' "$1" ;;
    esac
    shift
  done
}

# output_among OPTIONS...: what pbmpi's options say of the output: its file, "none", or nothing if they leave it open.
output_among() {
  local option
  for option in "$@"; do
    [[ $option != --no-output ]] || echo none
  done
  values_of --output "$@"
  values_of -o "$@"
}

# time_limit OPTIONS...: what to add to them, a word a line, so that the run ends by itself where the scheduler gives no notice.
time_limit() {
  local seconds
  [[ -z $(values_of --max-time "$@") ]] || return 0
  seconds=$(seconds_to_use)
  [[ -z $seconds ]] || printf '%s\n' --max-time "$seconds"
}

# run_until_stopped COMMAND...: its exit code. TERM, INT or USR2 to this shell become USR2 to mpirun, which passes it to
# every rank: pbmpi ends the frame, saves the run, closes its file and exits with 75. USR1 saves the run, which goes on.
# TERM must not reach mpirun: it would kill its ranks a second later, and exit with 1. On a terminal, job control gives
# mpirun a process group of its own, so that Ctrl-C comes here only.
run_until_stopped() {
  local child code stopped=
  [[ ! -t 2 ]] || set -m
  "$@" </dev/null &
  child=$!
  set +m
  trap 'stopped=yes; kill -USR2 "$child" 2>/dev/null || true' TERM INT USR2
  trap 'stopped=yes; kill -USR1 "$child" 2>/dev/null || true' USR1
  while :; do
    stopped=
    code=0
    wait "$child" || code=$?
    [[ -n $stopped ]] || break  # a trap interrupts wait, which then knows no exit code yet
  done
  trap - TERM INT USR2 USR1
  return "$code"
}

# run_scene OUTPUT SCENE OPTIONS...: simulates, then writes the report page beside the file. OUTPUT is the name of the
# file unless the options settle it. Returns pbmpi's exit code, or pbreport's if only that failed.
run_scene() {
  local output=$1 scene=$2 code=0 given limit mpi_options=()
  shift 2
  given=$(output_among "$@")
  if [[ -z $given ]]; then
    set -- --output "$output" "$@"
  else
    output=$given
  fi
  readarray -t limit < <(time_limit "$@")
  read -r -a mpi_options <<<"${PBMPI_MPIRUN_OPTIONS:-}"
  run_until_stopped mpirun "${host_options[@]}" "${mpi_options[@]}" "$(command -v pbmpi)" --scene "$scene" "$@" "${limit[@]}" || code=$?
  if [[ $output != none && ($code -eq 0 || $code -eq 75) ]]; then
    pbreport "$output" --html "${output%.h5}.html" --quiet || code=$((code == 0 ? $? : code))
  fi
  return "$code"
}
