#!/usr/bin/env bash
# Makes the fonts beside this file: subset.sh FOLDER, where FOLDER holds Ubuntu-Light.ttf and Hack-Regular.ttf as the
# crate epaint_default_fonts has them. Needs fonttools (pip install fonttools).
#
# All that the interface writes and all that European names need, without hints for low resolutions, which double the
# size: the page loads a quarter of what whole fonts take.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
latin=U+0020-007E,U+00A0-024F,U+02BB-02DD,U+1E00-1EFF
greek_cyrillic=U+0370-03FF,U+0400-045F,U+0490-0491
signs=U+2000-206F,U+2070-209F,U+20AC,U+2100-214F,U+2190-21FF,U+2200-22FF,U+2300-23FF,U+25A0-25FF
features=kern,mark,mkmk,ccmp,locl
options=(--no-hinting --desubroutinize --layout-features="$features" --name-IDs='*' --notdef-outline)
pyftsubset "$1/Ubuntu-Light.ttf" --unicodes=$latin,$greek_cyrillic,$signs "${options[@]}" --output-file="$here/text.ttf"
# Letters come from the font above; this one has the symbols.
pyftsubset "$1/Hack-Regular.ttf" --unicodes=U+0020-007E,$signs "${options[@]}" --output-file="$here/symbols.ttf"
# The licence of the first font asks for another name of what is changed.
python3 - "$here/text.ttf" <<'PYTHON'
import sys
from fontTools.ttLib import TTFont
font = TTFont(sys.argv[1])
for record in font["name"].names:
    if record.nameID in (1, 4, 16):
        record.string = record.toUnicode() + " derivative Tautline"
font.save(sys.argv[1])
PYTHON
