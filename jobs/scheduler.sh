#!/usr/bin/env bash
# shellcheck disable=SC2034  # its variables are for those that source it
# To be sourced by batch.sh: what Slurm, PBS (OpenPBS, PBS Professional) and LSF call by other names. Sets, empty where there is
# no such thing:
#   scheduler     slurm, pbs or lsf
#   job_id        a number; of a job that was submitted anew by requeue_job, that of the first
#   job_array     the number of the array, and
#   job_task      of the task in it
#   job_ranks     how many ranks the job has asked for
#   job_restarts  how often it has gone back into the queue
#   host_options  of mpirun: the hosts, where Open MPI may not know the scheduler
# requeue_job puts the job back into the queue, and fails with a message where that cannot be done.

scheduler="" job_id="" job_array="" job_task="" job_ranks="" job_restarts=0 host_options=()
if [[ -n ${SLURM_JOB_ID:-} ]]; then
  scheduler=slurm
  job_id=$SLURM_JOB_ID
  job_array=${SLURM_ARRAY_JOB_ID:-}
  job_task=${SLURM_ARRAY_TASK_ID:-}
  job_ranks=${SLURM_NTASKS:-}
  job_restarts=${SLURM_RESTART_COUNT:-0}
elif [[ -n ${PBS_JOBID:-} ]]; then
  scheduler=pbs
  job_id=${PBMPI_JOB:-${PBS_JOBID%%[^0-9]*}}
  job_task=${PBS_ARRAY_INDEX:-}
  job_array=${job_task:+$job_id}
  job_restarts=${PBMPI_RESTARTS:-0}
  if [[ -n ${PBS_NODEFILE:-} ]]; then
    job_ranks=$(wc -l <"$PBS_NODEFILE")
    host_options=(--hostfile "$PBS_NODEFILE")
  fi
elif [[ -n ${LSB_JOBID:-} ]]; then
  scheduler=lsf
  job_id=$LSB_JOBID
  [[ ${LSB_JOBINDEX:-0} == 0 ]] || job_task=$LSB_JOBINDEX
  job_array=${job_task:+$job_id}
  job_ranks=${LSB_DJOB_NUMPROC:-}
  if [[ -n ${LSB_DJOB_HOSTFILE:-} ]]; then
    host_options=(--hostfile "$LSB_DJOB_HOSTFILE")
  fi
  # LSF does not count; the parts that are there do.
  job_restarts=""
fi

# seconds_of [[[DAYS:]HOURS:]MINUTES:]SECONDS
seconds_of() {
  local part sum=0 factors=(1 60 3600 86400) parts
  IFS=: read -r -a parts <<<"$1"
  for ((part = 0; part < ${#parts[@]}; ++part)); do
    sum=$((sum + 10#${parts[part]} * factors[${#parts[@]} - 1 - part]))
  done
  echo "$sum"
}

# seconds_to_use: how long the job may still compute where the scheduler gives no notice before the time limit; nothing where it
# does.
seconds_to_use() {
  local limit left notice=${PBMPI_NOTICE:-120}
  [[ $scheduler == pbs ]] || return 0
  limit=$(qstat -f "$PBS_JOBID" 2>/dev/null | sed -n 's/^ *Resource_List.walltime = //p' | head -n 1)
  [[ -n $limit ]] || return 0
  limit=$(seconds_of "$limit")
  left=$(((limit > 2 * notice ? limit - notice : notice) - SECONDS))  # SECONDS: since the body began
  echo $((left > 1 ? left : 1))
}

# array_of COUNT: the option that asks for an array of so many tasks, as sweep.sh counts them: from 0, with LSF from 1.
first_task=0
[[ $scheduler != lsf ]] || first_task=1
array_of() {
  local range=$first_task-$((first_task + $1 - 1))
  case $scheduler in
    pbs) echo "-J $range" ;;
    lsf) echo "-J 'sweep[$range]'" ;;
    *) echo "--array=$range" ;;
  esac
}

# requeue_job ARGUMENTS...: those of the body, for a scheduler to which the job must be submitted anew.
requeue_job() {
  case $scheduler in
    slurm) scontrol requeue "$SLURM_JOB_ID" ;;
    lsf) brequeue "$LSB_JOBID${job_task:+[$job_task]}" ;;  # without its number, all tasks of an array
    pbs)
      # Only operators may requeue; anybody may submit again. What the job asked for must be said again, too.
      [[ -n ${PBMPI_SUBMIT:-} ]] || fail "PBMPI_REQUEUE: with PBS it needs PBMPI_SUBMIT, the options of qsub and the script"
      local submit
      read -r -a submit <<<"$PBMPI_SUBMIT"
      PBMPI_JOB=$job_id PBMPI_RESTARTS=$((job_restarts + 1)) PBMPI_ARGS=$* qsub -V "${submit[@]}"
      ;;
    *) fail "there is no queue without a scheduler" ;;
  esac
}
