#!/usr/bin/env bash
# Runs every shipped world on emulated processors whose vectors are narrower than this machine's (SSE4.2; AVX2), and
# compares the digests of seed 1 with those kept in tests/data/golden_digests.json. Some minutes.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
[[ $(uname -m) == x86_64 ]] || { echo "processors.sh: needs an x86-64 machine, this is $(uname -m)" >&2; exit 1; }
cmake --preset release >/dev/null
cmake --build --preset release --target robosim_program

worlds='import json
for world, entry in json.load(open("tests/data/golden_digests.json")).items():
    print(world, entry["time_s"], entry["digests"][0])'
# robosim-run directly: a program that robosim starts would not be emulated.
failed=0
for processor in Nehalem Haswell; do
  while read -r world time_s digest; do
    found=$(qemu-x86_64-static -cpu "$processor" build/release/bin/robosim-run run "worlds/$world.xml" --time "$time_s" \
      --seed 1 --json 2>/dev/null </dev/null | sed -n 's/.*"digest": "\(.*\)".*/\1/p')
    if [[ $found == "$digest" ]]; then
      echo "$processor $world: $found"
    else
      echo "$processor $world: digest ${found:-missing}, kept is $digest" >&2
      failed=1
    fi
  done < <(python3 -c "$worlds")
done
exit $failed
