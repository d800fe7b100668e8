#!/usr/bin/env bash
# Starts the program in a real window, once per theme, on a screen of its own, and looks whether it draws.
# The pictures stay in target/pictures/.
set -euo pipefail
cd "$(dirname "$0")/.."

missing=()
for pair in Xvfb:xvfb xdotool:xdotool import:imagemagick; do
    if ! command -v "${pair%:*}" >/dev/null; then missing+=("${pair#*:}"); fi
done
# The program opens these by itself when it starts, so nothing else asks for them.
libraries=$(PATH=$PATH:/sbin:/usr/sbin ldconfig -p)
for pair in libX11.so.6:libx11-6 libX11-xcb.so.1:libx11-xcb1 libXcursor.so.1:libxcursor1 libXi.so.6:libxi6 \
    libxkbcommon-x11.so.0:libxkbcommon-x11-0 libGL.so.1:libgl1 libEGL.so.1:libegl1; do
    if [[ $libraries != *"${pair%:*} "* ]]; then missing+=("${pair#*:}"); fi
done
if [ ${#missing[@]} -gt 0 ]; then web/packages.sh "${missing[@]}" libgl1-mesa-dri; fi

# As a part of a test: with it comes the program, and nothing is compiled anew that the tests have compiled.
cargo test --no-run --test cli
program=${CARGO_TARGET_DIR:-target}/debug/tautline
pictures=target/pictures
mkdir -p "$pictures"

scratch=$(mktemp -d)
screen=""
window_of=""
tidy() {
    # Only what was started here, by its number.
    if [ -n "$window_of" ]; then kill "$window_of" 2>/dev/null || true; fi
    if [ -n "$screen" ]; then kill "$screen" 2>/dev/null || true; fi
    rm -rf "$scratch"
}
trap tidy EXIT

# The server picks a free display and says which. -noreset: otherwise it starts anew, and turns others away,
# each time the last client (xdotool, say) has left.
Xvfb -displayfd 3 -screen 0 1400x900x24 -nolisten tcp -noreset 3>"$scratch/display" 2>"$scratch/xvfb.log" &
screen=$!
for _ in {1..50}; do
    if [ -s "$scratch/display" ]; then break; fi
    sleep 0.2
done
[ -s "$scratch/display" ] || { cat "$scratch/xvfb.log" >&2; exit 1; }
DISPLAY=:$(cat "$scratch/display")
export DISPLAY
unset WAYLAND_DISPLAY # or the window opens on the desktop of whoever runs this

declare -A brightness
for theme in light dark; do
    # Its own data folder: neither the user's settings nor the other theme's are to be read or changed.
    TAUTLINE_THEME=$theme XDG_DATA_HOME=$scratch/$theme XDG_CONFIG_HOME=$scratch/$theme LIBGL_ALWAYS_SOFTWARE=1 \
        "$program" 2>"$scratch/$theme.log" &
    window_of=$!
    window=
    for _ in {1..150}; do
        window=$(xdotool search --onlyvisible --name Tautline 2>/dev/null | head -n1) && [ -n "$window" ] && break
        kill -0 "$window_of" 2>/dev/null || break
        sleep 0.2
    done
    if [ -z "$window" ]; then
        echo "No window in the theme $theme; the program said:" >&2
        cat "$scratch/$theme.log" >&2
        exit 1
    fi
    picture=$pictures/desktop-$theme.png
    # The window is there a little before its first picture is.
    for _ in {1..30}; do
        sleep 0.5
        import -window "$window" "$picture"
        colours=$(identify -format '%k' "$picture")
        if [ "$colours" -gt 10 ]; then break; fi
    done
    brightness[$theme]=$(identify -format '%[fx:round(100*mean)]' "$picture")
    echo "$picture: $colours colours, brightness ${brightness[$theme]} %"
    if [ "$colours" -le 10 ]; then
        echo "The window stays blank in the theme $theme." >&2
        cat "$scratch/$theme.log" >&2
        exit 1
    fi
    if ! kill -0 "$window_of" 2>/dev/null; then
        echo "The program ended by itself in the theme $theme:" >&2
        cat "$scratch/$theme.log" >&2
        exit 1
    fi
    kill "$window_of"
    wait "$window_of" || true
    window_of=
done

if [ "${brightness[light]}" -le "${brightness[dark]}" ]; then
    echo "The light theme is no lighter than the dark one." >&2
    exit 1
fi
