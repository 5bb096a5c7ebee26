#!/usr/bin/env bash
# Draws docs/images/materials.png: the cube of varying toughness, broken. Give the program, or build it first.
set -euo pipefail
cd "$(dirname "$0")/.."

conchoid=${1:-build/conchoid}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
for kind in layers grains noise; do
  "$conchoid" run "examples/$kind.toml" --quiet --out "$out/$kind"
done
"$conchoid" picture "$out/layers" "$out/grains" "$out/noise" --plain --explode 1.2 --width 2100 --height 820 --out docs/images/materials.png
