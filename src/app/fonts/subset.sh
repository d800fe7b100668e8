#!/usr/bin/env bash
# Makes the fonts beside this file: subset.sh FOLDER, where FOLDER holds NotoSans-Regular.ttf (2.004, of Debian's package
# fonts-noto-core) and Hack-Regular.ttf as the crate epaint_default_fonts has it. Needs fonttools (pip install fonttools).
#
# All that the interface writes and all that European names need, without hints for low resolutions, which double the
# size: the page loads a quarter of what whole fonts take.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
latin=U+0020-007E,U+00A0-017F,U+0218-021B,U+02BB-02DD,U+1E9E
greek_cyrillic=U+0370-03FF,U+0400-045F,U+0490-0491
# What the interface writes and the font of letters lacks: arrows, signs of arithmetic, shapes, exponents.
symbols=U+2190-2193,U+21BA,U+2202,U+2206,U+2208,U+2211,U+2212,U+221A,U+221E,U+2248,U+2260,U+2264,U+2265,U+2297,U+22C5
symbols+=,U+25A0,U+25A1,U+25B2,U+25B6,U+25B7,U+25BC,U+25C0,U+25C6,U+25CB,U+25CF,U+2070-207B,U+2080-208E,U+2032,U+2713
signs=U+2000-206F,U+2070-209F,U+20AC,U+2100-214F,U+2190-21FF,U+2200-22FF,U+2300-23FF,U+25A0-25FF
subset() {
    pyftsubset "$1" --unicodes="$2" --output-file="$3" --no-hinting --desubroutinize --layout-features=kern,ccmp \
        --name-IDs='*' --notdef-outline
}
subset "$1/NotoSans-Regular.ttf" "$latin,$greek_cyrillic,$signs" "$here/text.ttf"
# Letters come from the font above; this one has the symbols.
subset "$1/Hack-Regular.ttf" "$symbols" "$here/symbols.ttf"
