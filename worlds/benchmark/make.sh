#!/bin/sh
# Writes the worlds of the gold benchmark, byte for byte as in this folder.
# Usage: worlds/benchmark/make.sh [FOLDER [PROGRAM]]   (default: this folder, robosim)
set -eu
folder=${1:-$(dirname "$0")}
robosim=${2:-robosim}

make() {
  name=$1
  shift
  "$robosim" generate "$1" "$folder/gold_$name.xml" --robots 4 --types pioneer3dx --seed "$2" $3 >/dev/null
}

make perfect_12 maze   101 "--columns 12 --rows 12 --braid 0"
make perfect_24 maze   102 "--columns 24 --rows 24 --braid 0"
make braided_12 maze   103 "--columns 12 --rows 12 --braid 0.8"
make braided_24 maze   104 "--columns 24 --rows 24 --braid 0.8"
make cave_15    cave   105 "--width 15 --length 15"
make cave_30    cave   106 "--width 30 --length 30"
make office_20  office 107 "--width 20 --length 15"
make office_40  office 108 "--width 40 --length 30"
make open_15    open   109 "--width 15 --length 15 --clutter 0.05"
make open_30    open   110 "--width 30 --length 30 --clutter 0.05"
make clutter_15 open   111 "--width 15 --length 15 --clutter 0.25"
make clutter_30 open   112 "--width 30 --length 30 --clutter 0.25"
