#!/usr/bin/env bash
# Builds the page for release and serves it on this machine; sets up what that needs.
#
#   web/serve.sh [--port P]        (or PORT in the environment; default 8080)
#   web/serve.sh --build-only      leaves the page in dist/, ready to be published under any path
set -euo pipefail
cd "$(dirname "$0")/.."

port=${PORT:-8080}
build_only=
while [ $# -gt 0 ]; do
    case $1 in
        --port) port=${2:?--port wants a number}; shift 2 ;;
        --port=*) port=${1#*=}; shift ;;
        --build-only) build_only=1; shift ;;
        -h | --help) sed -n '2,5s/^# \{0,1\}//p' "$0"; exit ;;
        *) echo "Unknown option $1; see web/serve.sh --help" >&2; exit 2 ;;
    esac
done
if ! [[ $port =~ ^[1-9][0-9]{0,4}$ ]] || [ "$port" -gt 65535 ]; then
    echo "The port must be a number from 1 to 65535, not \"$port\"." >&2
    exit 2
fi
# The build takes minutes, so this is tried before it.
if [ -z "$build_only" ] && (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; then
    echo "Port $port is in use on this machine. Try another: web/serve.sh --port $((port % 65535 + 1))" >&2
    exit 1
fi
if ! command -v cargo >/dev/null; then
    echo "Rust is missing: install it from https://rustup.rs, then run this again." >&2
    exit 1
fi

# Trunk takes NO_COLOR=1, the usual form, for a mistake.
unset NO_COLOR
# Trunk runs offline so that it never downloads programs by itself; the crates are fetched before (all of
# them: Trunk asks cargo about every platform).
web/toolchain.sh cargo fetch --locked --quiet
trunk=(web/tools.sh web/toolchain.sh trunk)
echo "Building the page (5 to 10 minutes the first time on two cores, 2 after a change) …"
"${trunk[@]}" build --release --offline
echo "The page is in dist/:"
find dist -type f -name '*.wasm' -exec ls -l {} + | awk '{ printf "  %5.2f MB  %s\n", $5 / 1e6, $NF }'
if [ -n "$build_only" ]; then exit; fi

if command -v python3 >/dev/null; then exec python3 web/server.py "$port"; fi
# Trunk's own server; it watches the sources as well.
echo "Tautline is at http://127.0.0.1:$port/ (Ctrl+C stops it)"
exec "${trunk[@]}" serve --release --offline --no-autoreload --address 127.0.0.1 --port "$port"
