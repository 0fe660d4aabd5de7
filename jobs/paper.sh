#!/usr/bin/env bash
# Every statement, table and figure of the paper beside what this machine measures: verdicts, and one page.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/paper.sh [--quick-look] [--without-clock] [--prediction] [--long] [OUTDIR]

Writes OUTDIR/paper.html, .txt, .md and .json (default: ./paper), and in OUTDIR/files what they come from. Needs python3-h5py,
valgrind and objdump. Up to 10 minutes on 2 cores; times need a machine that does nothing else.

  --quick-look   2-Cars and Fight only, a minute: what is about all nine scenes stays undecided
  --without-clock
                 only what comes out the same on every machine: no times, no instructions; 3 minutes
  --prediction   value prediction too (jobs/paper/predict.py): 20 minutes more; OUTDIR/prediction.h5 is kept for later calls
  --long         count the instructions of direct in 100CrSk, Battle and CrashWa, too: hours more

What was not measured is told in the table with the command that measures it.
TEXT
}

scenes=(2-Cars 10-Cars CrashSk CrashWa Environ 100CrSk Battle Fight Battle2)
# The big matrix of Battle2 takes 20 s a step, of Environ minutes.
direct=(2-Cars 10-Cars CrashSk 100CrSk Battle Fight)
counted=("${scenes[@]}")
more_iterations=(40 80)
small=no
clock=yes
prediction=no
long=()
out=paper
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --quick-look) scenes=(2-Cars Fight) direct=(2-Cars Fight) counted=(2-Cars) more_iterations=() small=yes; shift ;;
    --without-clock) clock=no; shift ;;
    --prediction) prediction=yes; shift ;;
    --long) long=(--long); shift ;;
    -*) echo "paper.sh: unknown option '$1'; see --help" >&2; exit 2 ;;
    *) out=$1; shift ;;
  esac
done

jobs=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$jobs/mpi_environment.sh"
bin=${PBMPI_BIN:-$jobs/../build/release/bin}
[[ -x $bin/pbreport ]] || { echo "paper.sh: $bin/pbreport is missing; build it with jobs/build.sh release" >&2; exit 2; }
python3 -c 'import h5py' 2>/dev/null || { echo "paper.sh: python3 has no h5py; install python3-h5py (jobs/install_packages.sh)" >&2; exit 2; }
export PBMPI_BIN=$bin PATH=$bin:$PATH
files=$out/files
rm -rf "$files"  # those of an earlier call would be taken for this one's
mkdir -p "$files"/{one_iteration,iterations,direct,plain,repeats}
repeats=3 seeds=2
[[ $clock == yes ]] || repeats=1
[[ $small == no ]] || repeats=1 seeds=1

# record FILE option...: a run of one rank, whose times are those of one core
record() {
  local file=$files/$1
  shift
  pbmpi --quiet --progress never --output "$file" "$@"
}

echo "Figure 6, Tables 1 and 2"
"$jobs/figure6.sh" --no-stills "$files/figure6" "${scenes[@]}" >/dev/null

# What else runs on the machine makes some times longer; the least is taken.
for ((repeat = 2; repeat <= repeats; ++repeat)); do
  for scene in "${scenes[@]}"; do record "repeats/$scene.$repeat.h5" --scene "$scene" --stepper quick --record islands; done
done

if [[ $clock == yes ]]; then
  echo "the steps of ODE"
  for ((repeat = 1; repeat <= repeats; ++repeat)); do
    for scene in "${scenes[@]}"; do
      record "one_iteration/$scene.$repeat.h5" --scene "$scene" --stepper quick --iterations 1 --record islands
    done
    for scene in "${direct[@]}"; do
      record "direct/$scene.$repeat.h5" --scene "$scene" --stepper direct --record islands
    done
    for iterations in ${more_iterations[@]+"${more_iterations[@]}"}; do
      record "iterations/$iterations.$repeat.h5" --scene CrashWa --stepper quick --iterations "$iterations" --record islands
    done
  done
fi
if [[ $clock == yes && $small == no ]]; then
  # One step, before the crash: seconds.
  record direct/CrashWa.h5 --scene CrashWa --stepper direct --record islands --warmup 0 --frames 1 --steps-per-frame 1
fi
if [[ $small == no ]]; then
  for scene in CrashWa hard/contact/bullets_50; do
    record "plain/$(basename "$scene").h5" --scene "$scene" --stepper quick --effects -fast_bodies
  done
fi

echo "Figures 8 and 9"
REPEATS=$repeats SEEDS=$seeds "$jobs/figure8_9.sh" "$files/figure8_9" "${scenes[@]}" >/dev/null

if [[ $small == no ]]; then
  echo "iterations and hard cases"
  mpirun -n 2 pbstudy stability --most-work 12000 --quiet --progress never --output "$files/stability.h5" \
    --setting "quick iterations=5" "quick iterations=10" quick "quick iterations=40" "quick iterations=80"
fi

if [[ $clock == no ]]; then
  :  # counts of instructions follow the processor's library functions
elif command -v valgrind >/dev/null && command -v objdump >/dev/null; then
  echo "Figure 3"
  "$jobs/figure3.sh" ${long[@]+"${long[@]}"} --runs "$files/figure6" "$files/figure3" "${counted[@]}" >/dev/null
else
  echo "no valgrind or objdump: instructions are left out"
fi

if [[ $prediction == yes ]]; then
  echo "value prediction"
  python3 "$jobs/paper/predict.py" --jobs 2 --quiet --output "$out/prediction.h5"
fi

data=("$files")
[[ ! -e $out/prediction.h5 ]] || data+=("$out/prediction.h5")
report() { python3 "$jobs/paper/paper.py" paper "${data[@]}" "$@"; }
report --json >"$out/paper.json"
report --markdown >"$out/paper.md"
report --html "$out/paper.html" | tee "$out/paper.txt"
echo "$out/paper.html"
