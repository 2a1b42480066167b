"""Flat reading of a picture: whole chroma, true colours, labels of the pixels, symmetry, knots."""

import numpy as np

from ilmek.arrays import FloatArray, Indices, Rgb, UInt8
from ilmek.carpet.flat.chroma import whole_chroma
from ilmek.carpet.flat.knots import knot_labels
from ilmek.carpet.flat.labels import label_pixels
from ilmek.carpet.flat.nearest import UNKNOWN, raw_label
from ilmek.carpet.flat.survey import survey
from ilmek.carpet.flat.symmetry import is_symmetric, make_symmetric
from ilmek.carpet.flat.true_colours import TrueColours, true_colours
from ilmek.num.compiled import uncounted
from ilmek.num.threads import in_threads
from ilmek.progress import SILENT, Progress
from ilmek.records import record

_BAND = 128

_LONE = 1.5
"""Pixels a knot under which a single pixel is a knot; whether it is confetti is decided later."""

_CODES = 1 << 24


@record
class FlatDesign:
    """A drawing read onto the grid of knots.

    colours    sRGB of each knot (rows, columns, 3), each a true colour
    true       the true colours, from dark to light
    foreign    knots whose colour is nearest to no pixel of their cell
    symmetric  axes about which the design is symmetric: vertical, horizontal
    restored   whether the picture had halved chroma, which its luma tells
    """

    colours: Rgb
    true: UInt8[np.ndarray, "colours 3"]
    foreign: int
    symmetric: tuple[str, ...]
    restored: bool


def flat_design(
    rgb: Rgb, grid: tuple[int, int], progress: Progress = SILENT, true: TrueColours | None = None
) -> FlatDesign:
    """A picture read as a drawing on a grid of rows and columns.

    true  its true colours; default, and where its chroma is halved (`chroma`): found in it
    """
    given = np.ascontiguousarray(rgb)
    rgb = whole_chroma(given, progress.part(0.0, 0.1))
    height, width = rgb.shape[:2]
    if true is None or rgb is not given:
        true = true_colours(survey(rgb))
    progress(0.1)
    table = np.full(_CODES, UNKNOWN, dtype=np.uint8)
    knot = min(height / grid[0], width / grid[1])
    labels = label_pixels(rgb, true, table, knot >= _LONE, progress.part(0.1, 0.5))
    across = is_symmetric(rgb, labels, True, knot, true.noise, progress.part(0.5, 0.55))
    down = is_symmetric(rgb, labels, False, knot, true.noise, progress.part(0.55, 0.6))
    if across or down:
        make_symmetric(rgb, labels, true.srgb, across, down)
    knots = knot_labels(labels, grid, progress.part(0.6, 0.9))
    colours = np.empty((*grid, 3), dtype=np.uint8)
    foreign = 0

    def count(first: int) -> int:
        colours[first : first + _BAND] = true.srgb[knots[first : first + _BAND]]
        return int(_foreign(rgb, table, true.labs, knots, first, min(first + _BAND, grid[0])))

    for first, many in in_threads(count, range(0, grid[0], _BAND)):
        foreign += many
        progress(0.9 + 0.1 * min(first + _BAND, grid[0]) / grid[0])
    axes = (("vertical",) if across else ()) + (("horizontal",) if down else ())
    return FlatDesign(colours, true.srgb, foreign, axes, rgb is not given)


@uncounted
def _foreign(  # noqa: PLR0917
    rgb: Rgb, table: UInt8[np.ndarray, " codes"], labs: FloatArray, knots: Indices, first: int, stop: int
) -> int:
    rows, columns = knots.shape
    height, width = rgb.shape[:2]
    foreign = 0
    for row in range(first, stop):
        for column in range(columns):
            own = knots[row, column]
            # Most cells have their colour at the first pixel that is tried, the middle one.
            y, x = (2 * row + 1) * height // (2 * rows), (2 * column + 1) * width // (2 * columns)
            found = raw_label(rgb, y, x, table, labs) == own
            for y in range(row * height // rows, ((row + 1) * height - 1) // rows + 1):
                if found:
                    break
                for x in range(column * width // columns, ((column + 1) * width - 1) // columns + 1):
                    if raw_label(rgb, y, x, table, labs) == own:
                        found = True
                        break
            foreign += not found
    return foreign
