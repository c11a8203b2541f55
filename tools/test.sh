#!/usr/bin/env bash
# tools/test.sh [CTEST OPTION...]: installs what is missing, builds everything (Release) and runs all
# tests. The last lines are ctest's summary. `-L fast` and the like pass through to ctest.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh
cmake --preset release
cmake --build --preset release
exec ctest --preset release -j2 --output-on-failure "$@"
