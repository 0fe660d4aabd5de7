#!/usr/bin/env bash
# One scene over the nodes of an allocation: the body of jobs/pbmpi.sbatch, jobs/pbs/pbmpi.pbs and jobs/lsf/pbmpi.lsf.
# Leaves SCENE-JOBID.h5, .xdmf and .html in the current folder, and a checkpoint if the time was too short. With
# PBMPI_REQUEUE=yes it then goes on by itself. See jobs/README.md.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=jobs/batch.sh
. "$source_dir/jobs/batch.sh"

[[ $# -gt 0 && $1 != -* ]] || fail "usage: SCENE [pbmpi options], e.g. 100CrSk --frames 9000"
find_programs
arguments=("$@")
name=$(name_of_scene "$1")${job_id:+-$job_id}
checkpoint=$name.checkpoint.h5
if [[ -z $job_restarts ]]; then
  job_restarts=$(number_of_parts "$name")
fi
if [[ ${PBMPI_REQUEUE:-} == yes ]]; then
  [[ -n $scheduler ]] || fail "PBMPI_REQUEUE: there is no queue without a scheduler; unset it"
  [[ -z $(values_of --output "$@")$(values_of -o "$@")$(values_of --checkpoint "$@") ]] ||
    fail "PBMPI_REQUEUE names the files itself; leave --output and --checkpoint out"
  set -- "$@" --checkpoint "$checkpoint"
fi
if [[ $job_restarts -gt 0 && -e $checkpoint ]]; then
  readarray -d '' -t options < <(without --resume "$@")
  set -- "${options[@]}" --resume "$checkpoint"
  name=$name.$((job_restarts + 1))
fi
code=0
run_scene "$name.h5" "$@" || code=$?
if [[ $code -eq 75 && ${PBMPI_REQUEUE:-} == yes && -e $checkpoint ]]; then
  echo "the time is up: back into the queue, to go on from $checkpoint"
  requeue_job "${arguments[@]}"
fi
exit "$code"
