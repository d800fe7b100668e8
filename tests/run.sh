#!/usr/bin/env bash
# Runs every check, the same here and in CI, and installs what it needs: tests/run.sh [STEP…]
#
#   fmt          formatting                       test     cargo test
#   clippy       lints, native                    core     the numerics alone, without features
#   clippy-wasm  lints, browser                   web      the page and the npm package, built for release
#   doc          the documentation builds         e2e      both in a browser (needs web)
#   deny         licences of all dependencies     desktop  the program in a real window
set -euo pipefail
cd "$(dirname "$0")/.."
all=(fmt clippy clippy-wasm doc deny test core web e2e desktop)

step_fmt() { cargo fmt --check; }

step_clippy() { cargo clippy --all-targets -- -D warnings; }

step_clippy-wasm() {
    local with_wasm=(web/toolchain.sh --clippy) binary features
    for binary in tautline:app worker:compute js:js; do
        features=(--target wasm32-unknown-unknown --bin "${binary%:*}" --no-default-features --features "${binary#*:}")
        if "${with_wasm[@]}" cargo clippy --version >/dev/null 2>&1; then
            "${with_wasm[@]}" cargo clippy "${features[@]}" -- -D warnings
        else
            echo "SKIPPED: clippy for the browser, because the toolchain that can build for it has none. Compiler warnings only:"
            RUSTFLAGS="-D warnings" "${with_wasm[@]}" cargo check "${features[@]}"
        fi
    done
}

step_doc() { RUSTDOCFLAGS="-D warnings" cargo doc --no-deps; }

# Advisories are another workflow's: one that appears overnight must not fail a change that has nothing to do with it.
step_deny() { web/tools.sh cargo-deny --locked check licenses bans sources; }

# Without GNU parallel one test is passed over where a developer runs `cargo test` alone, but not here.
step_test() {
    if ! command -v parallel >/dev/null; then web/packages.sh parallel; fi
    TAUTLINE_TEST_PARALLEL=required cargo test
}

# Lints compile it with nothing but its own dependencies; its unit tests run with the others.
step_core() { cargo clippy --no-default-features --lib -- -D warnings; }

step_web() {
    web/serve.sh --build-only
    web/npm/build.sh
}

# A subshell, for the sake of `cd`.
step_e2e() (
    if ! command -v npm >/dev/null; then web/packages.sh nodejs npm; fi
    if [ "$(node -p 'parseInt(process.versions.node)')" -lt 20 ]; then
        echo "The browser tests need Node.js 20 or newer, not $(node --version): please install it by hand." >&2
        exit 1
    fi
    browser=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)}
    if [ -z "$browser" ]; then web/packages.sh chromium; fi
    cd web/e2e
    # npm ci starts from nothing every time; skip it where nothing has changed.
    if ! cmp -s package-lock.json node_modules/.installed; then
        npm ci --no-audit --no-fund
        cp package-lock.json node_modules/.installed
    fi
    # One file at a time: each has a browser that draws by software on all cores.
    node --test --test-concurrency=1
)

step_desktop() { tests/desktop.sh; }

steps=("$@")
if [ $# = 0 ]; then steps=("${all[@]}"); fi
for step in "${steps[@]}"; do
    if ! [[ " ${all[*]} " == *" $step "* ]]; then
        echo "No such step: $step. There are: ${all[*]}" >&2
        exit 2
    fi
done
if ! command -v cargo >/dev/null; then
    echo "Rust is missing: install it from https://rustup.rs, then run this again." >&2
    exit 1
fi

# A compiler takes up to 2 GB for the larger crates: on a small machine more of them at a time would swap.
if [ -z "${CARGO_BUILD_JOBS-}" ] && [ -r /proc/meminfo ]; then
    jobs=$(awk '/^MemAvailable/ { n = int($2 / 2e6); print n < 1 ? 1 : n }' /proc/meminfo)
    cores=$(nproc)
    export CARGO_BUILD_JOBS=$((jobs < cores ? jobs : cores))
fi

# An exit trap, not `if step`: that would switch `set -e` off inside the step.
current=""
summary=""
finish() {
    local status=$?
    if [ -n "$summary" ]; then printf '\n%b' "$summary"; fi
    if [ "$status" = 0 ]; then
        echo "All steps passed in $SECONDS s."
    elif [ -n "$current" ]; then
        echo "FAILED in step $current after $SECONDS s. Again, this step alone: tests/run.sh $current"
    fi
}
trap finish EXIT

for step in "${steps[@]}"; do
    current=$step begun=$SECONDS
    printf '\n=== %s (at %d s) ===\n' "$step" "$SECONDS"
    "step_$step"
    summary+=$(printf '  %-12s %4d s' "$step" $((SECONDS - begun)))'\n'
done
