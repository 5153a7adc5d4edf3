#!/usr/bin/env bash
# Measures the success of the gold finder with the errors of all sensors: 100 runs in each shipped maze, with all of its
# robots and with a single one of each type. Fails below 95. Some minutes.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
cmake --preset release >/dev/null
cmake --build --preset release --target robosim_program
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r worlds/robots maps "$folder"
# Writes a world with one of its robots.
single() {
  /usr/bin/python3 - "$1" "$2" "$3" <<'P'
import sys, xml.etree.ElementTree as tree
source, kept, result = sys.argv[1:]
world = tree.parse(source)
def prune(parent):
    for child in list(parent):
        robot = child.find('.//robot') if child.tag == 'object' else None
        if robot is not None:
            if kept not in [name.text.strip() for name in robot.iter('name')]:
                parent.remove(child)
                continue
            for neighbour in robot.findall('neighbour'):
                robot.remove(neighbour)
        prune(child)
prune(world.getroot())
for a_map in world.getroot().iter('map'):
    a_map.set('file', a_map.get('file').replace('../', ''))
world.write(result)
P
}
failed=0
measure() {
  local row
  row=$(build/release/bin/robosim bench gold "$1" --controller gold_finder --noise all --runs 100 --threads "$(nproc)" 2>/dev/null | sed -n 2p)
  echo "$row"
  (($(awk '{print $3}' <<<"$row") >= 95)) || failed=1
}
for world in small_maze opho2_1 lab_map maze_20x20 open_house benchmark/gold_perfect_12 benchmark/gold_perfect_24 \
  benchmark/gold_braided_12 benchmark/gold_braided_24; do
  measure "worlds/$world.xml"
done
while read -r world robot; do
  single "worlds/$world.xml" "$robot" "$folder/${world}_$robot.xml"
  measure "$folder/${world}_$robot.xml"
done <<'ROBOTS'
small_maze Pioneer1
small_maze Scout1
opho2_1 Finder1
lab_map Pioneer1
lab_map Scout1
maze_20x20 Pioneer1
maze_20x20 Scout1
ROBOTS
exit $failed
