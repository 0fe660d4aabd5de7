#!/usr/bin/env bash
# A study over the nodes of an allocation: the body of jobs/study.sbatch, jobs/pbs/study.pbs and jobs/lsf/study.lsf. Leaves
# STUDY-JOBID.h5 and .html in the current folder. When the time is up, no further case is begun: those that are done are kept,
# and the same job goes on with the others: with PBMPI_REQUEUE=yes by itself. See jobs/README.md.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=jobs/batch.sh
. "$source_dir/jobs/batch.sh"

[[ $# -gt 0 && $1 != -* ]] || fail "usage: STUDY [pbstudy options], e.g. accuracy --scene CrashWa"
find_programs
arguments=("$@")
study=$1
shift
output=$(output_among "$@" | tail -n 1)
output=${output:-$study${job_id:+-$job_id}.h5}
readarray -d '' -t options < <(without --output "$@")
readarray -d '' -t options < <(without -o "${options[@]}")
readarray -t limit < <(time_limit "$@")
read -r -a mpi_options <<<"${PBMPI_MPIRUN_OPTIONS:-}"
code=0
run_until_stopped mpirun "${host_options[@]}" "${mpi_options[@]}" "$(command -v pbstudy)" "$study" "${options[@]}" "${limit[@]}" \
  --output "$output" --resume || code=$?
report=(pbreport)
[[ $study != prediction ]] || report=(python3 "$source_dir/jobs/paper/paper.py" prediction)  # of a checkout, with python3-h5py
if [[ $code -eq 0 ]]; then
  "${report[@]}" "$output" --html "${output%.h5}.html" --quiet >/dev/null || code=$?
elif [[ $code -eq 75 && ${PBMPI_REQUEUE:-} == yes ]]; then
  echo "the time is up: back into the queue, to go on with the cases that are left"
  requeue_job "${arguments[@]}"
fi
exit "$code"
