"""Draw the tiles of the recipes in this folder, one pixel one knot, in the colours of the shipped wool list.

    python examples/recipes/draw_tiles.py [FOLDER]

A drawing is an array of letters, one for each yarn. Straight figures are conditions on the coordinates from the centre
of the drawing, in knots; small figures are drawn letter by letter; curves are drawn five times as fine, and each knot
takes the commonest letter of its 5 x 5.
"""

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

WOOL = {
    "R": "9e2b25",  # madder red
    "D": "6b1a1f",  # dark red
    "N": "1b2442",  # indigo navy
    "B": "34568b",  # mid blue
    "L": "8fabc4",  # light blue
    "I": "efe6d0",  # ivory
    "C": "b98f5e",  # camel
    "W": "5c3d28",  # walnut brown
    "K": "1d1815",  # near-black
    "Y": "e3c04a",  # weld yellow
    "G": "c0872b",  # gold
    "S": "7f8b5b",  # sage green
    "F": "2f4a34",  # dark green
    "P": "c9807b",  # rose
    "T": "b5532f",  # terracotta
}
LETTERS = "".join(WOOL)
FINE = 5

Sheet = NDArray[np.uint8]
"""Letters as codes of ASCII, rows x columns."""
Points = NDArray[np.complex128]


def sheet(height: int, width: int, ground: str) -> Sheet:
    """A sheet of one colour."""
    return np.full((height, width), ord(ground), dtype=np.uint8)


def axes(drawn: Sheet, row: float | None = None, column: float | None = None) -> tuple[NDArray[np.float64], ...]:
    """Distances of each knot from a point, by default the centre: to the right, and down."""
    rows, columns = np.indices(drawn.shape)
    middle = (len(drawn) - 1) / 2 if row is None else row, (drawn.shape[1] - 1) / 2 if column is None else column
    return np.asarray(columns - middle[1], dtype=float), np.asarray(rows - middle[0], dtype=float)


def put(drawn: Sheet, where: NDArray[np.bool_] | np.bool_, colour: str) -> None:
    """Colour the knots of a condition."""
    drawn[where] = ord(colour)


def art(text: str) -> Sheet:
    """A figure drawn letter by letter; a point is no knot."""
    lines = text.strip("\n").split("\n")
    width = max(map(len, lines))
    return np.array([[ord(letter) for letter in line.ljust(width, ".")] for line in lines], dtype=np.uint8)


def whole(left: Sheet) -> Sheet:
    """A figure from its left half with the middle column."""
    return np.concatenate([left, left[:, -2::-1]], axis=1)


def stamp(drawn: Sheet, figure: Sheet, row: int, column: int) -> None:
    """Draw a figure with its middle at a knot; what reaches over an edge is left out."""
    top, left = row - figure.shape[0] // 2, column - figure.shape[1] // 2
    for i, j in np.argwhere(figure != ord(".")):
        if 0 <= top + i < drawn.shape[0] and 0 <= left + j < drawn.shape[1]:
            drawn[top + i, left + j] = figure[i, j]


def recoloured(figure: Sheet, change: dict[str, str]) -> Sheet:
    """The figure with other colours."""
    made = figure.copy()
    for old, new in change.items():
        made[figure == ord(old)] = ord(new)
    return made


def save(drawn: Sheet, path: Path) -> None:
    """Write a drawing as PNG with a palette."""
    used = [letter for letter in LETTERS if (drawn == ord(letter)).any()]
    table = np.zeros(256, dtype=np.uint8)
    table[[ord(letter) for letter in used]] = np.arange(len(used))
    picture = Image.fromarray(table[drawn], mode="P")
    picture.putpalette([channel for letter in used for channel in bytes.fromhex(WOOL[letter])])
    picture.save(path, optimize=True)
    print(f"{path.name}: {drawn.shape[1]} x {drawn.shape[0]} knots, {path.stat().st_size} bytes")


# Turkmen, Tekke: rows of quartered guls joined by lines, small guls between them

CLOVER = art("""
..N..
.N.N.
N.N.N
.NNN.
..N..
""")


