#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Install the browser of the page's tests where that is possible: as root, on Debian and its relatives.
skip() {
  echo "no browser is installed: $1; tests of the viewer's page will be skipped" >&2
  exit 0
}
[ "$(id -u)" = 0 ] || skip "only root may install packages"
command -v apt-get >/dev/null || skip "there is no apt-get"
export DEBIAN_FRONTEND=noninteractive
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt-get install -qq -y --no-install-recommends chromium fonts-dejavu-core >"$log" 2>&1 && exit 0
{ apt-get update -qq && apt-get install -qq -y --no-install-recommends chromium fonts-dejavu-core; } >"$log" 2>&1 && exit 0
skip "$(tail -n 1 "$log")"
