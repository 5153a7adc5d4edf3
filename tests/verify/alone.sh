#!/usr/bin/env bash
# Compiles every source file alone, without code generation: whole builds compile several files together, which hides an #include that
# one of them lacks. A quarter of an hour.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
cmake --preset develop >/dev/null
cmake --build --preset develop --target robosim_proto_sources >/dev/null
exec tests/compile_alone.py build/develop "$@"
