"""Draws the equations of the app's Theory window: for each entry of EQUATIONS a PNG to look at, and an .ink
file with the same pixels for the app, both beside this file.

    python3 -m venv venv && venv/bin/pip install matplotlib pillow
    venv/bin/python render.py

A PNG is a mask: 4-bit gray, 0 where there is nothing and 15 where ink covers the whole pixel. The app paints it in the
colour of its text. Letters are those of docs/theory.md.
"""

import io
import itertools
import pathlib
import struct
import zlib

import matplotlib
import numpy
from matplotlib.figure import Figure
from PIL import Image

# Pixels per point of the app's screen: sharp up to three pixels per point.
SCALE = 3
# In points of the screen.
FONT_SIZE = 15.0
# No equation may be wider, in points: it would not fit a phone.
WIDEST = 310
# Of the 16 levels of gray: every third. Edges stay smooth, and the files are smaller by a quarter.
STEP = 3
# Between the lines of one equation, in points.
LINE_GAP = 7


def rows(first, second):
    """Two rows between brackets; mathtext has no matrices."""
    return rf"\left[\genfrac{{}}{{}}{{0}}{{0}}{{{first}}}{{{second}}}\right]"


SIGNS = rows(r"1\quad\!\!{-}1", r"{-}1\quad\!\!1")

# Each a list of lines.
EQUATIONS = {
    "stretch": [r"\lambda = \dfrac{|r_{k+1} - r_k|}{l}\,,\qquad l = \dfrac{L}{n}"],
    "axial_law": [
        r"N(\lambda) = \frac{1}{2}\,EA\,(\lambda^3 - \lambda)\qquad\mathrm{(Green)}",
        r"N(\lambda) = EA\,(\lambda - 1)\qquad\mathrm{(engineering)}",
    ],
    "flow_speed": [r"w_0 = -k\,\dot{l}\,,\qquad w_1 = -(k+1)\,\dot{l}"],
    "mass": [r"M = \dfrac{\mu\,l}{6}\," + rows(r"2\quad 1", r"1\quad 2") + r"\otimes I_2"],
    "flow": [
        r"C = 2\mu\," + rows(r"{-}a\quad a", r"{-}b\quad b") + r"\otimes I_2",
        r"a = \dfrac{w_0}{3} + \dfrac{w_1}{6}\,,\qquad b = \dfrac{w_0}{6} + \dfrac{w_1}{3}",
    ],
    "flow_stiffness": [
        r"K_\mathrm{dyn} = \mu\," + rows(r"{-}a'\quad a'", r"{-}b'\quad b'") + r"\otimes I_2",
        r"\qquad -\;\dfrac{\mu}{l}\,\dfrac{w_0^2 + w_0 w_1 + w_1^2}{3}\," + SIGNS + r"\otimes I_2",
        r"a' = \dfrac{\dot{w}_0}{3} + \dfrac{\dot{w}_1}{6}\,,\qquad b' = \dfrac{\dot{w}_0}{6} + \dfrac{\dot{w}_1}{3}",
    ],
    "shape": [
        r"t_k = P + \left(0,\; w\,l\,(k + \frac{1}{2})\right)",
        r"r_{k+1} = r_k + l\,\lambda_k\,\dfrac{t_k}{|t_k|}\,,\qquad N(\lambda_k) = |t_k|",
    ],
    "balance": [r"\sum_i\; P_i = (0,\; m\,g)"],
    "tension_law": [
        r"|P_i| = T_i(x, y) = \mathrm{hypot}\,(\,h_0 + h_x\,x + h_y\,y\,,",
        r"\qquad\qquad\qquad\qquad\qquad\quad v_0 + v_x\,x + v_y\,y\,)",
    ],
    "motion": [
        r"F(z, \sigma) = 0\,,\qquad F_z\,z' = -F_\sigma",
        r"F_z\,z'' = -\left(F_{\sigma\sigma} + 2\,F_{z\sigma}\,z' + F_{zz}\,[z', z']\right)",
    ],
    "rates": [r"\dot{L} = v\,L'\,,\qquad \ddot{L} = v^2\,L''"],
    "elastic": [r"K_\mathrm{el} = \dfrac{1}{l}\," + rows(r"A\quad{-}A", r"{-}A\quad A")],
    "tangent": [r"A = \dfrac{N}{\lambda}\,(I - e\,e^\mathrm{T}) + \dfrac{dN}{d\lambda}\,e\,e^\mathrm{T}"],
    "secant": [r"A = \dfrac{N}{\lambda}\,I"],
    "vibration": [
        r"M\,\ddot{q} + (C + \alpha M + \beta K_\mathrm{el})\,\dot{q}",
        r"\qquad\quad +\;(K_\mathrm{el} + K_\mathrm{dyn})\,q = 0",
    ],
    "eigenvalues": [
        r"[\;\lambda^2 M + \lambda\,(C + \alpha M + \beta K_\mathrm{el})",
        r"\qquad\quad +\;K_\mathrm{el} + K_\mathrm{dyn}\;]\;X = 0\,,\quad q = X\,e^{\lambda t}",
    ],
    "critical": [r"v_\mathrm{crit} = \inf\,\{\,v > 0 :\; \max_j\,\mathrm{Re}\,\lambda_j(v) > 0\,\}"],
    "frequency": [r"f = \dfrac{|\mathrm{Im}\,\lambda|}{2\pi}"],
    "determinant": [r"\det Q(\mathrm{i}\omega,\, v) = 0"],
    "reeled_in": [r"\mathrm{Re}\,\lambda \approx -\dfrac{\dot{L}}{2L}"],
    "damped": [r"\mathrm{Re}\,\lambda \approx -\frac{1}{2}\left(\alpha + \dfrac{\dot{L}}{L}\right)"],
    "wave_speed": [r"c = \sqrt{\dfrac{N}{\lambda\,\mu}}"],
}


