#!/usr/bin/env bash
# Builds and runs all tests under the sanitizers: address and undefined behaviour, then threads.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-dependencies.sh
for preset in asan tsan; do
  cmake --preset "$preset"
  cmake --build --preset "$preset" --parallel "$(nproc)"
  ctest --preset "$preset" -j2
done
