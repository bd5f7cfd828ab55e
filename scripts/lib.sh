# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2034
# What scripts/demo, scripts/test and scripts/test-cuda share; sourced by them.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 1

# The CCCL (Thrust) that a machine without the CUDA toolkit gets: the one of CUDA 13.0.
cccl_wheel=nvidia-cuda-cccl==13.0.85

# What everything needs, as Debian and Ubuntu call it. A tool that is on the PATH needs no package.
build_packages=(g++ cmake ninja:ninja-build ca-certificates: libtbb-dev: libtinygltf-dev: libstb-dev:
  libopenexr-dev: libcli11-dev: nlohmann-json3-dev: libglm-dev:)

# With the time since the script began.
say() { printf '\n=== %d:%02d %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$*"; }
die() {
  printf '%s\n' "$@" >&2
  exit 1
}

installed() { [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]; }

# install_packages TOOL | TOOL:PACKAGE | PACKAGE: ...   Installs what is missing, or says what to install.
install_packages() {
  local item tool package missing=() as_root=()
  for item in "$@"; do
    tool=${item%%:*} package=${item#*:}
    if [[ $item == *: ]]; then
      package=$tool tool=
    fi
    if [[ -n $tool ]] && command -v "$tool" >/dev/null; then continue; fi
    if [[ -z $tool ]] && installed "$package"; then continue; fi
    missing+=("$package")
  done
  ((${#missing[@]})) || return 0

  if ! command -v apt-get >/dev/null; then
    printf '%s\n' "This machine has no apt-get, so nothing is installed. In the names of Debian's" \
      "packages, the build needs: ${missing[*]}" >&2
    return 0
  fi
  if ((EUID != 0)); then
    if command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
      as_root=(sudo)
    else
      die "Missing packages, and no right to install them. As root, run" \
        "  apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    fi
  fi
  say "Installing ${missing[*]}"
  "${as_root[@]}" apt-get -qq update
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -y -o Dpkg::Use-Pty=0 install --no-install-recommends "${missing[@]}" ||
    die "apt-get could not install: ${missing[*]}"
}

# fetch_wheel WHEEL DIR   Unpacks NVIDIA's wheel of CCCL below build/; fails when there is no way to it.
fetch_wheel() {
  [[ -d $2 ]] && return 0
  has_pip || return 1
  rm -rf "$2.part"
  PIP_ROOT_USER_ACTION=ignore python3 -m pip install --quiet --disable-pip-version-check --no-deps --only-binary=:all: \
    --target "$2.part" "$1" && mv "$2.part" "$2"
}

# Whether the build will find CCCL here; a guess as long as there is no CMake to search for it.
has_cccl() {
  if command -v cmake; then
    cmake -P scripts/search_cccl.cmake
  else
    [[ -n ${CCCL_ROOT-} || -d build/cccl || -d /usr/local/cuda ]] || command -v nvcc
  fi >/dev/null 2>&1
}
has_pip() { python3 -m pip --version >/dev/null 2>&1; }

# The presets have a version that is newer than the project's minimum.
check_cmake() {
  local version
  version=$(cmake --version | sed -n 's/^cmake version \([0-9.]*\).*/\1/p')
  if [[ $(printf '%s\n' 3.25 "$version" | sort -V | head -n 1) != 3.25 ]]; then
    die "The presets need CMake 3.25 or newer, and $(command -v cmake) is $version." \
      "Without presets, CMake 3.22 does: cmake -S . -B build/plain && cmake --build build/plain"
  fi
}

# The name of the first GPU that NVIDIA's driver finds, or nothing.
first_gpu() {
  local names
  names=$(nvidia-smi --query-gpu=name --format=csv,noheader 2>/dev/null) || return 0
  head -n 1 <<<"$names"
}

# Everything that a build needs, and the packages given.
prepare() {
  local pip=()
  has_cccl || has_pip || pip=(python3-pip:)
  install_packages "${build_packages[@]}" "${pip[@]}" "$@"
  check_cmake
  mkdir -p build
  has_cccl && return 0
  if [[ -n ${CCCL_ROOT-} ]]; then
    cmake -P scripts/search_cccl.cmake
    exit 1
  fi
  say "No Thrust on this machine: taking $cccl_wheel into build/cccl"
  has_pip || install_packages python3-pip:
  fetch_wheel "$cccl_wheel" build/cccl && return 0
  say "No package index in reach: CMake will fetch CCCL from GitHub"
  install_packages git
}

jobs=$(nproc)
