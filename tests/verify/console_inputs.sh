#!/usr/bin/env bash
# Sends a thousand random events of keyboard, pointers, gamepad, focus and connection to the console's page; the test
# browser.random_inputs sends 200. Needs no build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
node --test tests/browser/random_inputs_test.mjs
