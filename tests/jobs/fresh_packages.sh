#!/usr/bin/env bash
# Makes the Debian packages of this checkout and tries them in a minimal Debian 12, which has nothing of the build:
# `tests/jobs/fresh_packages.sh [options of fresh_debian.sh]`. What is tried there is tests/jobs/try_packages.sh.
# Needs what fresh_debian.sh needs. Minutes, if the release build is there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
jobs/package.sh
tests/jobs/fresh_debian.sh --with build/packages "$@" tests/jobs/try_packages.sh /srv/packages
