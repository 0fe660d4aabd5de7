#!/usr/bin/env bash
# Unpacks Debian's arm64 packages that pbmpi is built on into a folder, for a cross build: `arm64_sysroot.sh FOLDER`. Nothing
# is installed on this machine, and no program of that architecture runs. Does nothing if the folder has them. DEBIAN_MIRROR
# names another mirror.
set -euo pipefail

root=$(realpath -m "$1")
packages=(libc6-dev libstdc++-12-dev libopenmpi-dev libhdf5-openmpi-dev libode-dev libeigen3-dev libfmt-dev
  libboost-program-options-dev libtomlplusplus-dev libpugixml-dev nlohmann-json3-dev libjs-three libjs-chart.js)
[[ -f $root/complete && $(<"$root/complete") == "${packages[*]}" ]] && exit 0

rm -rf "$root"
state=$root/apt
mkdir -p "$state"/lists/partial "$state"/archives/partial "$root"
: >"$state/status" # nothing is installed, so that apt fetches all that the packages need
. /etc/os-release
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] ${DEBIAN_MIRROR:-http://deb.debian.org/debian} $VERSION_CODENAME main" >"$state/sources.list"
apt=(apt-get -qq -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o APT::Install-Recommends=false -o APT::Sandbox::User=root
  -o Debug::NoLocking=1 -o Dir::State="$state" -o Dir::State::lists="$state/lists" -o Dir::State::status="$state/status"
  -o Dir::Cache="$state" -o Dir::Cache::archives="$state/archives" -o Dir::Etc::SourceList="$state/sources.list"
  -o Dir::Etc::SourceParts=/dev/null)
"${apt[@]}" update
"${apt[@]}" install -y --download-only "${packages[@]}" >/dev/null
for package in "$state"/archives/*.deb; do dpkg-deb -x "$package" "$root"; done
rm -rf "$state"
# Links that a package manager would make relative to the root that it installs to.
find "$root" -type l -lname '/*' | while read -r link; do
  ln -sfn "$(realpath -m --relative-to="$(dirname "$link")" "$root$(readlink "$link")")" "$link"
done
echo "${packages[*]}" >"$root/complete"
