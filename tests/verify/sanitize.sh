#!/usr/bin/env bash
# Runs every test under the address and undefined-behaviour sanitizers, including those with browsers and programs of others
# that ./dev sanitize omits.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
exec ./dev sanitize --all --no-tests=error "$@"
