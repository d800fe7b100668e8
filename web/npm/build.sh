#!/usr/bin/env bash
# Builds the npm package of the core into target/npm/tautline/: web/npm/build.sh
# The module shares profile and most of its dependencies with the page's worker. To publish: npm pack or npm publish there.
set -euo pipefail
cd "$(dirname "$0")/../.."
package=target/npm/tautline
wasm=${CARGO_TARGET_DIR:-target}/wasm32-unknown-unknown/web-worker/js.wasm

web/toolchain.sh cargo build --profile web-worker --target wasm32-unknown-unknown --no-default-features --features js --bin js
rm -rf "$package"
mkdir -p "$package"
web/tools.sh wasm-bindgen "$wasm" --target web --no-typescript --remove-producers-section \
    --out-name tautline --out-dir "$package"
cp web/npm/{index.js,index.d.ts,node.js,README.md,example.html} LICENSE-MIT LICENSE-APACHE "$package"
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
sed "s/\"version\": \"0.0.0\"/\"version\": \"$version\"/" web/npm/package.json >"$package/package.json"
echo "The package is in $package/:"
find "$package" -type f -exec ls -l {} + | awk '{ printf "  %6.1f kB  %s\n", $5 / 1e3, $NF }'
