#!/usr/bin/env bash
# Builds the benchmarks, runs them and writes bench/results/DATE-MACHINE.json and the table bench/results/README.md.
# Further arguments go to the benchmark program (--benchmark_filter=…). BUILD names another build folder, MACHINE another name.
#   scripts/bench.sh --goals [--only WORD…]    the table of goals for speed and what is reached (bench/goals.py), nothing written
set -euo pipefail
cd "$(dirname "$0")/.."

build=${BUILD:-build}
if [ ! -f "$build/CMakeCache.txt" ]; then
  scripts/install-dependencies.sh
  cmake -G Ninja -S . -B "$build" -DCMAKE_BUILD_TYPE=Release
fi
cmake -B "$build" -DCONCHOID_BUILD_BENCH=ON
cmake --build "$build" --target conchoid_bench calibrate

if [ "${1:-}" = --goals ]; then
  cmake --build "$build" --target conchoid
  exec python3 bench/goals.py "$build" "${@:2}"
fi

processor=$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -1)
machine=${MACHINE:-$(printf '%s-%s-cores' "${processor:-$(uname -m)}" "$(nproc)" |
  tr '[:upper:]' '[:lower:]' | tr -cs 'a-z0-9\n' '-' | sed 's/^-//; s/-$//')}
result=bench/results/$(date +%F)-$machine.json
"$build/conchoid_bench" --benchmark_out="$result.part" --benchmark_out_format=json \
  --benchmark_context=processor="${processor:-unknown}",cores="$(nproc)",calibration="$("$build/calibrate" | cut -d' ' -f1)" "$@"
mv "$result.part" "$result"
python3 bench/compare.py --table "$result" > bench/results/README.md
echo "bench: $result"
