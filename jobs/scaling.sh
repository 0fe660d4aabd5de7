#!/usr/bin/env bash
# What more ranks bring: runs the same work on different numbers of ranks, again and again in random order, and reports it.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/scaling.sh [options] [OUTDIR [CASE ...]] [-- pbmpi options]

Leaves a run file for each run in OUTDIR (default: ./scaling), and the report over them: OUTDIR/scaling.html, .txt, .md
and .csv. What is there already and complete is not run again, so that a sweep which was stopped goes on. Minutes.

A CASE is a scene, and how its work grows with the ranks:
  SCENE:worlds:N   N worlds over the ranks (strong scaling)
  SCENE:each:N     N worlds on each rank (weak scaling)
  SCENE:spaces     one world cut into spaces (strong scaling), and whole on one rank
Default: 100CrSk:worlds:100 100CrSk:each:50 Battle:each:4 Battle:spaces Battle2:each:4 Battle2:spaces

  --ranks "N ..."  numbers of ranks, or N,N,...; default: powers of two up to the cores, or to the ranks of a job
  --repeats N      runs of each point, each round in an order of its own; default: 5
  --round N        only this round of them, from 1 on: for a job array
  --frames N       measured frames of a run, after 3 for warm-up; default: 60
  --seed N         of the orders; default: 1
  --quick-look     100CrSk:worlds:20 and Battle2:spaces, 5 frames, 2 repeats

A rank has a core to itself where there are enough of them. PBMPI_BIN and PBMPI_MPIRUN_OPTIONS as in jobs/README.md.
TEXT
}

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=jobs/batch.sh
. "$source_dir/jobs/batch.sh"

arguments=("$@")
cases=()
ranks=""
repeats=5
rounds=""
frames=60
seed=1
out=""
quick=no
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --quick-look) quick=yes; shift ;;
    --ranks | --repeats | --round | --frames | --seed)
      [[ $# -ge 2 ]] || fail "$1 needs a value; see --help"
      form='^[1-9][0-9]*$'
      [[ $1 != --ranks ]] || form='^[1-9][0-9]*([ ,][1-9][0-9]*)*$'
      [[ $2 =~ $form ]] || fail "$1 $2: it must be a number from 1 on; see --help"
      case $1 in
        --ranks) ranks=${2//,/ } ;;
        --repeats) repeats=$2 ;;
        --round) rounds=$2 ;;
        --frames) frames=$2 ;;
        --seed) seed=$2 ;;
      esac
      shift 2 ;;
    --) shift; break ;;
    -*) fail "unknown option '$1'; see --help" ;;
    *) if [[ -z $out ]]; then out=$1; else cases+=("$1"); fi; shift ;;
  esac
done
out=${out:-scaling}
if [[ $quick == yes ]]; then
  frames=5
  repeats=2
  [[ ${#cases[@]} -gt 0 ]] || cases=(100CrSk:worlds:20 Battle2:spaces)
fi
[[ ${#cases[@]} -gt 0 ]] ||
  cases=(100CrSk:worlds:100 100CrSk:each:50 Battle:each:4 Battle:spaces Battle2:each:4 Battle2:spaces)
case_form='^(.+):(spaces|(worlds|each):([1-9][0-9]*))$'
for case in "${cases[@]}"; do
  [[ $case =~ $case_form ]] || fail "case '$case': it must be SCENE:worlds:N, SCENE:each:N or SCENE:spaces"
done
[[ -z $(output_among "$@") ]] || fail "each run has a file of its own; drop --output and --no-output"
find_programs
# Of hardware threads that share a core mpirun binds a rank to the core, and refuses a second one.
cores=$(lscpu --parse=CORE,SOCKET 2>/dev/null | grep -v '^#' | sort -u | wc -l || true)
[[ $cores -gt 0 && $cores -lt $(nproc) ]] || cores=$(nproc)
if [[ -z $ranks ]]; then
  most=${job_ranks:-$cores}
  for ((n = 1; n <= most; n *= 2)); do ranks+="$n "; done
fi
mkdir -p "$out"

# points: "RANKS WORLDS HOW SCENE" of all cases, one a line.
points() {
  local case scene how n count
  for case in "${cases[@]}"; do
    [[ $case =~ $case_form ]]
    scene=${BASH_REMATCH[1]} how=${BASH_REMATCH[3]:-spaces} n=${BASH_REMATCH[4]}
    [[ $how != spaces ]] || echo "1 1 worlds $scene"
    for count in $ranks; do
      case $how in
        worlds) echo "$count $n worlds $scene" ;;
        each) echo "$count $((n * count)) worlds $scene" ;;
        spaces) echo "$count 1 spaces $scene" ;;
      esac
    done
  done | sort -u
}

# shuffled ROUND: the lines of standard input in the order of that round.
shuffled() { awk -v seed="$((seed * 1000 + $1))" 'BEGIN { srand(seed) } { print rand() "\t" $0 }' | sort -n | cut -f 2-; }

is_complete() { [[ -e $1 && $(pbreport "$1" --json 2>/dev/null) == *'"complete": true'* ]]; }

# run_point FILE RANKS WORLDS HOW SCENE pbmpi options...
run_point() {
  local file=$1 count=$2 worlds=$3 how=$4 scene=$5 limit mpi_options=()
  shift 5
  readarray -t limit < <(time_limit "$@")
  if [[ $count -le $cores || -n $scheduler ]]; then
    mpi_options+=(--bind-to core)
  else
    mpi_options+=(--bind-to none)
  fi
  read -r -a given <<<"${PBMPI_MPIRUN_OPTIONS:-}"
  run_until_stopped mpirun "${host_options[@]}" "${mpi_options[@]}" "${given[@]}" -n "$count" "$(command -v pbmpi)" --scene "$scene" \
    --replicas "$worlds" --decompose "$how" --frames "$frames" --record-every "$((frames + 3))" --warmup 3 --quiet \
    --output "$file" "$@" "${limit[@]}"
}

# stop CODE: of a run that did not end well.
stop() {
  if [[ $1 -eq 75 && ${PBMPI_REQUEUE:-} == yes && -n $scheduler ]]; then
    echo "the time is up: back into the queue, to go on with what is not complete"
    requeue_job "${arguments[@]}"
  fi
  exit "$1"
}

for round in ${rounds:-$(seq "$repeats")}; do
  while read -r count worlds how scene; do
    file=$out/$(name_of_scene "$scene")-$how-w$worlds-r$count-k$round.h5
    ! is_complete "$file" || continue
    echo "round $round: $scene, $worlds worlds, decomposed into $how, on $count ranks"
    run_point "$file" "$count" "$worlds" "$how" "$scene" "$@" || stop $?
  done < <(points | shuffled "$round")
done

# The other tasks of an array may be at work: on runs that are not complete yet, and on the report.
files=()
for file in "$out"/*-k[0-9]*.h5; do
  ! is_complete "$file" || files+=("$file")
done
exec 9>"$out/.report.lock"
flock 9
pbreport scaling "${files[@]}" --markdown --html "$out/scaling.html" --csv "$out/scaling.csv" >"$out/scaling.md"
pbreport scaling "${files[@]}" | tee "$out/scaling.txt"