def tekke_field() -> Sheet:
    """One large gul with quarters of four small ones."""
    drawn = sheet(49, 62, "R")
    x, y = axes(drawn)
    ax, ay = abs(x), abs(y)
    put(drawn, ay < 0.6, "N")
    put(drawn, ax < 1, "N")
    gul = np.maximum.reduce([ax / 25.5, ay / 17.4, (np.floor(ax / 2) * 2 / 25.5 + ay / 17.4) / 1.42])
    put(drawn, gul <= 1, "N")
    put(drawn, gul <= 0.94, "I")
    light = x * y >= 0
    put(drawn, (gul <= 0.86) & light, "T")
    put(drawn, (gul <= 0.86) & ~light, "N")
    put(drawn, (gul <= 0.94) & (ay < 0.6), "I")
    for side in (1, -1):
        for column, row in ((8, 11), (16, 8), (18, 3)):
            stamp(drawn, recoloured(CLOVER, {"N": "I"}), 24 - row, 30 + (column if side > 0 else 1 - column))
            stamp(drawn, recoloured(CLOVER, {"N": "I"}), 24 + row, 30 + (column if side > 0 else 1 - column))
    core = np.maximum.reduce([ax / 10.5, ay / 7.4, (ax / 10.5 + ay / 7.4) / 1.5])
    put(drawn, core <= 1, "I")
    put(drawn, (core <= 0.86) & light, "D")
    put(drawn, (core <= 0.86) & ~light, "R")
    heart = ax / 5.5 + ay / 4.4
    put(drawn, heart <= 1.12, "I")
    put(drawn, heart <= 0.78, "N")
    put(drawn, heart <= 0.3, "Y")
    u, v = 31 - ax, 24.5 - ay
    small = u / 11 + v / 9
    put(drawn, (small > 1) & (small < 1.6) & (abs(u / 11 - v / 9) < 0.14), "N")
    put(drawn, (small > 1.34) & (small < 1.6) & (abs(u / 11 - v / 9) < 0.36), "N")
    put(drawn, ((u < 1) & (v < 14)) | ((v < 0.6) & (u < 17)), "N")
    put(drawn, ((u < 2.6) & (v > 11.5) & (v < 14)) | ((v < 2.2) & (u > 14) & (u < 17)), "N")
    put(drawn, small <= 1, "N")
    put(drawn, small <= 0.84, "I")
    put(drawn, small <= 0.62, "D")
    put(drawn, small <= 0.3, "Y")
    return drawn


def tekke_border() -> Sheet:
    """An octagon with a star, and a cross of horns; both symmetric about the diagonals."""
    halves = []
    for kind in "AB":
        drawn = sheet(24, 24, "D")
        x, y = axes(drawn)
        ax, ay = abs(x), abs(y)
        radius = np.maximum.reduce([ax, ay, (ax + ay) / 1.4])
        if kind == "A":
            for limit, colour in ((11, "N"), (10, "I"), (8.6, "R")):
                put(drawn, radius <= limit, colour)
            put(drawn, (np.minimum(ax, ay) < 1) & (radius < 8.6), "I")
            put(drawn, (abs(ax - ay) < 0.6) & (radius < 8.6), "N")
            put(drawn, ax + ay <= 5, "N")
            put(drawn, ax + ay <= 3, "Y")
        else:
            put(drawn, (np.minimum(ax, ay) < 1) & (np.maximum(ax, ay) < 11), "I")
            put(drawn, (np.minimum(ax, ay) < 4) & (abs(np.maximum(ax, ay) - 9.5) < 1), "I")
            put(drawn, (abs(np.minimum(ax, ay) - 3.5) < 1) & (abs(np.maximum(ax, ay) - 8) < 1.6), "I")
            put(drawn, (abs(ax - ay) < 0.6) & (radius < 9), "T")
            put(drawn, ax + ay <= 7, "I")
            put(drawn, ax + ay <= 5, "N")
            put(drawn, ax + ay <= 2, "T")
        halves.append(drawn)
    return np.concatenate(halves, axis=1)


def zigzag(high: int, ground: str, line: str, dot: str) -> Sheet:
    """A guard: a zigzag line with dots, as long as it is high."""
    drawn = sheet(high, 2 * high - 2, ground)
    rows, columns = np.indices(drawn.shape)
    wave = abs(columns - (high - 1))
    put(drawn, rows == wave, line)
    put(drawn, (rows == wave + 1), line)
    for column, row in ((high - 1, high - 2), (0, 1)):
        put(drawn, (abs(columns - column) <= (1 if high > 6 else 0)) & (abs(rows - row) < 1), dot)
    return drawn


