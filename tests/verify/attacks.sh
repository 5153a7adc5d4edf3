#!/usr/bin/env bash
# Runs the attack tests on a server at full length: a million reset streams through the reverse proxy, silent connections
# up to their limits, floods of random bytes. Prints the figures in doc/security.md. Some minutes, on an idle machine.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
cmake --preset release >/dev/null
cmake --build --preset release --target robosim_program robosim_scenarios_test
ROBOSIM_VERIFY=1 build/release/bin/robosim_scenarios_test --gtest_filter='Attack.*:ReverseProxy.*:Flood.*'
# Floods of every kind of frame, from one and from 1,000 addresses: pace, memory and evictions as a table.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 1 -subj /CN=127.0.0.1 \
  -addext subjectAltName=IP:127.0.0.1 -keyout "$folder/key.pem" -out "$folder/cert.pem" 2>/dev/null
chmod 600 "$folder/key.pem"
tests/verify/attacks.py build/release/bin/robosim
tests/verify/attacks.py build/release/bin/robosim --tokens
tests/verify/attacks.py build/release/bin/robosim --tokens --tls "$folder"
