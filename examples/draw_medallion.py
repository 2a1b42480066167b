"""Draw `medallion.png`, the carpet picture that comes with ilmek.

A Turkish layout: outer guard border, main border, inner guard border, and a field of repeated flowers with a centre
medallion, its pendants and corner pieces. Stars and ram's horns run along the main border, carnations fill the
medallion. One quarter is drawn in knots (300 x 450 of them, four pixels each) and mirrored; then every knot gets the
grain of hand-spun wool and every row the abrash of a new dye bath.

    python examples/draw_medallion.py [FILE.png]
"""

import itertools
import sys
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

Points: TypeAlias = NDArray[np.complex128]

WIDTH, HEIGHT = 300, 450  # knots
PIXELS = 4  # a knot
FINE = 4  # drawn pixels a pixel, averaged at the end

NIGHT, INDIGO, BLUE, SKY = "#1e1b1d", "#1f3157", "#3d6690", "#8fb0bd"
MADDER, WINE, CORAL, ROSE = "#96282b", "#6b1a24", "#bf5638", "#d39c86"
IVORY, STRAW, GOLD, OLIVE = "#ebdfc3", "#dfbd62", "#c8953c", "#66743f"

CENTRE = complex(WIDTH / 2, HEIGHT / 2)
FIELD = 63.0  # from the edge to the field
CORNER = (61.0, 88.0)  # half axes
MEDALLION = (61.0, 86.0)


