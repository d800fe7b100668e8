#!/usr/bin/env bash
# Draws web/icons/*.png from web/icon.svg with headless Chromium. The pictures are committed, so only a change of
# icon.svg needs this: web/icons.sh
set -euo pipefail
cd "$(dirname "$0")"
browser=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome)}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Systems cut these into shapes of their own: the background fills the square, and the drawing keeps to the circle of
# 80 % that every shape leaves.
sed -e 's| rx="12" fill="#17324d"/>| fill="#17324d"/><g transform="translate(9 9) scale(.72)">|' \
    -e 's|^</svg>|</g></svg>|' icon.svg > "$work/full.svg"
cp icon.svg "$work/round.svg"

# draw SHAPE PIXELS NAME
draw() {
    echo "<style>body { margin: 0 } img { display: block; width: 100vw }</style><img src=\"$1.svg\">" > "$work/$1.html"
    "$browser" --headless --no-sandbox --hide-scrollbars --force-device-scale-factor=1 \
        --default-background-color=00000000 --window-size="$2,$2" --screenshot="$work/picture.png" "file://$work/$1.html"
    mv "$work/picture.png" "icons/$3.png"
}
draw round 192 icon-192
draw round 512 icon-512
draw full 512 maskable-512
draw full 180 apple-touch-icon
