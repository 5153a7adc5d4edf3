#!/usr/bin/env bash
# Tests the bash completion of an installed robosim: completion.sh CMAKE BUILD_FOLDER
set -euo pipefail
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
"$1" --install "$2" --component robosim --prefix "$prefix" >/dev/null
PATH=$prefix/bin:$PATH
cd "$prefix/share/robosim"
# shellcheck source=/dev/null
source "$prefix/share/bash-completion/completions/robosim"

failures=0
# expect "WORDS…" "CANDIDATE…": completes the last word of a command line, and compares the sorted candidates.
expect() {
  local found
  eval "COMP_WORDS=(robosim $1)"
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMPREPLY=()
  _robosim
  found=$(printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd ' ')
  [[ $found == "$2" ]] && return
  printf 'robosim %s\n  completes to: %s\n  expected:     %s\n' "$1" "$found" "$2" >&2
  failures=$((failures + 1))
}

expect 're' 'remote replay'
expect '--v' '--version'
expect 'run --co' '--controller'
expect 'run --pi' '--picture'
expect 'run worlds/small' 'worlds/small_maze.xml'
expect 'run worlds/small_maze.xml --json --see' '--seed'
expect 'run --json maps/off' "$(printf '%s\n' maps/off* | sort | paste -sd ' ')"
expect 'run --record rawlogs/RE' 'rawlogs/README.md'
expect 'run --record=rawlogs/RE' 'rawlogs/README.md'
expect 'run --record = rawlogs/RE' 'rawlogs/README.md'
expect 'run --seed ""' ''
expect 'run --noise ""' 'all on world'
expect 'run --controller w' 'wall_follower wall_search wander'
expect 'run --observer co' 'collection coverage'
expect 'observers co' 'collection coverage'
expect 'serve --pace ""' 'lockstep realtime'
expect 'serve --foxg' '--foxglove --foxglove-origin'
expect 'view --foxglove' '--foxglove --foxglove-origin'
expect 'view --we' '--web'
expect 'serve --we' '--web'
expect 'run --we' '--web'
expect 'serve --ros2-' '--ros2-distribution --ros2-interface --ros2-peer --ros2-supervise --ros2-tf --ros2-unprotected'
expect 'run --ros2' '--ros2 --ros2-distribution --ros2-supervise --ros2-tf'
expect 'serve --ros2-tf ""' 'common robot'
expect 'bench g' 'gold'
expect 'bench gold --ru' '--runs'
expect 'bench gold worlds/small' 'worlds/small_maze.xml'
expect 'conv' 'convert'
expect 'convert --fo' '--force'
expect 'generate m' 'maze'
expect 'generate maze --br' '--braid'
expect 'control localhost:3000 sta' 'start status'
expect 'controllers st' 'stigmergy still'
expect 'sensors la' 'laser'
exit $((failures > 0))
