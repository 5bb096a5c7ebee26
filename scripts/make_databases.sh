#!/bin/sh
# Makes the trained regressors that come with the program: databases/*.forest, *.boosted and *.network from the specifications beside them.
# scripts/make_databases.sh [CONCHOID [WORK]] — WORK keeps the databases of runs (some 500 MB), to go on after a stop. Most of the time, more than
# an hour on two cores, goes into the first 11,355 of the 20,000 runs of world.toml; all of them bring no more (docs/prediction.md).
set -eu
cd "$(dirname "$0")/.."
conchoid=${1:-build/conchoid}
work=${2:-build/databases-work}
mkdir -p "$work"
for name in cube cube-tough cube-layers cube-grains cylinder cylinder-tough cylinder-layers cylinder-grains bar edge-crack edge-crack-across edge-crack-out armadillo; do
  "$conchoid" database generate "databases/$name.toml" --out "$work/$name.h5" --resume
done
# More runs of the same classes bring trees nothing but size (docs/prediction.md).
"$conchoid" database generate databases/world.toml --runs 2452 --out "$work/world.h5" --resume
"$conchoid" database generate databases/world.toml --runs 11355 --out "$work/world-large.h5" --resume

# Runs that go where networks lead, solved beside them: what these learn from their own errors (docs/prediction.md). The first leader
# has learned from solved runs alone, the second from its errors, too. led NAME LEADER RUNS SEED
led() {
  sed -e "s/^runs = .*/runs = $3/" -e "s/^seed = .*/seed = $4/" -e "s|^frames = .*|&\nled_by = \"$2\"|" databases/world.toml > "$work/$1.toml"
  "$conchoid" database generate "$work/$1.toml" --out "$work/$1.h5" --resume
}
set -- "$work/cube.h5" "$work/cylinder.h5" "$work/bar.h5"
"$conchoid" forest train "$work/world-large.h5" "$@" --features versatile --model network --out "$work/leader-1.network"
led world-led-1 leader-1.network 2987 8
"$conchoid" forest train "$work/world.h5" "$work/world-led-1.h5" "$@" --features versatile --model network --out "$work/leader-2.network"
led world-led-2 leader-2.network 2233 9

# Runs that none has seen, to find by what the spread of each is worth: NAME RUNS
unseen() {
  sed -e "s/^runs = .*/runs = $2/" -e 's/^seed = .*/seed = 99/' -e "s|^mesh = \"|&$PWD/databases/|" "databases/$1.toml" > "$work/$1-unseen.toml"
  "$conchoid" database generate "$work/$1-unseen.toml" --out "$work/$1-unseen.h5" --resume
}
for name in cube cylinder bar edge-crack edge-crack-across edge-crack-out; do unseen "$name" 60; done
unseen armadillo 24
unseen world 150

for name in cube cylinder bar edge-crack armadillo; do
  set -- "$work/$name.h5"
  for more in tough layers grains across out; do
    if [ -e "databases/$name-$more.toml" ]; then set -- "$@" "$work/$name-$more.h5"; fi
  done
  "$conchoid" forest train "$@" --features versatile --trees 25 --depth 12 --leaf 12 --out "$work/$name.forest"
  "$conchoid" forest train "$@" --features versatile --model boosted --trees 150 --depth 6 --rate 0.14 --out "$work/$name.boosted"
  "$conchoid" forest train "$@" --features versatile --model network --out "$work/$name.network"
done
set -- "$work/cube.h5" "$work/cylinder.h5" "$work/bar.h5"
"$conchoid" forest train "$work/world.h5" "$@" --features versatile --trees 12 --depth 18 --leaf 10 --out "$work/versatile.forest"
"$conchoid" forest train "$work/world.h5" "$@" --features versatile --model boosted --trees 300 --depth 6 --rate 0.07 --out "$work/versatile.boosted"
"$conchoid" forest train "$work/world-large.h5" "$work/world-led-1.h5" "$work/world-led-2.h5" "$@" --features versatile --model network --out "$work/versatile.network"

for name in cube cylinder bar edge-crack armadillo versatile; do
  if [ $name = versatile ]; then set -- "$work/world-unseen.h5"; else set -- "$work/$name"*-unseen.h5; fi
  for kind in forest boosted network; do
    "$conchoid" forest calibrate "$work/$name.$kind" "$@" --out "databases/$name.$kind"
  done
done
