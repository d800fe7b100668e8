#!/usr/bin/env bash
# Installs Debian or Ubuntu packages that a build or a test needs: web/packages.sh PKG…
# It acts only where that needs no password and removes nothing; otherwise it says what to do by hand and fails.
set -euo pipefail

by_hand() {
    echo "Please install by hand: $* ($reason)" >&2
    exit 1
}

reason="this machine has no apt-get; the names are Debian's"
command -v apt-get >/dev/null || by_hand "$@"

as_root=(env DEBIAN_FRONTEND=noninteractive)
if [ "$(id -u)" != 0 ]; then
    reason="neither root nor a sudo without a password is at hand; as root: apt-get install $*"
    sudo -n true 2>/dev/null || by_hand "$@"
    as_root=(sudo -n env DEBIAN_FRONTEND=noninteractive)
fi

echo "Installing $* …" >&2
# A new machine has no package lists, an old one lists files that are gone. Failing here is no reason to stop yet.
"${as_root[@]}" apt-get update -qq >&2 || true

reason="apt-get does not know every one of them here"
plan=$(apt-get install --simulate --no-install-recommends "$@" 2>&1) || { echo "$plan" >&2; by_hand "$@"; }
# rustc-web, for one, would push out a rustc or rustup that someone installed on purpose.
removed=$(sed -n 's/^Remv \([^ ]*\).*/\1/p' <<<"$plan" | tr '\n' ' ')
reason="apt-get would remove ${removed% } for it, which is yours to decide"
[ -z "$removed" ] || by_hand "$@"

reason="apt-get failed"
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "$@" >/dev/null || by_hand "$@"
