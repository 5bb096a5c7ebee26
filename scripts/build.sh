#!/usr/bin/env bash
# Installs what is needed, configures and builds the release preset into build/. Further arguments go to the configuration.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-dependencies.sh
# A compiler takes up to 1 GB: no more of them than memory holds.
memory_gb=$(awk '/MemAvailable/ { print int($2 / 1048576) }' /proc/meminfo)
jobs=$(nproc)
[ "$memory_gb" -ge "$jobs" ] || jobs=$((memory_gb > 0 ? memory_gb : 1))
cmake --preset release "$@"
cmake --build --preset release --parallel "$jobs"
