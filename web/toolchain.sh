#!/usr/bin/env bash
# Runs a command with a Rust toolchain that can build for the browser (wasm32-unknown-unknown):
#
#   web/toolchain.sh [--clippy] CMD…        (--clippy: CMD also wants `cargo clippy`)
#
# Three routes, the first that is open: (a) the active toolchain has the target; (b) rustup adds it;
# (c) Debian's rustc-web builds the standard library from source, for machines that reach a Debian
# mirror but no toolchain server. (c) touches nothing but this one command's environment.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(dirname "$here")
target=wasm32-unknown-unknown
clippy=
if [ "${1-}" = --clippy ]; then clippy=1; shift; fi

# The folder's path is printed even where the target is absent, so look for what must be in it.
has_target() {
    local dir
    dir=$(rustc --print target-libdir --target "$target" 2>/dev/null) && compgen -G "$dir/libstd-*.rlib" >/dev/null
}

llvm() { /usr/bin/rustc -vV | sed -n 's/^LLVM version: \([0-9]*\).*/\1/p'; }

# Debian's compiler with its own source and linker, and new enough for us.
debian_is_ready() {
    [ -x /usr/bin/cargo ] && [ -x /usr/bin/rustc ] && [ -x "/usr/bin/wasm-ld-$(llvm)" ] || return 1
    [ -d "$(/usr/bin/rustc --print sysroot)/lib/rustlib/src/rust/library/std" ] || return 1
    local need have
    need=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' "$root/Cargo.toml")
    have=$(/usr/bin/rustc --version | cut -d' ' -f2)
    printf '%s\n' "$need" "$have" | sort -VC
}

rustup_adds_target() {
    command -v rustup >/dev/null || return 1
    echo "Adding the target $target to the active Rust toolchain …" >&2
    # If it cannot reach its server, rustup would try for minutes.
    local limit=()
    if command -v timeout >/dev/null; then limit=(timeout 30); fi
    RUST_BACKTRACE=0 RUSTUP_MAX_RETRIES=1 ${limit[@]+"${limit[@]}"} rustup target add "$target" >&2 && has_target
}

install_debian() {
    command -v apt-get >/dev/null || return 1
    echo "Trying Debian's Rust for the browser instead (140 MB) …" >&2
    # The linker must fit the compiler's LLVM, so its name is known only once the compiler is there.
    "$here/packages.sh" rustc-web cargo-web rust-web-src && "$here/packages.sh" "lld-$(llvm)" && debian_is_ready
}

# Instructions on two numbers at a time, for the elimination along two cables. Every browser that has WebGL 2 and is kept
# up to date has them.
export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS="-C target-feature=+simd128"

if has_target; then exec "$@"; fi
if ! debian_is_ready; then
    if rustup_adds_target; then exec "$@"; fi
    if ! install_debian; then
        echo "No Rust toolchain here can build $target. Usual remedy: rustup target add $target" >&2
        exit 1
    fi
fi
if [ -n "$clippy" ] && ! [ -x /usr/bin/cargo-clippy ]; then
    "$here/packages.sh" rust-web-clippy || true # the caller finds out by itself
fi

# Programs such as Trunk run `cargo` from PATH. Only the Rust programs go in front: all of /usr/bin
# there would shadow unrelated ones.
links=$root/target/tools/debian-rust
mkdir -p "$links"
for program in cargo rustc rustdoc cargo-clippy clippy-driver; do
    if [ -x "/usr/bin/$program" ]; then ln -sfn "/usr/bin/$program" "$links/$program"; fi
done
unset RUSTUP_TOOLCHAIN
# cargo searches its own bin folder first for subcommands unless PATH names it.
export PATH="$links:$PATH:${CARGO_HOME:-$HOME/.cargo}/bin"
export CARGO="$links/cargo" RUSTC="$links/rustc" RUSTDOC="$links/rustdoc"
# Building the standard library is unstable in Cargo; this lets a stable release do it.
export RUSTC_BOOTSTRAP=1 CARGO_UNSTABLE_BUILD_STD=std,panic_abort
CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=/usr/bin/wasm-ld-$(llvm)
export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER
exec "$@"
