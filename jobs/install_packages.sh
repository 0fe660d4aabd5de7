#!/usr/bin/env bash
# Installs what pbmpi needs on Debian 12: `jobs/install_packages.sh` to build and run it, with --packages also what
# jobs/package.sh needs, with --tests what the tests need, with --gates what tests/gates.sh needs. The engines that a build may
# lack, Bullet and MuJoCo (docs/steppers.md), come with the tests: who wants their steppers alone installs libbullet-dev or
# libmujoco-dev. Does nothing if all of it is there. Needs root, or sudo.
set -euo pipefail

packages=(g++ cmake ninja-build pkg-config git ca-certificates
  openmpi-bin libopenmpi-dev openssh-client libhdf5-openmpi-dev libode-dev libeigen3-dev libfmt-dev
  libboost-program-options-dev libtomlplusplus-dev libpugixml-dev nlohmann-json3-dev libjs-three libjs-chart.js
  pybind11-dev python3-dev python3-numpy python3-h5py)
package_packages=(dpkg-dev file gzip help2man valgrind)
test_packages=(libgtest-dev libgmock-dev libbenchmark-dev libbullet-dev libmujoco-dev python3 python3-pandas python3-mpi4py
  python3-matplotlib python3-selenium
  chromium chromium-driver hdf5-tools slurm-wlm munge procps shellcheck binutils doxygen qemu-user-static groff man-db
  bash-completion fish zsh debootstrap python3-autopep8 flake8 eslint node-v8-compile-cache)

gate_packages=(clang clang-format clang-tidy libclang-rt-14-dev g++-aarch64-linux-gnu)

if [[ ${1:-} == --packages ]]; then
  packages+=("${package_packages[@]}")
elif [[ ${1:-} == --tests ]]; then
  packages+=("${package_packages[@]}" "${test_packages[@]}")
elif [[ ${1:-} == --gates ]]; then
  packages+=("${package_packages[@]}" "${test_packages[@]}" "${gate_packages[@]}")
elif [[ $# -gt 0 ]]; then
  echo "usage: $0 [--packages|--tests|--gates]" >&2
  exit 2
fi

missing=()
for package in "${packages[@]}"; do
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true) == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  exit 0
fi

as_root=()
if [[ $EUID -ne 0 ]]; then
  command -v sudo >/dev/null || { echo "$0: run it as root; missing: ${missing[*]}" >&2; exit 2; }
  as_root=(sudo)
fi
echo "installing: ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
