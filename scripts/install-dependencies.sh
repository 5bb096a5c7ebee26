#!/usr/bin/env bash
# Installs what is needed on Debian 12: for the program and the demo (`program`), or for everything, tests and benchmarks
# included (`all`, the default). Asks nothing, changes nothing that is there already.
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libeigen3-dev libopenblas-dev libtbb-dev libfmt-dev libxxhash-dev libqhull-dev
  nlohmann-json3-dev libtomlplusplus-dev libcli11-dev libboost-dev
  libembree-dev libpng-dev       # CONCHOID_WITH_PICTURES
  libhdf5-dev libxgboost-dev     # CONCHOID_WITH_LEARNING
)
case ${1:-all} in
  program) ;;
  all)
    packages+=(
      libopenvdb-dev               # CONCHOID_WITH_VDB
      libopenmpi-dev openmpi-bin   # CONCHOID_WITH_MPI
      libgtest-dev libbenchmark-dev libassimp-dev
    ) ;;
  *) echo "install-dependencies: '$1' is not known; choose from program, all" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "install-dependencies: everything is installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "install-dependencies: run this as root, or install sudo" >&2; exit 1; }
  as_root=(sudo)
fi
echo "install-dependencies: installing ${missing[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
