"""Exact reading: the pixels of the picture are the knots.

Size, quality and grid follow from each other:

    columns = width · across,   rows = length · along

With size and quality, a picture is exact where it has their grid, or n × n equal pixels for each knot, and at most
MOST_YARNS colours. Where one of them is open, the picture has to state the grid by itself: it is drawn knot by knot.
Three measures tell a drawing from a photo of few colours, from a dithered one and from artwork of many pixels a knot:

    details   share of the pixels that are one pixel wide, in the row or in the column, and no mix of both sides: 1 to
              25 %. Artwork has less, a dithered photo more; smoothed edges are mixes
    alike     share of neighbours of one colour: at least 60 %
    contrast  mean CIEDE2000 of the neighbours of two colours, over that of any two pixels of two colours: at least 0.6.
              In a photo most neighbours have colours that are near

A small picture of few colours, at most SMALL pixels long, is drawn knot by knot also without such details, in blocks,
unless its edges are smoothed: they have mixes, more than a quarter of its details.

Assumed by this project, from photos reduced to 8 to 64 colours, with and without dithering, and from drawings of
carpets: all photos of 16 and more colours fail, all drawings with details of one knot pass. The small ones from
some hundred icons: with smoothed edges 0.6 to 8 % are mixes beside less than 2 % of details, with hard ones up to 2 %
beside up to 40 %.
"""

import math

import numpy as np

from ilmek.arrays import FloatArray, Indices, Int, IntArray, Rgb, UInt8
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.design import bands, knot_grid
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.errors import CarpetError
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.sentences import Sentence
from ilmek.units import counted

USUAL = Quality(250.0, 250.0)
"""Quality of a carpet whose grid is known, where neither size nor quality is given."""

MOST_DRAWN_COLOURS = 64
"""Largest number of colours of a picture that states its grid by itself."""

LEAST_DRAWN, MOST_DRAWN = 16, 5000
"""Least and greatest side [knots] of such a picture."""

SMALL, FEW = 128, 16
"""Greatest side [pixels] and number of colours of a small picture of few colours."""

SMALL_ALIKE, SMALL_DETAILS, SMOOTHED = 0.55, 0.4, (0.002, 0.25)
"""Least share of alike neighbours and greatest one of details in it; share of mixes, and their ratio to the details,
above which its edges are smoothed.
"""

LEAST_DETAILS, MOST_DETAILS, LEAST_ALIKE, LEAST_CONTRAST = 0.01, 0.25, 0.6, 0.6
COARSEST_DRAWN, FINEST_DRAWN, MOST_OBLONG = 150.0, 2000.0, 2.0
"""Qualities [knots/m] and their ratio that a size may give to such a picture."""

LARGEST_STATED = 6.0
"""Greatest side of the carpet that such a picture may give where no size is given [m]: few carpets are larger, and a
larger picture of few colours is a scan or a screen. Assumed by this project.
"""

COARSEST_STATED = 100.0
"""Least number of pixels per metre that are taken for knots."""

_CODES = 1 << 24
_MIX = 0.02
"""Relative distance from the line between two colours, and from its ends, within which a colour is their mix."""


@record
class FewColours:
    """A picture by the numbers of its colours.

    numbers  of each pixel's colour (height, width), in order of first appearance
    palette  sRGB of the colours (colours, 3)
    """

    numbers: Indices
    palette: UInt8[np.ndarray, "colours 3"]


@record
class KnotDrawing:
    """A picture whose pixels are the knots of a carpet, and the carpet's size and quality; the reason in words."""

    rgb: Rgb
    size: CarpetSize
    quality: Quality
    reason: str


