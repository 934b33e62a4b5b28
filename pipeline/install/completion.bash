# Completion in bash for dryer, rigidstress, breaker, agglomerate and crumble. It asks the programs: options and verbs are those of --help, keys
# behind --set and their words those of --print-defaults.

# Options of a command, "--seed" and so on; where it has them, verbs.
_crumble_words() {
  "$@" --help 2> /dev/null | sed -nE '/^(Verbs|What):/,/^$/s/^  ([a-z]+) .*/\1/p; s/^ +(-[a-z],)?(--[a-z-]+).*/\2/p'
}

# section.key= of every parameter, or behind "section.key=" what its range names: "(equal, lognormal or bimodal)".
_crumble_keys() {
  "$1" --print-defaults 2> /dev/null | awk -v wanted="$2" '
    /^\[[a-z_]+\]$/ { section = substr($0, 2, length($0) - 2) }
    /^\[\[|^# \[\[/ { section = "" }
    match($0, /^(# )?[a-z_]+ = /) && section {
      key = $0; sub(/^# /, "", key); sub(/ = .*/, "", key); key = section "." key
      if (wanted == "") { print key "=" }
      else if (wanted == key && match(range, /\([a-z0-9-]+(, [a-z0-9-]+)* or [a-z0-9-]+\)$/)) {
        range = substr(range, RSTART + 1, RLENGTH - 2); gsub(/, | or /, "\n", range); print range
      }
    }
    { range = $0 }'
}

# Files that end in one of $2, and folders.
_crumble_files() {
  local file
  compgen -f -- "$1" | while read -r file; do
    if [[ -d $file ]]; then echo "$file/"; elif [[ $file =~ \.($2)$ ]]; then echo "$file"; fi
  done
}

_crumble() {
  local line=${COMP_LINE:0:COMP_POINT} command=("$1") previous=() current scenes
  read -ra previous <<< "$line"
  # By blanks, as an = would split section.key=value.
  if [[ $line == *' ' ]]; then current=; else current=${previous[-1]}; unset 'previous[-1]'; fi
  if [[ $1 == *crumble ]]; then
    case ${previous[1]-} in
      dry) command=(dryer) ;;
      stress) command=(rigidstress) ;;
      break) command=(breaker) ;;
      file) command=(agglomerate) ;;
    esac
    if [[ ${command[0]} != "$1" ]]; then previous=("${previous[@]:1}"); fi
  fi
  # A verb that stands there is part of the command.
  if [[ ${command[0]} == *agglomerate && ${previous[1]-} == [a-z]* || ${command[0]} == *dryer && ${previous[1]-} == continuum ]]; then
    command+=("${previous[1]}")
  fi

  COMPREPLY=()
  if [[ ${previous[-1]} == --set ]]; then
    if [[ $current == *=* ]]; then
      mapfile -t COMPREPLY < <(compgen -W "$(_crumble_keys "${command[0]}" "${current%%=*}")" -- "${current#*=}")
    else
      mapfile -t COMPREPLY < <(compgen -W "$(_crumble_keys "${command[0]}" '')" -- "$current")
      compopt -o nospace 2> /dev/null
    fi
  elif [[ ${previous[-1]} == -* && ${previous[-1]} =~ ^(-o|--output|--report)$ ]]; then
    mapfile -t COMPREPLY < <(_crumble_files "$current" 'h5|json|csv|xyz|hdf')
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_crumble_words "${command[@]}" | grep -e ^-)" -- "$current")
  else
    if ((${#previous[@]} == ${#command[@]})); then
      mapfile -t COMPREPLY < <(compgen -W "$(_crumble_words "${command[@]}" | grep -ve ^-)" -- "$current")
    fi
    if [[ ${command[0]} != "$1" || $1 != *crumble ]]; then
      case "${command[0]##*/} ${previous[*]}" in
        agglomerate*) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(_crumble_files "$current" 'h5|csv|xyz|extxyz') ;;
        *.toml*) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(_crumble_files "$current" h5) ;;
        *)
          mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(_crumble_files "$current" toml)
          # And those that were installed.
          scenes=$(command -v "${command[0]}") && scenes=${scenes%/bin/*}/share/crumble/pipeline/scenes
          mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -G "$scenes/*.toml" | grep -F -- "$current")
          ;;
      esac
    fi
  fi
}

complete -o filenames -F _crumble dryer rigidstress breaker agglomerate crumble
