#!/usr/bin/env bash
# Sends 10,000 random events of keyboard, pointers, gamepad, focus and connection to the console's page, in the view with details
# and in the game view; the test browser.random_inputs sends 100. Needs no build. An hour.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
node --test tests/browser/random_inputs_test.mjs
