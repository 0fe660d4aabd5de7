#!/usr/bin/env bash
# Tries a command as on a fresh machine: makes a minimal Debian 12, clones this checkout's HEAD into it, runs the command
# there as root, and removes everything: `tests/jobs/fresh_debian.sh jobs/quickstart.sh`. The exit code is the command's.
# Without a command it runs the two of README.md one after the other in that clone, and the tests meet the build and the
# files that the quick start left: this is what must pass before a release.
#   --keep          leaves the system's folder and prints its name
#   --with FOLDER   copies it to /srv in that system
# Needs root, a network, and Debian's debootstrap, git and util-linux. DEBIAN_MIRROR and DEBIAN_SECURITY_MIRROR name other
# mirrors; proxies and the like are taken from this machine's apt.
set -euo pipefail

fail() {
  echo "fresh_debian.sh: $1" >&2
  exit 2
}

keep=
with=()
while [[ ${1:-} == -* ]]; do
  case $1 in
    --keep) keep=yes ;;
    --with)
      [[ -d ${2:-} ]] || fail "--with: '${2:-}' is no folder"
      with+=("$2")
      shift
      ;;
    *) fail "usage: tests/jobs/fresh_debian.sh [--keep] [--with FOLDER] [COMMAND [ARGUMENTS...]], e.g. jobs/quickstart.sh" ;;
  esac
  shift
done
[[ $# -gt 0 ]] || set -- bash -c 'jobs/quickstart.sh && tests/run.sh'
[[ $EUID -eq 0 ]] || fail "debootstrap, mount and chroot need root"
for program in debootstrap git unshare; do
  command -v "$program" >/dev/null || fail "no $program; apt-get install debootstrap git util-linux"
done

suite=bookworm
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}
security_mirror=${DEBIAN_SECURITY_MIRROR:-http://deb.debian.org/debian-security}
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
git -C "$source_dir" rev-parse --quiet --verify HEAD >/dev/null || fail "$source_dir has no commit to clone"
[[ -z $(git -C "$source_dir" status --porcelain) ]] ||
  echo "fresh_debian.sh: what is not committed does not take part" >&2

root=$(mktemp -d "${TMPDIR:-/tmp}/fresh-debian-XXXXXX")
chmod 755 "$root"
clean_up() {
  if [[ -n $keep ]]; then
    echo "fresh_debian.sh: left $root" >&2
  else
    rm -rf --one-file-system "$root"
  fi
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

eval "$(apt-config shell http_proxy Acquire::http::Proxy https_proxy Acquire::https::Proxy)"
export http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}"
debootstrap --variant=minbase "$suite" "$root" "$mirror" >"$root.log" 2>&1 || {
  tail -n 20 "$root.log" >&2
  rm -f "$root.log"
  fail "debootstrap failed"
}
rm -f "$root.log"

# What a machine gets from its network and its installer.
cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
cat >"$root/etc/apt/sources.list" <<TEXT
deb $mirror $suite main
deb $mirror $suite-updates main
deb $security_mirror $suite-security main
TEXT
apt-config dump Acquire | grep -v '^Acquire::IndexTargets' >"$root/etc/apt/apt.conf.d/90host"
# There is no init: packages must not start their daemons.
printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d"
chmod 755 "$root/usr/sbin/policy-rc.d"

git clone --quiet --no-hardlinks "$source_dir" "$root/srv/pbmpi"
[[ ${#with[@]} -eq 0 ]] || cp -r "${with[@]}" "$root/srv/"

# A mount and a process namespace of its own: mounts and stray processes end with it, however it ends. No exec at the
# end of the inner scripts: a shell stays to reap.
# shellcheck disable=SC2016  # expanded by the inner shells
unshare --mount --pid --fork --kill-child bash -c '
  set -e
  root=$1
  shift
  mount -t proc proc "$root/proc"
  mount --rbind /sys "$root/sys"
  mount --rbind /dev "$root/dev"
  mount -t tmpfs tmpfs "$root/dev/shm"
  chroot "$root" /usr/bin/env -i HOME=/root TERM=dumb LANG=C.UTF-8 \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
    bash -c "cd /srv/pbmpi && \"\$@\"" bash "$@" || exit
' bash "$root" "$@" &
child=$!
trap 'kill -KILL "$child" 2>/dev/null; wait "$child" 2>/dev/null; exit 130' INT
trap 'kill -KILL "$child" 2>/dev/null; wait "$child" 2>/dev/null; exit 143' TERM
wait "$child"
