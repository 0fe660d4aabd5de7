#!/usr/bin/env bash
# Writes manual pages from --help, by help2man: `write_pages.sh VERSION BIN FOLDER PROGRAM...`, a page for each program and
# for each command that its --help lists.
set -euo pipefail
version=$1 bin=$2 folder=$3
shift 3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/../../../jobs/mpi_environment.sh"
# One process alone: Open MPI starts no daemon. It also keeps memory until the process ends.
export OMPI_MCA_ess_singleton_isolated=1 ASAN_OPTIONS=detect_leaks=0 PATH=$bin:$PATH

# page NAME MEANING COMMAND...
page() {
  "${HELP2MAN:-help2man}" --no-info --include "$here/pages.h2m" --source "pbmpi $version" --version-string "$1 $version" \
    --name "$2" --help-option "--help all" --output "$folder/$1.1" "${*:3}"
}

for program in "$@"; do
  help=$("$program" --help all)
  about=$(sed '/^$/,$d' <<<"$help" | tr '\n' ' ')  # "pbmpi simulates worlds over MPI ranks. ..."
  about=${about#"$program "}
  page "$program" "${about%%.*}" "$program"
  sed -n '/^Studies (\|^Commands (/,/^$/s/^  //p' <<<"$help" | while read -r command meaning; do
    # pbreport's first command is pbreport itself.
    [[ $("$program" "$command" --help all) == "$help" ]] || page "$program-$command" "$meaning" "$program" "$command"
  done
done
