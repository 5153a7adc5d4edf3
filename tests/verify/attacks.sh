#!/usr/bin/env bash
# Runs the attack tests on a server at full length: a million reset streams through the reverse proxy, silent connections
# up to their limits, floods of random bytes. Prints the figures in doc/security.md. Some minutes, on an idle machine.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
cmake --preset release >/dev/null
cmake --build --preset release --target robosim_program robosim_scenarios_test
is_good=true
ROBOSIM_VERIFY=1 build/release/bin/robosim_scenarios_test --gtest_filter='Attack.*:ReverseProxy.*:Flood.*' ||
  is_good=false
# Floods of every kind of frame, from one and from 1,000 addresses: pace, memory and evictions as tables.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 1 -subj /CN=127.0.0.1 \
  -addext subjectAltName=IP:127.0.0.1 -keyout "$folder/key.pem" -out "$folder/cert.pem" 2>/dev/null
chmod 600 "$folder/key.pem"
attacks() {
  echo "attacks.py $*"
  tests/verify/attacks.py build/release/bin/robosim "$@" || is_good=false
}
attacks
attacks --tokens
attacks --tokens --tls "$folder"
attacks --arcos
attacks --console
attacks --console --tls "$folder"
# All addresses of an IPv6 network of 64 bits, in a network namespace of its own.
unshare --user --map-root-user --net bash -euc '
  ip link set lo up
  ip -6 route add local fd00:1:1:1::/64 dev lo
  exec tests/verify/attacks.py build/release/bin/robosim --tokens --ipv6 fd00:1:1:1:' || is_good=false
# All tables are printed, also after one with a figure out of its bounds.
if ! $is_good; then
  echo "attacks.sh: a figure is out of its bounds (see attacks.py)" >&2
  exit 1
fi
