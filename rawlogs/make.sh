#!/bin/sh
# Recreates the recordings of this folder; may be run from any folder: rawlogs/make.sh
# The same program creates the same files, byte for byte, except for pictures, which depend on the graphics driver.
# ROBOSIM is the program (default build/release/bin/robosim). Requires the packages in doc/examples/python_robot/README.md,
# and those that ./dev test fetches for tests/mcap.
set -eu
cd "$(dirname "$0")/.."
robosim=${ROBOSIM:-build/release/bin/robosim}

echo "opho2_1.rawlog"
"$robosim" run worlds/opho2_1.xml --record rawlogs/opho2_1.rawlog

echo "slam.rawlog, slam_sf.rawlog"
"$robosim" run rawlogs/slam.xml --seed 5 --step 0.2 --time 90 --record rawlogs/slam.rawlog
"$robosim" run rawlogs/slam.xml --seed 5 --step 0.2 --time 90 --rawlog-format sf --record rawlogs/slam_sf.rawlog

echo "scanner_bag"
node tests/mcap/make_scanner_bag.mjs "$robosim" rawlogs/scanner_bag

echo "driven.rawlog"
work=$(mktemp -d)
trap 'kill "$server" 2>/dev/null || true; rm -rf "$work"' EXIT
server=
protoc -I lib/foundation/net/proto --python_out="$work" --grpc_out="$work" --plugin=protoc-gen-grpc=/usr/bin/grpc_python_plugin \
    lib/foundation/net/proto/robosim/v1/robots.proto lib/foundation/net/proto/robosim/v1/sensors.proto
cp rawlogs/drive.py "$work"
"$robosim" serve rawlogs/driven.xml --wait-for-robots --listen 127.0.0.1:0 --time 18.8 --record rawlogs/driven.rawlog \
    2>"$work/log" &
server=$!
until address=$(sed -n 's/.*listening on //p' "$work/log" | head -1) && [ -n "$address" ]; do
    kill -0 "$server" 2>/dev/null || { cat "$work/log" >&2; exit 1; }
    sleep 0.1
done
/usr/bin/python3 "$work/drive.py" "$address" Driven
wait "$server"
ls -l rawlogs/*.rawlog
