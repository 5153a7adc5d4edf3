#!/usr/bin/env bash
# Sends 100,000 mutated TLS handshakes each to the ports of the environment and the console; both must keep serving.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset release >/dev/null
cmake --build --preset release --target robosim_program
exec tests/verify/tls_handshakes.py build/release/bin/robosim --count 100000
