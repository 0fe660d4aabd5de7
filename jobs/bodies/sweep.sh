#!/usr/bin/env bash
# One scene at several values of one of pbmpi's options, a task of a job array for each, counted from 0 (from 1 with LSF): the
# body of jobs/sweep.sbatch, jobs/pbs/sweep.pbs and jobs/lsf/sweep.lsf. Each task leaves
# SCENE-OPTION-VALUE-JOBID_TASK.h5, .xdmf and .html. See jobs/README.md.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=jobs/batch.sh
. "$source_dir/jobs/batch.sh"

[[ $# -ge 3 && $1 != -* ]] || fail "usage: SCENE OPTION VALUE... [-- pbmpi options], e.g. CrashSk substeps 2 4 8 16"
scene=$1
option=${2#--}
shift 2
values=()
while [[ $# -gt 0 && $1 != -- ]]; do
  values+=("$1")
  shift
done
shift $(($# > 0 ? 1 : 0))
[[ ${#values[@]} -gt 0 ]] || fail "no value for --$option"
[[ -z $(output_among "$@") ]] || fail "each task names its own file; drop --output and --no-output"
find_programs

# run_value VALUE SUFFIX PBMPI-OPTIONS...: the run of one value.
run_value() {
  local value=$1 suffix=$2
  shift 2
  run_scene "$(name_of_scene "$scene")-$option-$value$suffix.h5" "$scene" "--$option" "$value" "$@"
}

if [[ -n $job_task ]]; then
  index=$((job_task - first_task))
  [[ $index -ge 0 && $index -lt ${#values[@]} ]] ||
    fail "task $job_task has no value; for these ${#values[@]} use $(array_of "${#values[@]}")"
  run_value "${values[index]}" "-${job_array}_$job_task" "$@"
else
  for value in "${values[@]}"; do  # no array: one after the other, in this job or without a scheduler
    run_value "$value" "${job_id:+-$job_id}" "$@" || exit
  done
fi