# Caucasian, Kazak: stars with hooks on a red field, a border of leaves and cups on ivory

STAR = art("""
....N....
...NYN...
.NNYYYNN.
.NYYRYYN.
NYYRIRYYN
.NYYRYYN.
.NNYYYNN.
...NYN...
....N....
""")
GOAT = art("""
I.........I
.I.......II
.I......III
IIIIIIIIII.
.IIIIIIIII.
.II....II..
.I......I..
.I......I..
""")
HOOK = art("""
HHHHH
H...H
HH..H
....H
HHHHH
""")
COMB = art("""
L.L.L.L.L
L.L.L.L.L
LLLLLLLLL
....L....
""")


def quartered(drawn: Sheet) -> Sheet:
    """The sheet with its upper left quarter reflected into the others."""
    height, width = drawn.shape
    upper = np.concatenate([drawn[:, : width - width // 2], drawn[:, : width // 2][:, ::-1]], axis=1)
    return np.concatenate([upper[: height - height // 2], upper[: height // 2][::-1]])


def kazak_field(middle: bool = False) -> Sheet:
    """A star of eight points about an octagon with hooks; three fill the field, the middle one in other colours."""
    drawn = sheet(122, 184, "R")
    star, ground, bead, hook = ("I", "N", "R", "T") if middle else ("B", "F", "Y", "I")
    x, y = axes(drawn)
    ax, ay = abs(x), abs(y)
    step = np.floor(ax / 3) * 3
    octagon = np.maximum.reduce([ax / 88, ay / 57.5, (step / 88 + ay / 57.5) / 1.42])
    for limit, colour in ((1, "K"), (0.975, "I"), (0.945, "K")):
        put(drawn, octagon <= limit, colour)
    checked = (np.floor((ax + 4) / 8) + np.floor((ay + 3) / 6)) % 2 == 0
    put(drawn, (octagon <= 0.925) & checked, bead)
    put(drawn, (octagon <= 0.925) & ~checked, "L" if middle else "R")
    put(drawn, octagon <= 0.855, "K")
    put(drawn, octagon <= 0.84, ground)
    for row, column in ((22, 58), (43, 30), (12, 68), (34, 47)):
        stamp(drawn, recoloured(HOOK, {"H": "L" if middle else "Y"}), 60 - row, 91 - column)
    for grown, colour in ((2, "K"), (0, "Y" if middle else "I"), (-5, "K"), (-6, star)):
        square = (ax <= 40 + grown) & (ay <= 32 + grown)
        steep = step / (62 + 1.4 * grown) + ay / (49 + 1.4 * grown) <= 1
        put(drawn, square | steep, colour)
    for i, j in ((19, 26), (28, 10), (9, 44)):
        stamp(drawn, recoloured(HOOK, {"H": hook}), 60 - i, 91 - j)
    stamp(drawn, STAR, 60 - 22, 91 - 13)
    stamp(drawn, recoloured(STAR, {"R": "I", "Y": "R", "I": "N"}), 61, 91 - 66)
    stamp(drawn, CLUSTER, 13, 16)
    stamp(drawn, COMB, 3, 36)
    stamp(drawn, COMB.T[:, ::-1], 31, 2)
    core = np.maximum.reduce([ax / 26, ay / 22, (ax / 26 + ay / 22) / 1.4])
    for limit, colour in ((1.0, "K"), (0.95, "Y" if middle else "I"), (0.8, "K"), (0.76, "R")):
        put(drawn, core <= limit, colour)
    put(drawn, (np.minimum(ax, ay) < 2) & (core <= 0.68), "I" if middle else "Y")
    put(drawn, (abs(ax - ay) < 1.6) & (core <= 0.6), "N")
    for limit, colour in ((9.5, "K"), (8.0, "I"), (5.0, "B"), (2.0, "Y")):
        put(drawn, np.floor(ax / 2) * 2 + ay <= limit, colour)
    return quartered(drawn)


CLUSTER = whole(
    art("""
........K
.......KI
......KII
..KK.KIIK
.KYYKIIKL
.KYYYKKLL
..KYYYKLY
.K.KYYKLY
KIK.KKKLL
KIIKKIIKL
.KIIIIIIK
..KKIIIIK
...KKKKIK
......KIK
.......KK
""")
)


def kazak_border() -> Sheet:
    """Toothed leaves on the slant and cups, on ivory; a tile of four leaves, symmetric about its middle."""
    leaf = art("""
........................
..............KKK.......
............KKRRK.......
...........KRRRK........
.........KKRRRRKKK......
.......KKRRRRRRRRRK.....
.......KRRRRRYRRRK......
........KRRRYYRRK.......
.....KKKRRRYYRRRKKK.....
....KRRRRRYYRRRRRRRK....
....KKRRRYYRRRRRRKK.....
.....KRRYYRRRRKKK.......
.....KRYYRRRRK..........
..KKKRYYRRRRRKK.........
.KRRRYYRRRRRRRRK........
..KKRYRRRRRRRKK.........
...KRYRRRKKKK...........
..KRYRRKK...............
..KYRKK.................
.KYKK...................
.KK.....................
........................
""")
    cup = whole(
        art("""
......
..K...
.KYK..
.KYYKK
.KYRYY
.KYYRY
..KYRR
..KYYR
...KYY
...KKY
....KY
....KK
.....K
.....K
...KKK
..KBBB
.KBBBB
.KKKKK
......
""")
    )
    half = sheet(24, 68, "I")
    for column, figure in ((0, cup), (34, recoloured(cup[::-1], {"B": "F"})), (67, cup)):
        stamp(half, figure, 12, column)
    stamp(half, leaf[:, ::-1], 12, 17)
    stamp(half, recoloured(leaf, {"R": "B"}), 12, 52)
    return np.concatenate([half, half[:, ::-1]], axis=1)


def hooks(outer: str, inner: str) -> Sheet:
    """Running hooks, one colour interlocked with the other."""
    figure = art("""
oooooooooooo
ioooooooooii
iiooooooooii
iiiiooooooii
iiiiiioooooi
iioooioooooi
iiiooooooooi
iiiiiiiiiiii
iiiiiiiiiiii
""")
    return recoloured(figure, {"o": outer, "i": inner})


# Anatolian: a prayer rug with a stepped niche, a hanging lamp, carnations, a panel of tulips, a border of rosettes

CARNATION = whole(
    art("""
....I.
.I.III
.IIIIR
..IIRR
...IIR
...III
....FI
...FFF
.....F
..F..F
.FFF.F
..FFFF
....FF
.....F
""")
)
TULIP = whole(
    art("""
......A.
..A..AAA
..AA.AAA
..AAAAAB
...AAABB
...AAABB
....AAAB
.....AAA
......AA
.......F
..FF...F
.FFFF..F
..FFFF.F
....FFFF
.....FFF
.......F
.......F
.....FFF
....FFFF
""")
)
LAMP = whole(
    art("""
......Y
......Y
.....YY
......Y
.....YY
....NNN
....YYY
.....BB
.....BB
....BBB
...BBIB
..BBIIB
..BBBIB
...BBBB
....YYY
.....BB
......Y
.....YY
......Y
""")
)
EWER = art("""
....YYY......
.....Y.......
....YYY......
.....Y....YY.
...YYYYY.YY..
..YYGGGYYY...
..YGIIGYY....
.YYGIIGYY....
.YYGGGGYY....
..YYGGYY.....
...YYYY......
....YY.......
...YYYY......
..YYYYYY.....
""")


def grown(where: NDArray[np.bool_], breadth: int) -> NDArray[np.bool_]:
    """The knots at most so many rows and columns from those of a condition."""
    height, width = where.shape
    wide = np.pad(where, breadth)
    shifts = [(i, j) for i in range(2 * breadth + 1) for j in range(2 * breadth + 1)]
    return np.asarray(np.any([wide[i : i + height, j : j + width] for i, j in shifts], axis=0))


def niche() -> Sheet:
    """The left half of the field, up to the middle: panel of tulips, arch with stepped shoulders, columns."""
    drawn = sheet(300, 80, "R")
    rows, columns = np.indices(drawn.shape)
    x, y = 79.5 - columns, rows.astype(float)
    put(drawn, y < 52, "I")
    put(drawn, (y >= 50) & (y < 52), "K")
    for number, column in enumerate((79, 63, 47, 31, 15)):
        pair = {"A": "RNTBR"[number], "B": "YYIIY"[number]}
        stamp(drawn, recoloured(TULIP[:, : 16 if column == 79 else None], pair), 26, column + (0 if column < 79 else 1))
    for column in (71, 55, 39, 23, 7):
        stamp(drawn, recoloured(STAR, {"N": "N", "Y": "L", "R": "N"}), 13, column)
        stamp(drawn, recoloured(STAR, {"N": "D", "Y": "Y", "R": "D"}), 40, column)
    arch = 60 + np.floor(np.maximum(x - 5, 0) / 6) * 7
    arch = np.where(x > 62, 60 + 10 * 7, arch)
    spandrel = (y >= 52) & (y < arch)
    for breadth, colour in ((5, "K"), (4, "I"), (2, "Y"), (1, "K"), (0, "B")):
        put(drawn, grown(spandrel, breadth) & (y >= 52), colour)
    for row, column in ((72, 10), (72, 32), (96, 10), (72, 52), (93, 30), (116, 10)):
        stamp(drawn, CARNATION, row, column)
    small = recoloured(STAR, {"N": "I", "Y": "R", "R": "Y", "I": "R"})[2:7, 2:7]
    for row, column in (
        (66, 2),
        (66, 21),
        (66, 42),
        (66, 62),
        (84, 21),
        (86, 42),
        (88, 2),
        (106, 2),
        (106, 20),
        (126, 5),
    ):
        stamp(drawn, small, row, column)
    for where, colour in (((x > 62) & (x <= 73), "K"), ((x > 63) & (x <= 72), "I"), ((x > 66.4) & (x < 68.6), "N")):
        put(drawn, where & (y >= 135) & (y < 276), colour)
    for row in range(142, 272, 11):
        stamp(drawn, recoloured(STAR, {"N": "R", "Y": "G", "R": "N"})[2:7, 2:7], row, 12)
    for row in (135, 276):
        put(drawn, (abs(y - row) < 5) & (x > 57) & (x < 78), "K")
        put(drawn, (abs(y - row) < 4) & (x > 58) & (x < 77), "Y")
        put(drawn, (abs(y - row) < 2) & (x > 60) & (x < 75), "N")
    stamp(drawn, LAMP[:, : LAMP.shape[1] // 2 + 1], 80, 76)
    stamp(drawn, EWER, 262, 42)
    for number, row in enumerate(range(150, 250, 22)):
        stamp(drawn, recoloured(CARNATION, {"I": "IY"[number % 2], "R": "N", "F": "S"}), row, 36 + 6 * (number % 2))
    tree(drawn)
    return drawn


def tree(drawn: Sheet) -> None:
    """A stem in the middle of the niche with leaves and flowers."""
    rows, columns = np.indices(drawn.shape)
    put(drawn, (columns >= 79) & (rows > 110) & (rows < 282), "F")
    for number, row in enumerate(range(118, 276, 20)):
        rise = (79 - columns) * 0.8
        put(drawn, (abs(rows - (row + 12 - rise)) < 1.2) & (columns > 64) & (columns < 79), "F")
        flower = recoloured(STAR, {"N": "N", "Y": "PYI"[number % 3], "R": "N"})
        stamp(drawn, flower, row, 65 if number % 2 else 64)


def ladik_border() -> Sheet:
    """A rosette and a cross of tulips on gold; both symmetric about the diagonals."""
    parts = []
    for kind in "AB":
        drawn = sheet(28, 28, "G")
        x, y = axes(drawn)
        ax, ay = abs(x), abs(y)
        low, high = np.minimum(ax, ay), np.maximum(ax, ay)
        if kind == "A":
            petals = np.maximum(high, (ax + ay) / 1.32)
            for limit, colour in ((12.5, "K"), (11.6, "I"), (8.6, "K"), (7.6, "R"), (5.0, "K"), (4.0, "Y")):
                put(drawn, petals <= limit, colour)
            put(drawn, (abs(ax - ay) < 0.6) & (petals < 12) & (petals > 8.6), "K")
            put(drawn, (low < 1) & (petals < 12) & (petals > 8.6), "K")
            put(drawn, ax + ay < 3, "N")
        else:
            put(drawn, (low < 1) & (high < 12.6), "F")
            put(drawn, (abs(high - 10.5) < 2.1) & (low < 4.6 - abs(high - 11)), "B")
            put(drawn, (abs(high - 11) < 2) & (low < 1.6), "I")
            put(drawn, (abs(ax - ay) < 1.1) & (high < 10), "F")
            put(drawn, (abs(high - 8.5) < 2) & (abs(low - 8.5) < 2), "R")
            for limit, colour in ((6.6, "K"), (5.5, "R"), (3, "I")):
                put(drawn, ax + ay <= limit, colour)
        parts.append(drawn)
    return np.concatenate(parts, axis=1)


# Persian, Tabriz: a medallion with pendants, corner pieces and scrolling vines; a border of palmettes on a vine


class Curves:
    """A drawing FINE times as fine as the knots; points are complex, in knots, imaginary part down."""

    def __init__(self, height: int, width: int, ground: str) -> None:
        self.image = Image.new("L", (FINE * width, FINE * height), ord(ground))
        self.pen = ImageDraw.Draw(self.image)

    def fill(self, points: Points, colour: str) -> None:
        """Fill a shape."""
        self.pen.polygon([(FINE * p.real, FINE * p.imag) for p in points], fill=ord(colour))

    def stroke(self, points: Points, width: float, colour: str) -> None:
        """Draw a line of a width in knots, with round joints."""
        line = [(FINE * p.real, FINE * p.imag) for p in points]
        self.pen.line(line, fill=ord(colour), width=round(FINE * width), joint="curve")

    def knots(self) -> Sheet:
        """Each knot in the commonest letter of its 5 x 5."""
        fine = np.asarray(self.image)
        cells = fine.reshape(len(fine) // FINE, FINE, -1, FINE).swapaxes(1, 2).reshape(len(fine) // FINE, -1, FINE**2)
        letters = np.unique(cells)
        counts = np.stack([(cells == letter).sum(axis=-1) for letter in letters])
        return np.asarray(letters[counts.argmax(axis=0)], dtype=np.uint8)


def lobes(wide: float, high: float, count: int, depth: float) -> Points:
    """A scalloped ellipse."""
    t = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    r = 1 - depth + depth * abs(np.sin(count / 2 * t)) ** 0.6
    return np.asarray(r * (wide * np.cos(t) + 1j * high * np.sin(t)))


def petals(radius: float, count: int, depth: float = 0.3) -> Points:
    """A round flower."""
    return np.asarray(lobes(radius, radius, count, depth) * np.exp(0.5j * np.pi / count))


def leaf(length: float, width: float, bend: float) -> Points:
    """A leaf from the origin upwards."""
    t = np.linspace(0, 1, 24)
    spine = -1j * length * t + bend * length * t**2
    half = 0.5 * width * np.sin(np.pi * t**0.7)
    return np.concatenate([spine + half, (spine - half)[::-1]])


def blossom(curves: Curves, at: complex, radius: float, colours: str) -> None:
    """A flower of six petals: outline, petals, heart."""
    for share, colour in zip((1.0, 0.78, 0.36), colours, strict=True):
        curves.fill(at + petals(share * radius, 6), colour)


def palmette(curves: Curves, at: complex, turn: complex, size: float, colours: str) -> None:
    """A palmette that opens upwards: outline, leaves, fan, heart."""
    outline, outer, fan, heart = tuple(colours)
    for grown, colour in ((1.14, outline), (1.0, outer)):
        for angle, share in ((-1.25, 0.8), (1.25, 0.8), (-0.72, 0.95), (0.72, 0.95), (0.0, 1.08)):
            blade = leaf(size * share * grown, 0.62 * size * grown, 0.25 * np.sign(angle))
            curves.fill(at + turn * np.exp(1j * angle) * (blade + 0.06j * size * (grown > 1)), colour)
    curves.fill(at + turn * (petals(0.46 * size, 7) - 0.34j * size), fan)
    curves.fill(at + turn * (petals(0.24 * size, 5) - 0.34j * size), heart)
    curves.fill(at + turn * petals(0.2 * size, 4), outline)


def scroll(curves: Curves, start: complex, centre: complex, turns: float, flower: str) -> None:
    """A vine that winds into a spiral about a flower, with leaves on both sides; turns are positive clockwise."""
    first = start - centre
    t = np.linspace(0, 1, 80)
    radius = abs(first) * (1 - 0.66 * t)
    line = centre + radius * np.exp(1j * (np.angle(first) + 2 * np.pi * turns * t))
    curves.stroke(line, 1.3, "G")
    for number in range(8, 70, 13):
        onward = line[number + 1] - line[number]
        side = 1 if number // 13 % 2 else -1
        turn = side * 1j * np.exp(0.75j * side) * onward / abs(onward)
        curves.fill(line[number] + turn * leaf(6.2, 3.4, 0.3 * side), "S")
    blossom(curves, complex(line[-1]), 4.6, flower)


FIELD_SIDES = 117, 192
"""Columns and rows of a quarter of the field."""


def tabriz_quarter() -> Sheet:
    """The upper left quarter of the field."""
    width, height = FIELD_SIDES
    curves = Curves(height, width, "R")
    centre, corner = width + 1j * height, 0j
    for start, at, turns, flower in (
        (92 + 40j, 80 + 34j, 1.3, "NIY"), (84 + 14j, 98 + 12j, -1.2, "NPI"), (62 + 62j, 74 + 66j, -1.4, "NYN"),
        (30 + 100j, 44 + 96j, 1.3, "NIY"), (20 + 118j, 22 + 134j, 1.3, "NPI"), (14 + 150j, 22 + 164j, -1.4, "NYN"),
        (48 + 122j, 56 + 112j, -1.2, "NLI"), (46 + 84j, 52 + 76j, 1.2, "NPI"), (8 + 104j, 14 + 112j, 1.1, "NYN"),
        (54 + 80j, 68 + 86j, 1.2, "NIY"), (86 + 76j, 80 + 96j, -1.1, "NPI"), (34 + 128j, 38 + 140j, 1.1, "NYN"),
        (92 + 62j, 104 + 50j, 1.0, "NLI"), (38 + 178j, 24 + 186j, 1.2, "NIY"), (112 + 34j, 112 + 30j, 1.0, "NYN"),
    ):  # fmt: skip
        scroll(curves, start, at, turns, flower)
    for at, angle, size in ((64 + 46j, 0.6, 13), (34 + 78j, -0.7, 12), (26 + 148j, 0.2, 13), (98 + 28j, 2.6, 12)):
        palmette(curves, at, np.exp(1j * angle), size, "NIPY")
    _corner_piece(curves, corner)
    _pendant(curves, centre)
    _medallion(curves, centre)
    return curves.knots()


def _corner_piece(curves: Curves, corner: complex) -> None:
    for share, colour in ((1.05, "K"), (1.02, "I"), (0.98, "K"), (0.96, "N")):
        curves.fill(corner + share * lobes(76, 80, 16, 0.12), colour)
    for share, colour in ((0.5, "K"), (0.48, "Y"), (0.44, "K"), (0.42, "R")):
        curves.fill(corner + share * lobes(76, 80, 12, 0.12), colour)
    for angle, reach in ((0.22, 56), (0.62, 58), (0.95, 58), (1.36, 58)):
        at = corner + reach * np.exp(1j * angle)
        scroll(curves, complex(corner + 40 * np.exp(1j * angle)), complex(at), 1.1, "KIP")
    for angle in (0.42, 0.79, 1.16):
        palmette(curves, corner + 40 * np.exp(1j * angle), np.exp(1j * (angle + np.pi / 2)), 13, "KIPY")
    palmette(curves, corner + 8 + 8j, np.exp(0.75j * np.pi), 20, "KIBY")
    for angle in (0.3, 1.27):
        blossom(curves, complex(corner + 24 * np.exp(1j * angle)), 5, "KYN")


def _pendant(curves: Curves, centre: complex) -> None:
    at = centre - 106j
    for share, colour in ((1.1, "K"), (1.04, "I"), (0.97, "K"), (0.92, "N")):
        curves.fill(at + share * lobes(21, 17, 8, 0.16), colour)
    palmette(curves, at + 7j, 1 + 0j, 17, "KIPY")
    for share, colour in ((1.16, "K"), (1.0, "I")):
        curves.fill(at - 17j + share * leaf(22, 11, 0.0), colour)
    curves.fill(at - 19j + leaf(16, 6, 0.0), "B")


def _medallion(curves: Curves, centre: complex) -> None:
    for share, colour in ((1.06, "K"), (1.035, "Y"), (1.0, "K"), (0.98, "N")):
        curves.fill(centre + share * lobes(82, 92, 16, 0.13), colour)
    for number in range(5):
        angle = np.pi + (number + 0.5) * np.pi / 10
        foot = complex(centre + 56 * np.cos(angle) + 63j * np.sin(angle))
        at = complex(centre + 67 * np.cos(angle) + 75j * np.sin(angle))
        scroll(curves, foot, at, 1.15 if number % 2 else -1.15, "KPI" if number % 2 else "KLI")
    for share, colour in ((0.69, "K"), (0.67, "I"), (0.645, "K"), (0.63, "T")):
        curves.fill(centre + share * lobes(82, 92, 16, 0.13), colour)
    for number in range(4):
        angle = np.pi + number * np.pi / 6
        at = complex(centre + 35 * np.cos(angle) + 40j * np.sin(angle))
        palmette(curves, at, np.exp(1j * (angle + np.pi / 2)), 17, "KIPY" if number % 2 else "KYBI")
    for share, colour in ((0.36, "K"), (0.345, "Y"), (0.32, "K"), (0.305, "I")):
        curves.fill(centre + share * lobes(82, 92, 8, 0.16), colour)
    for number in range(8):
        turn = np.exp(1j * number * np.pi / 4)
        curves.fill(centre + turn * (leaf(15, 7, 0.0) - 6j), "NR"[number % 2])
    for radius, colour in ((10, "K"), (9, "R"), (5.5, "K"), (4.6, "Y")):
        curves.fill(centre + petals(radius, 8), colour)


def tabriz_border() -> Sheet:
    """A vine that swings from edge to edge, a palmette in each swing."""
    breadth = 34
    curves = Curves(breadth, 2 * breadth, "N")
    x = np.linspace(-4, 72, 160)
    vine = x + 1j * (16.5 + 9.5 * np.cos(np.pi * (x - 17) / 34))
    curves.stroke(vine, 1.5, "G")
    for at, side in ((17, 1), (51, -1)):
        for aside in (-1, 1):
            start = at + aside * 17 + 16.5j
            curves.fill(start + np.exp(1.1j * aside) * leaf(8, 4, 0.3 * aside), "S")
            curves.fill(start - np.exp(1.1j * aside) * leaf(8, 4, 0.3 * aside), "S")
            blossom(curves, at + aside * 10.5 + 1j * (17 + side * -11.5), 4.2, "KPI" if side > 0 else "KLI")
        middle = at + 1j * (16.5 + side * 10)
        palmette(curves, middle, np.exp(1j * np.pi * (side < 0)), 16, "KIRY" if side > 0 else "KPIN")
    return quartered_across(curves.knots(), breadth)


def quartered_across(drawn: Sheet, part: int) -> Sheet:
    """Each part of a sheet made symmetric about its own middle."""
    parts = [drawn[:, first : first + part] for first in range(0, drawn.shape[1], part)]
    halves = [one[:, : part - part // 2] for one in parts]
    return np.concatenate([np.concatenate([one, one[:, ::-1][:, part % 2 :]], axis=1) for one in halves], axis=1)


def flower_guard(ground: str, petal: str) -> Sheet:
    """A guard of small flowers and leaves."""
    drawn = sheet(9, 18, ground)
    stamp(drawn, recoloured(STAR[1:8, 1:8], {"N": "K", "Y": petal, "R": "K"}), 4, 4)
    stamp(drawn, art("..F..\n.FF.F\nFF.FF\n.FF.F\n..F.."), 4, 12)
    stamp(drawn, art("K.\n.K\nK."), 4, 16)
    return drawn


TILES: dict[str, Callable[[], Sheet]] = {
    "tekke-field": tekke_field,
    "tekke-border": tekke_border,
    "tekke-guard": lambda: zigzag(6, "D", "I", "T"),
    "kazak-field": kazak_field,
    "kazak-middle": lambda: kazak_field(middle=True),
    "kazak-border": kazak_border,
    "kazak-hooks": lambda: hooks("N", "Y"),
    "prayer-niche": niche,
    "prayer-border": ladik_border,
    "prayer-guard": lambda: zigzag(8, "I", "R", "N"),
    "tabriz-quarter": tabriz_quarter,
    "tabriz-border": tabriz_border,
    "tabriz-guard": lambda: flower_guard("I", "R"),
    "tabriz-inner": lambda: flower_guard("T", "Y"),
}


def main(folder: Path) -> None:
    """Draw all tiles into a folder."""
    folder.mkdir(exist_ok=True)
    for name, draw in TILES.items():
        save(draw(), folder / f"{name}.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("tiles"))
