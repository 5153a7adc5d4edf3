#!/usr/bin/env bash
# Runs every test under the address and undefined-behaviour sanitizers, including those with browsers and stock programs
# that ./dev sanitize omits.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
exec ./dev sanitize --no-tests=error "$@"
