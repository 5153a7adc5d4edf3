# bash completion for robosim. Subcommands, options and their values are those that the program itself lists, with plugins.

# Sets COMPREPLY to the words in $1, one per line, that begin with the current word.
_robosim_from() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}

# Sets COMPREPLY to file names; folders get a slash.
_robosim_files() {
  compopt -o filenames 2>/dev/null || true  # fails outside of a completion
  mapfile -t COMPREPLY < <(compgen -f -- "$cur")
}

# Prints the names of the controllers or observers.
_robosim_names() {
  "$program" "$1" "${plugins[@]}" 2>/dev/null | sed -n 's/^\([A-Za-z0-9_]*\): .*/\1/p'
}

_robosim() {
  local cur prev words cword
  if declare -F _init_completion >/dev/null; then
    _init_completion -n =: || return
  else
    cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} words=("${COMP_WORDS[@]}") cword=$COMP_CWORD
    # Bash divides --option=value at the equals sign, which _init_completion -n = undoes.
    if [[ $cur == = ]]; then
      cur=
    elif [[ $prev == = ]]; then
      prev=${COMP_WORDS[COMP_CWORD - 2]}
    fi
  fi
  if [[ $cur == --*=* ]]; then
    prev=${cur%%=*} cur=${cur#*=}
  fi

  # The subcommand, which may have one of its own (robosim bench gold), and the plugins given before the current word.
  local program=${words[0]} help listed subcommand=() plugins=() i
  help=$("$program" --help 2>/dev/null) || return
  for ((i = 1; i < cword; ++i)); do
    [[ ${words[i]} == --plugin && $((i + 1)) -lt $cword ]] && plugins+=(--plugin "${words[i + 1]/#\~/$HOME}")
    listed=$(sed -n '/^Subcommands:$/,/^$/ s/^  \([a-z]*\) .*/\1/p' <<<"$help")
    if [[ $listed && ${words[i]} =~ ^[a-z]+$ ]] && grep -qxF -- "${words[i]}" <<<"$listed"; then
      subcommand+=("${words[i]}")
      help=$("$program" "${subcommand[@]}" --help 2>/dev/null) || return
    fi
  done
  listed=$(sed -n '/^Subcommands:$/,/^$/ s/^  \([a-z]*\) .*/\1/p' <<<"$help")

  # The value of an option: its name in the help, as in "--picture FILE" or "--pace lockstep|realtime".
  local value=
  [[ $prev == --* ]] && value=$(sed -n "s/^  \(-[a-z0-9],\)\?$prev \([^ ].*\)/\2/p" <<<"$help")
  case $value in
    "" | " "* | Excludes:* | Needs:*) ;;  # no option, or one without a value
    FILE*)
      _robosim_files
      return ;;
    CONTROLLER*)
      _robosim_from "$(_robosim_names controllers)"
      return ;;
    OBSERVER*)
      _robosim_from "$(_robosim_names observers)"
      return ;;
    [a-z]*\|*)
      value=${value%% *}
      _robosim_from "${value//|/ }"
      return ;;
    [A-Z]*) return ;;
  esac

  if [[ $cur == -* ]]; then
    _robosim_from "$(sed -n 's/^  -/-/p' <<<"$help" | grep -o -- '^[^ ]*' | tr , '\n')"
  elif [[ $listed ]]; then
    _robosim_from "$listed"
  elif [[ ${subcommand[0]} == controllers || ${subcommand[0]} == observers ]]; then
    _robosim_from "$(_robosim_names "${subcommand[0]}")"
  elif [[ ${subcommand[0]} == sensors ]]; then
    _robosim_from "$("$program" sensors "${plugins[@]}" 2>/dev/null | sed -n 's/^<\([a-z_]*\)>: .*/\1/p')"
  elif grep -q '^Positionals:$' <<<"$help"; then
    _robosim_files
  fi
}
complete -F _robosim robosim
