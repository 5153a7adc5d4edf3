#!/usr/bin/env bash
# Inspects the console's page in every state at every size, in the light and the dark theme, for overlaps and for violations
# of accessibility rules; the tests browser.layout and browser.game take a sample of these. Needs no build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
node --test tests/browser/layout_test.mjs tests/browser/game_test.mjs
