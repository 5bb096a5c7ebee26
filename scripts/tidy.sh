#!/usr/bin/env bash
# Runs clang-tidy (Debian's clang-tidy 14) with the checks of .clang-tidy on the files given, or on all sources.
set -euo pipefail
cd "$(dirname "$0")/.."

command -v clang-tidy >/dev/null || { echo "tidy: clang-tidy is missing; install it" >&2; exit 1; }
# Only to know how each file is compiled; clang cannot read headers that another compiler has precompiled.
cmake --preset release -B build-tidy -DCONCHOID_PCH=OFF >/dev/null
files=("$@")
[ ${#files[@]} -gt 0 ] || mapfile -t files < <(git ls-files 'src/*.cpp' 'apps/*.cpp' 'tests/*.cpp' 'bench/*.cpp' |
  grep -v -e '^tests/structure/consumer/' -e '/without_')
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -n 1 clang-tidy -p build-tidy --quiet --extra-arg=-Wno-unknown-warning-option
echo "tidy: ${#files[@]} files pass"