def line_mask(line):
    """The ink of a line as an array of bytes: cut to what is drawn above and below, and to the right."""
    figure = Figure(figsize=(8, 2))
    figure.text(0.02, 0.5, f"${line}$", size=FONT_SIZE, color="black", va="center")
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=72 * SCALE, facecolor="white")
    ink = 255 - numpy.asarray(Image.open(picture).convert("L")).astype(float)
    drawn_rows, drawn_columns = numpy.flatnonzero(ink.max(axis=1)), numpy.flatnonzero(ink.max(axis=0))
    return ink[drawn_rows[0]:drawn_rows[-1] + 1, :drawn_columns[-1] + 1]


def mask(lines):
    """The ink of an equation, its lines one below the other."""
    masks = [line_mask(line) for line in lines]
    width = max(ink.shape[1] for ink in masks)
    pile = []
    for ink in masks:
        pile += [numpy.zeros((LINE_GAP * SCALE, width)), numpy.pad(ink, ((0, 0), (0, width - ink.shape[1])))]
    ink = numpy.vstack(pile[1:])
    ink = ink[:, numpy.flatnonzero(ink.max(axis=0))[0]:]
    return STEP * numpy.round(ink / (17 * STEP)).astype(numpy.uint8)


def png(levels):
    """A PNG file of 4-bit gray."""
    height, width = levels.shape
    pairs = numpy.pad(levels, ((0, 0), (0, width % 2)))
    packed = pairs[:, 0::2] << 4 | pairs[:, 1::2]
    # A row begins with its filter: none.
    rows = numpy.pad(packed, ((0, 0), (1, 0))).tobytes()

    compressor = zlib.compressobj(level=9, memLevel=9)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", width, height, 4, 0, 0, 0, 0)
    body = chunk(b"IHDR", header) + chunk(b"IDAT", compressor.compress(rows) + compressor.flush()) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body


def runs(levels):
    """The same as runs of equal pixels, as the app holds it: width and height as 16-bit numbers, high byte first, then
    a byte for each run: its level in the upper four bits, its length less one in the lower four.

    The page is compressed as a whole, which makes it smaller than pictures that are compressed one by one.
    """
    height, width = levels.shape
    body = bytearray()
    for level, same in itertools.groupby(levels.flatten().tolist()):
        length = len(list(same))
        body += bytes(level << 4 | min(16, length - start) - 1 for start in range(0, length, 16))
    return struct.pack(">HH", width, height) + bytes(body)


def main():
    matplotlib.rcParams["mathtext.fontset"] = "cm"
    total = 0
    for name, lines in EQUATIONS.items():
        ink = mask(lines)
        width = ink.shape[1] / SCALE
        if width > WIDEST:
            raise SystemExit(f"{name} is {width:.0f} points wide; allowed are {WIDEST}")
        file = pathlib.Path(__file__).with_name(f"{name}.png")
        file.write_bytes(png(ink))
        file.with_suffix(".ink").write_bytes(runs(ink))
        total += file.stat().st_size
        print(f"{name}: {width:.0f} x {ink.shape[0] / SCALE:.0f} points, {file.stat().st_size} bytes")
    print(f"{total} bytes together")


if __name__ == "__main__":
    main()
