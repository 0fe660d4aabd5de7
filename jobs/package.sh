#!/usr/bin/env bash
# Makes the Debian packages of pbmpi in build/packages, from the release build: `jobs/package.sh [cmake options ...]`, e.g.
# -DPBMPI_PACKAGE_MAINTAINER="Name <address>". Then: `apt install ./build/packages/*.deb`. See docs/install.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs/install_packages.sh --packages
rm -f build/packages/*.deb
jobs/build.sh release "$@" -- --target packages
ls -l build/packages/*.deb
