#!/usr/bin/env bash
# Builds the program and fractures a cube twice: solved by boundary elements, and predicted by a small forest that was trained
# a moment before on other loads. Ends with the numbers of `compare` and the name of a picture of both. On a fresh machine the
# program is built without OpenVDB, which the demo does not need; scripts/build.sh adds it, the tests and the benchmarks.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/build.sh program
conchoid=build/conchoid
out=build/demo
rm -rf "$out"
mkdir -p "$out"

step() { printf '\n== %s\n' "$*"; }

step "150 runs of the cube under random loads"
"$conchoid" database generate examples/cube-database.toml --runs 150 --out "$out/cube.h5"

step "a forest that learns how cracks open from them"
"$conchoid" forest train "$out/cube.h5" --out "$out/cube.forest" --trees 50 --depth 10

step "a load that the forest has not seen, solved by boundary elements"
"$conchoid" run examples/cube-30.toml --out "$out/bem"

step "the same, predicted from frame 2 on"
"$conchoid" run examples/cube-30.toml --method forest --database "$out/cube.forest" --out "$out/forest"

step "how far the prediction is from the solution"
"$conchoid" compare "$out/bem" "$out/forest"

step "both side by side"
"$conchoid" picture "$out/bem" "$out/forest" --explode 0.4 --out "$out/cube.png"