@record
class Details:
    """The measures of a drawing, see above [-]; mixed: share of the pixels that are mixes of their neighbours."""

    fine: float
    mixed: float
    alike: float
    contrast: float

    @property
    def drawn(self) -> bool:
        """Whether the pixels are drawn one by one."""
        fine = max(LEAST_DETAILS, self.mixed) <= self.fine <= MOST_DETAILS
        return fine and self.alike >= LEAST_ALIKE and self.contrast >= LEAST_CONTRAST

    @property
    def hard(self) -> bool:
        """Whether the pixels of a small picture are drawn one by one: no edge is smoothed."""
        smoothed = self.mixed > max(SMOOTHED[0], SMOOTHED[1] * self.fine)
        return (
            not smoothed
            and self.fine <= SMALL_DETAILS
            and self.alike >= SMALL_ALIKE
            and self.contrast >= LEAST_CONTRAST
        )


def has_grid(grid: tuple[int, int], size: CarpetSize, quality: Quality) -> bool:
    """Whether a carpet of this size and quality has these rows and columns; False also where it cannot be woven."""
    return (round(size.length * quality.along), round(size.width * quality.across)) == grid and min(grid) > 1


def of_grid(grid: tuple[int, int], size: CarpetSize | None, quality: Quality | None) -> tuple[CarpetSize, Quality]:
    """Size and quality of a carpet of these rows and columns, of which at most one is given.

    Raises CarpetError where the other is out of bounds.
    """
    rows, columns = grid
    if size is not None:
        quality = quality or Quality(columns / size.width, rows / size.length)
    else:
        quality = quality or USUAL
        size = CarpetSize(columns / quality.across, rows / quality.along)
    knot_grid(size, quality)
    return size, quality


def find_drawing(
    rgb: Rgb, size: CarpetSize | None, quality: Quality | None, *, drawn: bool = False, progress: Progress = SILENT
) -> KnotDrawing | None:
    """The drawing that a picture is; None: its pixels are not the knots.

    size, quality  as far as they are given
    drawn          it is known that every pixel is a knot, as with `--read exact` and in a chart
    Raises CarpetError for a drawn picture that does not have the grid of size and quality, or has none.
    """
    pixels = int(rgb.shape[0]), int(rgb.shape[1])
    if size is not None and quality is not None:
        return _of_the_grid(rgb, size, quality, drawn=drawn, progress=progress)
    if drawn:
        size, quality = of_grid(pixels, size, quality)
        return KnotDrawing(rgb, size, quality, f"each of its {pixels[1]} × {pixels[0]} pixels is a knot")
    return _of_its_own_grid(rgb, size, quality, progress)


def _of_its_own_grid(
    rgb: Rgb, size: CarpetSize | None, quality: Quality | None, progress: Progress
) -> KnotDrawing | None:
    """The drawing of a picture that states its grid by itself."""
    few = few_colours(rgb, MOST_DRAWN_COLOURS, progress.part(0.0, 0.4))
    if few is None or len(few.palette) < 2:
        return None
    reduced = enlargement(few.numbers)
    for scale in (reduced, 1):
        grid = int(rgb.shape[0]) // scale, int(rgb.shape[1]) // scale
        details = _drawn_details(few, scale, grid, progress.part(0.4, 1.0))
        if details is None:
            continue
        try:
            wide, fine = of_grid(grid, size, quality)
        except CarpetError:
            continue
        believable = size is not None or max(wide.width, wide.length) <= LARGEST_STATED
        if _usual(fine) and believable:
            share = f"{counted(len(few.palette), 'colour')}, {details.fine:.1%} of the knots in details of one knot"
            return KnotDrawing(_reduced(rgb, scale), wide, fine, f"drawn knot by knot{_in_words(grid, scale)}: {share}")
    return None


def _drawn_details(few: FewColours, scale: int, grid: tuple[int, int], progress: Progress) -> Details | None:
    """The measures of a picture that is drawn knot by knot with so many pixels a knot; None: it is not."""
    large = min(grid) >= LEAST_DRAWN and max(grid) <= MOST_DRAWN
    small = scale == 1 and max(grid) <= SMALL and len(few.palette) <= FEW
    if not (large or small):
        return None
    details = measured(FewColours(few.numbers[::scale, ::scale], few.palette), progress)
    return details if (large and details.drawn) or (small and details.hard) else None


