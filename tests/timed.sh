#!/usr/bin/env bash
# timed.sh FILE NAME COMMAND…: executes the command of a test and appends a line to FILE: processor time [s], elapsed time [s], NAME.
# ./dev test prints the largest. The processor time includes that of all processes that the test started and waited for.
file=$1 name=$2
shift 2
begin=$EPOCHREALTIME
"$@"
exit_code=$?
end=$EPOCHREALTIME
# The second line of `times` is that of the children: minutes and seconds in user mode and in the system.
times >"$file.$$"
{ read -r; read -r user system; } <"$file.$$"
rm -f "$file.$$"
awk -v user="$user" -v system_time="$system" -v begin="$begin" -v end="$end" -v name="$name" '
  function seconds(text) { split(text, part, /[ms]/); return part[1] * 60 + part[2] }
  BEGIN { printf "%.2f %.2f %s\n", seconds(user) + seconds(system_time), end - begin, name }' >>"$file"
exit "$exit_code"
