"""Takes the names of functions out of the build's WebAssembly, a tenth of what the page loads: strip.py FOLDER.

wasm-bindgen always writes them, whatever the compiler's profile says, and Trunk has no option for it.
"""

import pathlib
import sys


def leb128(data, at):
    """An unsigned LEB128 number at a place, and the place after it."""
    number = shift = 0
    while True:
        byte = data[at]
        number |= (byte & 0x7F) << shift
        shift += 7
        at += 1
        if byte < 0x80:
            return number, at


def without_names(data):
    """The module without its custom section "name" (WebAssembly core specification, sections 5.5 and 7.4.1)."""
    if data[:4] != b"\0asm":
        raise ValueError("no WebAssembly")
    kept, at = bytearray(data[:8]), 8
    while at < len(data):
        size, begin = leb128(data, at + 1)
        end = begin + size
        custom = data[at] == 0
        length, name = leb128(data, begin) if custom else (0, begin)
        if not (custom and data[name : name + length] == b"name"):
            kept += data[at:end]
        at = end
    return bytes(kept)


for file in sorted(pathlib.Path(sys.argv[1]).glob("*.wasm")):
    file.write_bytes(without_names(file.read_bytes()))