def stated_quality(density: tuple[float, float] | None, rgb: Rgb) -> Quality | None:
    """The quality that a picture states by its pixels per metre, as chart.png and chart.bmp do.

    density  pixels per metre across and along
    None where they are not those of knots (screens and printers have 2800 and more), or the colours are not few.
    """
    if density is None or not all(COARSEST_STATED <= count <= FINEST_DRAWN for count in density):
        return None
    if few_colours(rgb, MOST_YARNS) is None:
        return None
    try:
        return of_grid((int(rgb.shape[0]), int(rgb.shape[1])), None, Quality(*density))[1]
    except CarpetError:
        return None


def _of_the_grid(
    rgb: Rgb, size: CarpetSize, quality: Quality, *, drawn: bool, progress: Progress
) -> KnotDrawing | None:
    """The drawing of a picture that has the knots of a size and a quality, or a whole number of pixels for each."""
    rows, columns = grid = knot_grid(size, quality)
    scale = int(rgb.shape[0]) // rows
    if scale and rgb.shape[:2] == (rows * scale, columns * scale):
        few = few_colours(rgb, MOST_YARNS, progress)
        if scale == 1 and (drawn or few is not None):
            found = "its colours" if few is None else counted(len(few.palette), "colour")
            return KnotDrawing(rgb, size, quality, f"its pixels are the {columns} × {rows} knots, in {found}")
        if few is not None and enlargement(few.numbers) % scale == 0:
            found = counted(len(few.palette), "colour")
            return KnotDrawing(
                _reduced(rgb, scale), size, quality, f"drawn knot by knot{_in_words(grid, scale)}: {found}"
            )
    if drawn:
        raise CarpetError(
            Sentence(
                "picture.exact",
                width=rgb.shape[1],
                height=rgb.shape[0],
                size=size,
                quality=quality,
                columns=columns,
                rows=rows,
            ),
            do=Sentence("picture.exact-do"),
        )
    return None


def _usual(quality: Quality) -> bool:
    """Whether a quality is one that a drawing is made for."""
    low, high = sorted((quality.across, quality.along))
    return low >= COARSEST_DRAWN and high <= FINEST_DRAWN and high <= MOST_OBLONG * low


def _reduced(rgb: Rgb, scale: int) -> Rgb:
    return rgb if scale == 1 else np.ascontiguousarray(rgb[::scale, ::scale])


def _in_words(grid: tuple[int, int], scale: int) -> str:
    """The grid, and where it is enlarged, by how much."""
    size = f" on {grid[1]} × {grid[0]}"
    return size if scale == 1 else f"{size}, each knot {scale} × {scale} pixels"


def few_colours(rgb: Rgb, most: int, progress: Progress = SILENT) -> FewColours | None:
    """The picture by its colours, if it has at most so many (up to 255)."""
    rgb = np.ascontiguousarray(rgb)
    rows, columns = rgb.shape[:2]
    index = np.zeros(_CODES, dtype=np.uint8)
    codes = np.empty(most, dtype=np.int64)
    numbers = np.empty((rows, columns), dtype=np.uint8)
    found = 0
    for band in bands(rows, columns):
        found = int(_number(rgb[band], index, codes, numbers[band], found))
        if found > most:
            return None
        progress(band.stop / rows)
    palette = np.stack([codes[:found] >> 16, codes[:found] >> 8 & 255, codes[:found] & 255], axis=-1)
    return FewColours(numbers, palette.astype(np.uint8))


@compiled
def _number(rgb: Rgb, index: IntArray, codes: IntArray, numbers: Indices, found: int) -> int:
    for row in range(rgb.shape[0]):
        for column in range(rgb.shape[1]):
            code = np.int64(rgb[row, column, 0]) << 16 | np.int64(rgb[row, column, 1]) << 8 | rgb[row, column, 2]
            if index[code] == 0:
                if found == len(codes):
                    return found + 1
                codes[found] = code
                found += 1
                index[code] = found
            numbers[row, column] = index[code] - 1
    return found


