# shellcheck shell=bash
# Completion of pbmpi, pbstudy and pbreport by bash-completion, from what they say to --help all.
declare -gA _pbmpi_said

# _pbmpi_ask COMMAND...: what it says, asked once a shell. MPI starts without a daemon, which halves the time.
_pbmpi_ask() {
  [[ -n ${_pbmpi_said[$*]-} ]] || _pbmpi_said[$*]=$(OMPI_MCA_ess_singleton_isolated=1 "$@" 2>/dev/null)
  said=${_pbmpi_said[$*]}
}

# _pbmpi_values OPTION PROGRAM: completes the value of an option whose line of --help all is "  --option a|b|FILE  meaning".
_pbmpi_values() {
  local value offered
  value=$(sed -n "s/^  \(-., \)\?$1 \([^ ]\+\).*/\2/p" <<<"$said")
  [[ -n $value ]] || return
  [[ $value != *\|* ]] || offered=$(tr '|' '\n' <<<"$value" | grep -x '[a-z0-9_]*')
  if [[ $1 == --scene ]]; then
    _pbmpi_ask "${2%pb*}pbmpi" --list-scenes
    offered=$(awk '!/:$/ { print $1 }' <<<"$said")
  fi
  [[ $value != *FILE* && $value != *OUT* ]] || _filedir
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$offered" -- "$cur")
}

_pbmpi() {
  # shellcheck disable=SC2034  # what _init_completion sets
  local cur prev words cword split said commands
  _init_completion -s || return
  _pbmpi_ask "$1" --help all
  commands=$(sed -n '/^Studies (\|^Commands (/,/^$/s/^  \([a-z]\+\) .*/\1/p' <<<"$said")
  if ((cword > 1)); then
    ! grep -qxF -e "${words[1]}" <<<"$commands" || _pbmpi_ask "$1" "${words[1]}" --help all
    commands=
  fi
  # shellcheck disable=SC2154  # _init_completion sets it
  if [[ $prev =~ ^--?[a-z-]+$ ]] && _pbmpi_values "$prev" "$1"; then
    return
  elif [[ $cur == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(grep '^  -' <<<"$said" | _parse_help -)" -- "$cur")
  else
    _filedir
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$commands" -- "$cur")
  fi
}
complete -F _pbmpi pbmpi pbstudy pbreport
