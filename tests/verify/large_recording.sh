#!/usr/bin/env bash
# Records 840 MB, in build/release, and prints how long commands take on it and how much memory they use, also for a tenth of it. Fails when
# results depend on the number of threads, a stock program does not read it, or the memory of a command that does not collect the
# recording grows with it by more than half. Some minutes, 3 GB of disk.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
robosim=$PWD/build/release/bin/robosim
folder=$(mktemp -d "${TMPDIR:-/tmp}/large_recording.XXXXXX")
trap 'rm -rf "$folder"' EXIT
cd "$folder"

"$robosim" run opho2_1 --controller wander --time 8000 --record small.rawlog >/dev/null
"$robosim" run opho2_1 --controller wander --time 83000 --record large.rawlog >/dev/null
ls -l --block-size=1 ./*.rawlog

# measure NAME COMMAND...: prints elapsed time, processor time and peak memory, and leaves the memory [kB] in $peak.
measure() {
  local name=$1; shift
  /usr/bin/time -o times -f '%e %U %M' "$@" >output 2>messages
  read -r elapsed processor peak <times
  printf '%-40s %8.2f s, processor %8.2f s, %8d kB\n' "$name" "$elapsed" "$processor" "$peak"
}
# bounded NAME COMMAND...: COMMAND has a word FILE, the recording.
bounded() {
  local name=$1; shift
  measure "$name, small" "${@//FILE/small.rawlog}"
  local of_small=$peak
  measure "$name, large" "${@//FILE/large.rawlog}"
  ((peak < of_small + of_small / 2 + 20000)) || { echo "$name: the memory grows with the file" >&2; exit 1; }
}

for time in 0 8299 83000; do
  measure "view --offscreen --to $time" "$robosim" view large.rawlog --offscreen "$time.png" --to "$time"
done
bounded "replay" "$robosim" replay FILE
bounded "replay --output" "$robosim" replay FILE --robot Finder1 --output part.rawlog
for threads in 1 2; do
  measure "replay --threads $threads" "$robosim" replay large.rawlog --threads $threads
  cp output "summary$threads"
  measure "export .csv --threads $threads" "$robosim" export small.rawlog "$threads.csv" --threads $threads
done
cmp summary1 summary2
cmp 1.csv 2.csv
measure "gzip -t" gzip -t large.rawlog
measure "rawlog-edit --info, small" rawlog-edit --info -i small.rawlog