def enlargement(numbers: Indices) -> int:
    """The greatest n for which a picture consists of n × n equal pixels; 1 for a picture of one colour.

    >>> enlargement(np.repeat(np.repeat(np.array([[0, 1], [1, 0]], np.uint8), 3, 0), 3, 1))
    3
    """
    height, width = numbers.shape
    scale = math.gcd(height, width)
    changed_rows = np.zeros(height, dtype=bool)
    changed_columns = np.zeros(width, dtype=bool)
    for band in bands(height, width):
        part = numbers[max(band.start - 1, 0) : band.stop]
        changed_rows[max(band.start, 1) : band.stop] = (part[1:] != part[:-1]).any(axis=1)
        changed_columns[1:] |= (part[:, 1:] != part[:, :-1]).any(axis=0)
        if changed_rows[1] or changed_columns[1]:
            return 1
    edges = [*np.flatnonzero(changed_rows).tolist(), *np.flatnonzero(changed_columns).tolist()]
    return math.gcd(scale, *edges) if edges else 1


def measured(few: FewColours, progress: Progress = SILENT) -> Details:
    """The measures that tell whether a picture of few colours is drawn pixel by pixel."""
    numbers = np.ascontiguousarray(few.numbers)
    height, width = numbers.shape
    count = len(few.palette)
    pairs = np.zeros((count, count), dtype=np.int64)
    tally = np.zeros(2, dtype=np.int64)
    palette = few.palette.astype(np.int64)
    for band in bands(height, width):
        _look(numbers, palette, band.start, band.stop, pairs, tally)
        progress(band.stop / height)
    pairs = pairs + pairs.T
    labs = srgb_to_lab(few.palette)
    differences = np.stack([delta_e_2000(labs, lab) for lab in labs])
    np.fill_diagonal(differences, 0.0)
    shares = np.bincount(numbers.ravel(), minlength=count) / numbers.size
    apart = np.outer(shares, shares)
    alike = float(np.trace(pairs) / max(int(pairs.sum()), 1))
    near = _mean_difference(pairs.astype(float), differences)
    contrast = near / max(_mean_difference(apart, differences), 1e-9)
    return Details(float(tally[0]) / numbers.size, float(tally[1]) / numbers.size, alike, contrast)


def _mean_difference(weights: FloatArray, differences: FloatArray) -> float:
    """Mean over the pairs of two colours."""
    weights = weights.copy()
    np.fill_diagonal(weights, 0.0)
    return float((weights * differences).sum() / max(float(weights.sum()), 1e-12))


@compiled
def _is_mix(before: IntArray, colour: IntArray, after: IntArray) -> bool:
    """Whether a colour lies between two others, near the line from one to the other."""
    length = along = across = 0.0
    for channel in range(3):
        span = float(after[channel] - before[channel])
        step = float(colour[channel] - before[channel])
        length += span * span
        along += span * step
        across += step * step
    if length == 0.0:
        return False
    share = along / length
    off = across - share * along
    return bool(_MIX < share < 1 - _MIX and off <= 12.0 + 0.01 * length)


@compiled
def _look(  # noqa: PLR0917
    numbers: Indices, palette: Int[np.ndarray, "colours 3"], first: int, stop: int, pairs: IntArray, tally: IntArray
) -> None:
    height, width = numbers.shape
    for row in range(first, stop):
        for column in range(width):
            own = numbers[row, column]
            thin = mixed = False
            if column + 1 < width:
                pairs[own, numbers[row, column + 1]] += 1
                if column > 0 and numbers[row, column - 1] != own and numbers[row, column + 1] != own:
                    mix = _is_mix(palette[numbers[row, column - 1]], palette[own], palette[numbers[row, column + 1]])
                    mixed |= mix
                    thin |= not mix
            if row + 1 < height:
                pairs[own, numbers[row + 1, column]] += 1
                if row > 0 and numbers[row - 1, column] != own and numbers[row + 1, column] != own:
                    mix = _is_mix(palette[numbers[row - 1, column]], palette[own], palette[numbers[row + 1, column]])
                    mixed |= mix
                    thin |= not mix
            tally[0] += thin and not mixed
            tally[1] += mixed
