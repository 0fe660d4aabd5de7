#!/bin/bash
# Renders still pictures of a page made by "pbreport FILE --html PAGE" in headless Chromium.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/stills.sh [options] PAGE.html OUTDIR FRAME...

Writes OUTDIR/PAGE-FRAME.png for each recorded frame; frame 0 is the initial pose.

  --world N|all       world to show (default: the page's own choice)
  --size WxH          pixels (default 1200x675)
  --camera X,Y,Z,X,Y,Z  position and target of the camera [m]
  --bare              without legend and time
TEXT
}

fail() {
  echo "stills.sh: $1" >&2
  exit 2
}

size=1200x675
view="still=1"
while [[ $# -gt 0 && $1 == --* ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --bare) view+="&bare=1"; shift; continue ;;
  esac
  [[ $# -ge 2 ]] || fail "$1 wants a value; see --help"
  case $1 in
    --world) view+="&world=$2" ;;
    --camera) view+="&camera=$2" ;;
    --size) size=$2 ;;
    *) fail "unknown option '$1'; see --help" ;;
  esac
  shift 2
done
[[ $# -ge 3 ]] || { usage >&2; exit 2; }
[[ $size =~ ^[0-9]+x[0-9]+$ ]] || fail "--size $size: it must look like 1200x675"
page=$1 out=$2
shift 2
[[ -r $page ]] || fail "$page: cannot be read; make it with: pbreport FILE --html $page"
browser=$(command -v chromium || command -v google-chrome) || fail "no chromium found; install it (Debian: chromium)"
mkdir -p "$out"

profile=$(mktemp -d)
trap 'rm -rf "$profile"' EXIT
for frame in "$@"; do
  [[ $frame =~ ^[0-9]+$ ]] || fail "frame '$frame': it must be a number"
  picture=$out/$(basename "$page" .html)-$(printf %03d "$((10#$frame))").png
  "$browser" --headless --no-sandbox --disable-quic --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --disable-dev-shm-usage --use-angle=swiftshader \
    --enable-unsafe-swiftshader --hide-scrollbars --force-device-scale-factor=1 --user-data-dir="$profile" \
    --window-size="${size/x/,}" --screenshot="$(realpath "$out")/$(basename "$picture")" \
    "file://$(realpath "$page")#frame=$frame&$view" >"$profile/log" 2>&1 || true
  [[ -s $picture ]] || { cat "$profile/log" >&2; echo "stills.sh: $picture: not rendered" >&2; exit 1; }
  echo "$picture"
done
