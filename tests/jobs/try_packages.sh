#!/usr/bin/env bash
# Installs the packages of a folder, tries what a user does with each, and removes them again: `try_packages.sh FOLDER`, as
# root, in a system that may be thrown away. See fresh_packages.sh.
set -euo pipefail
packages=$(realpath "$1")
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
cd "$work"
export DEBIAN_FRONTEND=noninteractive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl_vader_single_copy_mechanism=none

fail() {
  echo "try_packages.sh: $1" >&2
  exit 1
}

# say WHAT COMMAND...: the command's output goes to the screen if it fails.
say() {
  echo "== $1"
  shift
  "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "$* failed"; }
}

hash_in() { sed -n 's/^state_hash: *//p' "$1"; }

for name in pbmpi libpbmpi0 libpbmpi-dev python3-pbmpi; do
  ls "$packages/${name}"_*.deb >/dev/null || fail "there is no package $name"
done
say "apt install" apt-get update -qq
say "apt install" apt-get install -y -qq --no-install-recommends "$packages"/*.deb

say "programs" mpirun -n 2 pbmpi --scene CrashSk --stepper sor
hash=$(hash_in log)
[[ $hash =~ ^[0-9a-f]{16}$ ]] || fail "pbmpi printed no hash: $(cat log)"
say "report" pbreport CrashSk.h5 --html CrashSk.html
grep -q "three.js" CrashSk.html || fail "the page has no replay"
say "study" mpirun -n 2 pbstudy stability --scene hard/free/bounce_1 --setting "sor" --quiet
say "job" /usr/share/pbmpi/jobs/sweep.sbatch CrashSk substeps 2 -- --frames 1

say "module" python3 - "$hash" <<'PYTHON'
import sys

import pbmpi

batch = pbmpi.Batch("CrashSk")
batch.step(8 * batch.steps_per_frame)  # as many frames as the scene has, warm-up included
assert batch.hash() == sys.argv[1], f"{batch.hash()} in Python, {sys.argv[1]} by pbmpi"
run = pbmpi.read("CrashSk.h5")
assert run is not None
PYTHON

say "apt install" apt-get install -y -qq --no-install-recommends man-db bash-completion fish zsh cmake make g++ pkg-config
for page in pbmpi pbstudy-accuracy pbreport-csv; do
  man --warnings "$page" >page 2>warnings || fail "man $page failed: $(cat warnings)"
  [[ ! -s warnings ]] || fail "man $page warns: $(cat warnings)"
  [[ $(wc -l <page) -gt 20 ]] || fail "man $page shows $(wc -l <page) lines"
done
# As a shell on a terminal loads it: by the name of the program.
# shellcheck disable=SC2016  # expanded by the inner shell
bash -c '. /usr/share/bash-completion/bash_completion
  _completion_loader pbmpi
  COMP_WORDS=(pbmpi --scene Crash) COMP_CWORD=2 COMP_LINE="pbmpi --scene Crash" COMP_POINT=19
  _pbmpi pbmpi
  [[ " ${COMPREPLY[*]} " == *" CrashWa "* ]]' || fail "bash completes no scene"
fish -c 'complete -C "pbmpi --sce"' | cut -f 1 | grep -qx -e --scene || fail "fish completes no option"

say "find_package" cmake -S "$source_dir/tests/api/example" -B example
say "find_package" cmake --build example
read -r -a flags < <(pkg-config --cflags --libs pbmpi)
say "pkg-config" g++ -std=c++20 "$source_dir"/tests/api/example/*.cpp "${flags[@]}" -o example_by_pkg_config
for program in ./example/example ./example_by_pkg_config; do
  say "example" "$program"
done

say "apt purge" apt-get purge -y -qq pbmpi libpbmpi0 libpbmpi-dev python3-pbmpi
left=$(find /bin /boot /etc /lib /opt /usr /var \( -path /var/cache -o -path /var/log -o -path /var/lib/apt \) -prune -o \
  \( -name '*pbmpi*' -o -name '*pbstudy*' -o -name '*pbreport*' -o -name '*pbvalue*' \) -print)
[[ -z $left ]] || fail "the packages are removed, and left: $left"
rm -r "$work"
echo "all packages install, work, and go again"
