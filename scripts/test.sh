#!/usr/bin/env bash
# Everything from a fresh Debian 12 to the result of all tests, which is printed last.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/build.sh
ctest --preset release -j2
