#!/usr/bin/env bash
# Builds ODE in single precision from Debian's source package, for the program pbmpi_ode_single: `ode_single.sh [FOLDER]`.
# FOLDER (default: build/ode_single of the checkout) gets include, lib and the licence; then configure and build again (with
# -DPBMPI_ODE_SINGLE=FOLDER for another folder). Needs g++, cmake and dpkg-dev, no other rights. Does nothing if the folder
# has it. The source comes from the mirror of this machine's apt, or from DEBIAN_MIRROR; ODE_SOURCE: a folder in which it is
# unpacked already.
set -euo pipefail

[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^set/{/^set/d;s/^# \?//;p}' "$0"; exit 0; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
target=$(realpath -m "${1:-$root/build/ode_single}")
if [[ -f $target/lib/libode.a && -f $target/include/ode/ode.h ]]; then
  echo "ode_single.sh: $target has it"
  exit 0
fi
for tool in cmake g++ dpkg-source; do
  command -v $tool >/dev/null || { echo "ode_single.sh: $tool is missing; install Debian's cmake, g++ and dpkg-dev" >&2; exit 2; }
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
source_folder=${ODE_SOURCE:-}
if [[ -z $source_folder ]]; then
  # An apt of its own, which knows source packages whatever the machine's sources are.
  mirror=${DEBIAN_MIRROR:-$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | head -n 1)}
  [[ -n $mirror ]] || { echo "ode_single.sh: apt has no mirror; set DEBIAN_MIRROR or ODE_SOURCE" >&2; exit 2; }
  state=$work/apt
  mkdir -p "$state"/lists/partial "$state"/archives/partial
  : >"$state/status"
  . /etc/os-release
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $VERSION_CODENAME main" >"$state/sources.list"
  apt=(apt-get -qq -o APT::Sandbox::User="$(id -un)" -o Debug::NoLocking=1 -o Dir::State="$state" -o Dir::State::lists="$state/lists"
    -o Dir::State::status="$state/status" -o Dir::Cache="$state" -o Dir::Cache::archives="$state/archives"
    -o Dir::Etc::SourceList="$state/sources.list" -o Dir::Etc::SourceParts=/dev/null)
  (cd "$work" && "${apt[@]}" update && "${apt[@]}" source ode)
  source_folder=$(find "$work" -maxdepth 1 -type d -name 'ode-*')
fi
[[ -f $source_folder/CMakeLists.txt ]] || { echo "ode_single.sh: no source of ODE in '$source_folder'" >&2; exit 1; }

# As Debian builds its libode (-O2, collisions of cylinders by libccd), but in single precision and as a static library, whose
# libccd is the copy in ODE's source: Debian's computes in double precision.
cmake -S "$source_folder" -B "$work/build" -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O2 -DCMAKE_C_FLAGS=-O2 \
  -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_SHARED_LIBS=OFF -DODE_DOUBLE_PRECISION=OFF -DODE_WITH_LIBCCD=ON \
  -DODE_WITH_LIBCCD_SYSTEM=OFF -DODE_WITH_DEMOS=OFF -DODE_WITH_TESTS=OFF -DCMAKE_INSTALL_PREFIX="$target" >"$work/log" 2>&1 &&
  cmake --build "$work/build" --target install -j "$(nproc)" >>"$work/log" 2>&1 ||
  { tail -n 20 "$work/log" >&2; echo "ode_single.sh: ODE could not be built" >&2; exit 1; }
# ODE may be used under the LGPL 2.1 or later or under the BSD licence; libccd's is BSD.
install -m 644 "$source_folder"/LICENSE-BSD.TXT "$source_folder"/LICENSE.TXT "$source_folder"/COPYING "$target"
echo "ode_single.sh: $target has it; configure and build again, e.g. by jobs/build.sh"