class Loom:
    """A quarter of the carpet, painted shape by shape; shapes are in knots, x to the right, y down."""

    def __init__(self) -> None:
        self.scale = PIXELS * FINE
        self.image = Image.new("RGB", (WIDTH // 2 * self.scale, HEIGHT // 2 * self.scale), NIGHT)
        self.brush = ImageDraw.Draw(self.image)

    def fill(self, shape: Points, colour: str) -> None:
        """A filled polygon."""
        self.brush.polygon([(z.real * self.scale, z.imag * self.scale) for z in shape], fill=colour)

    def stroke(self, line: Points, width: float, colour: str) -> None:
        """A line of some width with round joints."""
        for begin, end in itertools.pairwise(line):
            if begin != end:
                across = 0.5j * width * (end - begin) / abs(end - begin)
                self.fill(np.array([begin + across, end + across, end - across, begin - across]), colour)
        for joint in line:
            self.fill(disc(0.5 * width, 12) + joint, colour)

    def frame(self, inset: float, colour: str) -> None:
        """Everything further than `inset` from the edge."""
        far = CENTRE + 10 + 10j
        self.fill(np.array([inset * (1 + 1j), far.real + inset * 1j, far, inset + far.imag * 1j]), colour)


# Shapes about the origin; those with a direction point up (to -y).


def disc(radius: float, corners: int = 40) -> Points:
    """A disc, or a regular polygon with a corner to the right."""
    return np.asarray(radius * np.exp(2j * np.pi * np.arange(corners) / corners))


def diamond(width: float, height: float) -> Points:
    """A lozenge."""
    return np.array([width / 2, -0.5j * height, -width / 2, 0.5j * height])


def star(radius: float, inner: float, points: int = 8) -> Points:
    """A star with its first point up."""
    spokes = np.where(np.arange(2 * points) % 2 == 0, radius, inner)
    return np.asarray(-1j * spokes * np.exp(1j * np.pi * np.arange(2 * points) / points))


def rosette(radius: float, petals: int, depth: float) -> Points:
    """Round petals about a centre, one of them up."""
    angle = np.linspace(0, 2 * np.pi, 30 * petals, endpoint=False)
    scallop = 1 - depth + depth * np.abs(np.cos(0.5 * petals * angle)) ** 0.7
    return np.asarray(-1j * radius * scallop * np.exp(1j * angle))


def leaf(length: float, width: float, bend: float = 0.0) -> Points:
    """A leaf from the origin upwards, bent to the side."""
    t = np.linspace(0, 1, 24)
    spine = -1j * length * t + bend * length * t**2
    half = 0.5 * width * np.sin(np.pi * t**0.8)
    return np.concatenate([spine + half, (spine - half)[::-1]])


def fan(radius: float, teeth: int, spread: float, notch: float) -> Points:
    """The toothed fan of a carnation, its calyx in the origin."""
    angle = np.linspace(-spread, spread, 2 * teeth + 1)
    rim = radius * np.where(np.arange(2 * teeth + 1) % 2 == 0, 1 - notch, 1.0)
    return np.append(-1j * rim * np.exp(1j * angle), 0)


def horn(reach: float, rise: float) -> Points:
    """The centre line of half a ram's horn: up, over to the right, and curled back."""
    return np.array([0, -1j * rise, reach - 1j * rise, reach - 0.38j * rise, 0.48 * reach - 0.38j * rise])


def lobed(half_width: float, half_height: float, lobes: int, depth: float = 0.07, tip: float = 0.0) -> Points:
    """A scalloped ellipse, drawn out to a tip above and below."""
    t = np.linspace(0, 2 * np.pi, 60 * lobes, endpoint=False)
    scallop = 1 - depth + depth * np.abs(np.sin(0.5 * lobes * t)) ** 0.65
    drawn = 1 + tip * np.exp(-((np.cos(t) / 0.22) ** 2))
    return np.asarray(half_width * np.cos(t) * scallop + 1j * half_height * np.sin(t) * scallop * drawn)


# Motifs


def carnation(loom: Loom, at: complex, turn: complex, radius: float, colours: tuple[str, str]) -> None:
    """A carnation with its calyx at `at`; colours of petals and heart."""
    petal, heart = colours
    loom.fill(at + turn * fan(radius, 7, 1.05, 0.17), petal)
    loom.fill(at + turn * fan(0.62 * radius, 5, 0.86, 0.2), heart)
    loom.fill(at + turn * fan(0.36 * radius, 3, 0.6, 0.1), petal)
    loom.fill(at + turn * (diamond(0.42 * radius, 0.5 * radius) - 0.02j * radius), OLIVE)


def flower(loom: Loom, at: complex, radius: float, colours: tuple[str, str], petals: int = 6) -> None:
    """A round flower; colours of petals and heart."""
    petal, heart = colours
    loom.fill(at + rosette(radius, petals, 0.3), petal)
    loom.fill(at + disc(0.4 * radius), heart)


def seljuk_star(loom: Loom, at: complex, radius: float, colours: tuple[str, str, str]) -> None:
    """An eight-pointed star in three rings with a flower in its heart."""
    for share, colour in zip((1.0, 0.84, 0.56), colours, strict=True):
        loom.fill(at + star(share * radius, 0.76 * share * radius), colour)
    flower(loom, at, 0.4 * radius, (IVORY, MADDER), 8)


def rams_horns(loom: Loom, at: complex, turn: complex, colour: str, heart: str) -> None:
    """Two pairs of ram's horns back to back, with a lozenge between them."""
    for way in (turn, -turn):
        for side in (1, -1):
            curl = horn(5.4, 12.2)
            loom.stroke(at + way * (curl if side > 0 else -curl.conj()), 2.3, colour)
        loom.fill(at + way * (diamond(4.6, 4.6) - 14.3j), heart)
    loom.fill(at + turn * diamond(11.5, 11.5), colour)
    loom.fill(at + turn * diamond(7, 7), heart)


# Borders: motifs at whole and half repeats along the top edge and the left edge, from the corner to the middle


def along(inset: float, across: int, down: int) -> tuple[list[tuple[complex, complex]], list[tuple[complex, complex]]]:
    """Places and directions (pointing outwards) of a border's whole and half repeats in one quarter."""
    wide, high = (WIDTH - 2 * inset) / across, (HEIGHT - 2 * inset) / down
    whole = [(inset * (1 + 1j) + i * wide, 1 + 0j) for i in range(across // 2 + 1)]
    whole += [(inset * (1 + 1j) + 1j * i * high, -1j) for i in range(1, down // 2 + 1)]
    half = [(inset * (1 + 1j) + (i + 0.5) * wide, 1 + 0j) for i in range((across + 1) // 2)]
    half += [(inset * (1 + 1j) + 1j * (i + 0.5) * high, -1j) for i in range((down + 1) // 2)]
    return whole, half


def outer_guard(loom: Loom) -> None:
    """A zigzag stem with buds on ivory."""
    loom.frame(3, IVORY)
    whole, half = along(9, 24, 37)
    for index, (at, turn) in enumerate(whole):
        for side in (1, -1):
            step = side * 5.9 - 6.2j
            loom.stroke(at + turn * np.array([3.1j, 3.1j + step]), 1.9, OLIVE)
        loom.fill(at + turn * (diamond(5.2, 6.4) - 1.6j), MADDER if index % 2 else INDIGO)
    for at, turn in half:
        loom.fill(at + turn * (diamond(4.4, 4.6) + 2.6j), GOLD)
    for share, colour in ((11.5, WINE), (9.0, IVORY)):
        loom.fill(8.75 * (1 + 1j) + disc(share / np.sqrt(2), 4) * np.exp(0.25j * np.pi), colour)
    flower(loom, 8.75 * (1 + 1j), 4.2, (MADDER, GOLD), 4)


def main_border(loom: Loom) -> None:
    """Stars and ram's horns on indigo, between madder lines."""
    loom.frame(14.5, WINE)
    loom.frame(16, GOLD)
    loom.frame(17.5, INDIGO)
    whole, half = along(32.5, 6, 10)
    for at, turn in half:
        rams_horns(loom, at, turn, STRAW, MADDER)
    for index, (at, _) in enumerate(whole):
        colours = (IVORY, MADDER, GOLD) if index % 2 == 0 else (IVORY, BLUE, CORAL)
        seljuk_star(loom, at, 13.2, colours)
    loom.frame(47.5, GOLD)
    loom.frame(49, WINE)


def inner_guard(loom: Loom) -> None:
    """Flowers between bars on sky blue."""
    loom.frame(50.5, SKY)
    whole, half = along(56, 16, 29)
    for index, (at, _) in enumerate(whole):
        flower(loom, at, 4.3, (MADDER if index % 2 else INDIGO, IVORY), 4)
    for at, turn in half:
        loom.fill(at + turn * diamond(2.6, 9.6), OLIVE)
    loom.frame(61, NIGHT)


# The field


def field(loom: Loom) -> None:
    """A lattice of stems with flowers at the crossings, on madder."""
    loom.frame(FIELD, MADDER)
    step = complex((CENTRE.real - FIELD) / 8.5, (CENTRE.imag - FIELD) / 12.5)
    places = [(i, j) for i in range(10) for j in range(14) if (i + j) % 2 == 0]
    spots = {place: CENTRE - complex(place[0] * step.real, place[1] * step.imag) for place in places}
    for at in spots.values():
        for way in (step, step.conjugate()):
            loom.stroke(np.array([at - 0.5 * way, at + 0.5 * way]), 1.5, WINE)
    for (i, j), at in spots.items():
        if not is_free(at):
            continue
        for turn in (1 + 0j, 1j, -1 + 0j, -1j):
            loom.fill(at + turn * (leaf(4.8, 3.0) - 2.8j), OLIVE)
        flower(loom, at, 4.3, ((IVORY, GOLD, IVORY, SKY)[(i + 3 * j) // 2 % 4], WINE))


def is_free(at: complex) -> bool:
    """Whether a flower stands clear of the medallion, its pendant and the corner piece."""
    middle, edge = at - CENTRE, at - FIELD * (1 + 1j)
    distances = (
        abs(complex(middle.real / MEDALLION[0], middle.imag / MEDALLION[1])) - 1.12,
        abs(complex(edge.real / CORNER[0], edge.imag / CORNER[1])) - 1.12,
        abs(complex(middle.real / 31, (middle.imag + 116) / 32)) - 1,
    )
    return min(distances) > 0 and edge.real > 0 and edge.imag > 0


def ellipse(size: tuple[float, float], angle: float) -> complex:
    """A point of an ellipse by its parameter."""
    return complex(size[0] * np.cos(angle), size[1] * np.sin(angle))


def outward(way: complex) -> complex:
    """The turn that makes an upward shape point along `way`."""
    return 1j * way / abs(way)


def corner(loom: Loom) -> None:
    """The corner piece: a quarter of a medallion with a spray of carnations."""
    origin = FIELD * (1 + 1j)
    rings = ((1.06, MADDER), (1.0, NIGHT), (0.972, GOLD), (0.93, NIGHT), (0.91, BLUE), (0.74, IVORY), (0.705, INDIGO))
    for share, colour in rings:
        loom.fill(origin + share * lobed(*CORNER, 16), colour)
    for step in range(1, 8, 2):
        at = origin + 0.82 * ellipse(CORNER, np.pi / 16 * step)
        flower(loom, at, 4.6, (IVORY if step % 4 == 1 else STRAW, MADDER))
    root = origin + 4 + 5j
    for angle, length in ((0.24, 23.0), (0.83, 27.0), (1.33, 34.0)):
        turn = outward(ellipse(CORNER, angle))
        loom.stroke(np.array([root, root - 1j * turn * length]), 2.0, OLIVE)
        for side in (1, -1):
            loom.fill(root + turn * (leaf(10, 4.6, side * 0.7) - 0.3j * length), OLIVE)
        radius, petal = (15.0, IVORY) if length == 27 else (11.5, ROSE)
        carnation(loom, root - 1j * turn * length, turn, radius, (petal, MADDER))
    loom.fill(origin + rosette(13, 8, 0.3), GOLD)
    loom.fill(origin + rosette(10.4, 8, 0.3), CORAL)
    loom.fill(origin + disc(4.5), IVORY)


def pendant(loom: Loom) -> None:
    """The pendant above the medallion: a cartouche, a palmette and two leaves."""
    at = CENTRE - 105j
    for colour, grown in ((MADDER, 3.2), (NIGHT, 1.3)):
        loom.fill(at - 10j + (1 + grown / 20) * fan(21, 7, 1.05, 0.17) + 1j * grown, colour)
        loom.fill(at + (1 + grown / 18) * lobed(22, 12.5, 8, 0.12), colour)
        for side in (1, -1):
            blade = leaf(27 + 2 * grown, 7.5 + 2 * grown, -0.3 * side) + 1j * grown
            loom.fill(at - 6j + np.exp(1.25j * side) * blade, colour)
    for side in (1, -1):
        loom.fill(at - 6j + np.exp(1.25j * side) * leaf(27, 7.5, -0.3 * side), OLIVE)
    carnation(loom, at - 10j, 1 + 0j, 21, (IVORY, CORAL))
    for share, colour in ((1.04, NIGHT), (0.96, GOLD), (0.82, INDIGO)):
        loom.fill(at + share * lobed(22, 12.5, 8, 0.12), colour)
    flower(loom, at, 6.5, (IVORY, MADDER), 8)
    for aside in (12.5, -12.5):
        loom.fill(at + aside + diamond(4.6, 4.6), ROSE)


def medallion(loom: Loom) -> None:
    """The centre: rings of indigo, coral and ivory about a star."""
    rings = {
        "ground": ((1.06, MADDER), (1.0, NIGHT), (0.972, GOLD), (0.935, NIGHT), (0.915, INDIGO)),
        "carnations": ((0.74, GOLD), (0.71, NIGHT), (0.69, CORAL)),
        "heart": ((0.44, NIGHT), (0.415, GOLD), (0.37, IVORY)),
    }

    def paint(name: str) -> None:
        for share, colour in rings[name]:
            loom.fill(CENTRE + share * lobed(*MEDALLION, 16, 0.075, 0.07), colour)

    paint("ground")
    for step in range(32):
        at = CENTRE + 0.815 * ellipse(MEDALLION, np.pi / 16 * (step + 0.5))
        flower(loom, at, 4.1, ((IVORY, ROSE)[step // 2 % 2], MADDER), 4)
    paint("carnations")
    for step in range(12):
        spoke = ellipse(MEDALLION, np.pi / 6 * step)
        colours = (IVORY, MADDER) if step % 2 == 0 else (INDIGO, SKY)
        carnation(loom, CENTRE + 0.45 * spoke, outward(spoke), 14.0, colours)
    paint("heart")
    for step in range(4):
        loom.fill(CENTRE + 1j**step * (leaf(9, 5.5) - 13j), BLUE)
    seljuk_star(loom, CENTRE, 17.5, (NIGHT, MADDER, GOLD))


def quarter() -> NDArray[np.uint8]:
    """The upper left quarter, four pixels a knot."""
    borders, inside = Loom(), Loom()
    for paint in (outer_guard, main_border, inner_guard):
        paint(borders)
    for paint in (field, corner, pendant, medallion):
        paint(inside)
    edge = round(FIELD * inside.scale)
    borders.image.paste(inside.image.crop((edge, edge, *inside.image.size)), (edge, edge))
    return np.asarray(borders.image.reduce(FINE))


def draw() -> Image.Image:
    """The whole picture."""
    part = quarter()
    upper = np.concatenate([part, part[:, ::-1]], axis=1)
    whole = np.concatenate([upper, upper[::-1]], axis=0).astype(np.float64)
    light = wool(HEIGHT, WIDTH).repeat(PIXELS, axis=0).repeat(PIXELS, axis=1)
    return Image.fromarray((whole * light[..., None]).round().clip(0, 255).astype(np.uint8))


def wool(rows: int, columns: int) -> NDArray[np.float64]:
    """The light of each knot: grain from knot to knot, abrash from row to row."""
    grain = np.random.default_rng(1923).integers(-2, 3, (rows, columns)) * 0.012
    row = np.arange(rows) / rows
    abrash = 0.035 * np.sin(2 * np.pi * (2.3 * row + 0.1)) + 0.025 * np.sin(2 * np.pi * (7.1 * row + 0.4))
    return np.asarray(1 + grain + np.round(abrash, 2)[:, None])


if __name__ == "__main__":
    file = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("medallion.png")
    draw().save(file, optimize=True)
    print(f"{file}: {file.stat().st_size / 1e3:.0f} kB")
