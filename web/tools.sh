#!/usr/bin/env bash
# Runs a command with the programs it needs in the versions that this project wants: web/tools.sh CMD…
# These are cargo-deny for `cargo-deny`, Trunk and wasm-bindgen for all else. What PATH has is used if it fits; otherwise
# it is installed under target/tools, away from the user's own.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
tools=$root/target/tools

cargo_deny=0.20.2
trunk=0.21.14
# The program must be of exactly the library's version, or the page does not load.
wasm_bindgen=$(awk '/^name = "wasm-bindgen"$/ { getline; gsub(/[^0-9.]/, ""); print; exit }' "$root/Cargo.lock")

fits() { [ "$("$1" --version 2>/dev/null)" = "$1 $2" ]; }

# need PROGRAM VERSION CRATE MINUTES OPTION…: the options leave out what is not used here, and a debug
# build is fast enough at run time and three times faster to make.
need() {
    local program=$1 version=$2 crate=$3 minutes=$4
    shift 4
    if fits "$program" "$version"; then return; fi
    rm -f "$tools/bin/$program" # an older one there would hide one that fits
    if fits "$program" "$version"; then return; fi
    echo "Building $program $version into target/tools, once (about $minutes on two cores) …" >&2
    local quiet=()
    if ! [ -t 2 ]; then quiet=(--quiet); fi
    CARGO_TARGET_DIR=$tools/build cargo install "$crate" --version "$version" --root "$tools" --force \
        --debug --no-default-features ${quiet[@]+"${quiet[@]}"} "$@" >&2
    rm -rf "$tools/build"
}

export PATH="$tools/bin:$PATH"
if [ "${1-}" = cargo-deny ]; then
    need cargo-deny "$cargo_deny" cargo-deny "2 minutes" --locked
else
    # Trunk does not compile with newer dependencies than its own lock file names. One dependency that wasm-bindgen's
    # lock file names is gone from some mirrors.
    need trunk "$trunk" trunk "2 minutes" --locked
    need wasm-bindgen "$wasm_bindgen" wasm-bindgen-cli "1 minute" --bin wasm-bindgen
    export PATH="$root/web/bin:$PATH"
fi
exec "$@"
