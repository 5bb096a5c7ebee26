#!/usr/bin/env bash
# Builds into build/: the program alone (`program`), or everything, tests and benchmarks included (`all`, the default).
# Installs what that needs. Further arguments go to the configuration.
set -euo pipefail
cd "$(dirname "$0")/.."

what=all
case ${1:-} in program | all) what=$1; shift ;; esac
scripts/install-dependencies.sh "$what"

# In one folder: what the program alone has compiled is kept when everything is built later.
if [ "$what" = all ]; then
  target=all
  options=(-DCONCHOID_BUILD_TESTS=ON -DCONCHOID_BUILD_BENCH=ON -DCONCHOID_WITH_VDB=ON)
else
  target=conchoid
  options=()
  [ -f build/CMakeCache.txt ] || options=(-DCONCHOID_BUILD_TESTS=OFF -DCONCHOID_BUILD_BENCH=OFF -DCONCHOID_WITH_VDB=OFF)
fi
# A compiler takes up to 1 GB: no more of them than memory holds.
memory_gb=$(awk '/MemAvailable/ { print int($2 / 1048576) }' /proc/meminfo)
jobs=$(nproc)
[ "$memory_gb" -ge "$jobs" ] || jobs=$((memory_gb > 0 ? memory_gb : 1))
cmake --preset release "${options[@]}" "$@"
cmake --build --preset release --target "$target" --parallel "$jobs"
