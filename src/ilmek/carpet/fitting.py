"""Fit: the picture's part that the carpet shows, and its proportions.

Order: the carpet is straightened from its corners (`corners`), turned (`turn`), cropped (`crop`), and what is left is
fitted to the carpet's proportions, width : length (`fit`). A picture that then has the grid of the knots is left as it
is: each of its pixels is a knot.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from ilmek.arrays import Rgb
from ilmek.carpet.design import LARGEST_DISTORTION, bands, distortion
from ilmek.carpet.outline import find_outline
from ilmek.carpet.picture_points import Colour, hex_colour, in_pixels, read_colour, read_points
from ilmek.carpet.projection import MadeRgb, inner_rectangle, outer_rectangle, projected, rotation_about
from ilmek.carpet.sizes import LARGEST, SMALLEST, CarpetSize
from ilmek.carpet.straightening import check_corners, straightened, true_proportions
from ilmek.carpet.subject import subject_start
from ilmek.errors import PictureError, shortened
from ilmek.params import Params, kind
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.sentences import Sentence
from ilmek.units import deg, format_quantity

FITS = ("auto", "crop", "pad", "stretch", "turn")
CORNERS_EXAMPLE = Sentence("picture.corners-example")
CROP_EXAMPLE = Sentence("picture.crop-example")

MOST_PADDED = 200_000_000
"""Largest number of pixels of a picture with its padding: 0.6 GB."""

AUTO = "auto"

_CREDIBLE = 0.1
"""Largest relative difference within which a photographed carpet has the proportions of what is woven of it."""

_CLEARLY = 0.2
"""Difference of two relative differences of proportions from which a photographed carpet lies where its size stands."""

_WHOLE = (0.0, 0.0, 1.0, 1.0)

_SAME = 12
"""Largest difference of a channel within which the pixels of a border count as one colour."""


@dataclass(frozen=True, slots=True)
class FitParams(Params):
    """How a picture is fitted to the carpet: straightened, turned, cropped and fitted, in this order."""

    width: float | None = kind.length(
        None,
        unit="cm",
        at_least=SMALLEST,
        at_most=LARGEST,
        doc="width of the carpet, whose length then follows from the picture",
    )
    length: float | None = kind.length(
        None,
        unit="cm",
        at_least=SMALLEST,
        at_most=LARGEST,
        doc="length of the carpet, whose width then follows from the picture",
    )

    fit: str = kind.choice(
        "auto",
        FITS,
        doc="what is done where the proportions of picture and carpet differ: crop about the subject, pad, stretch, or "
        "turn by 90 degrees where that suits better and then as auto; auto: up to 2 % is stretched, else cropped",
    )
    ground: str | None = kind.text(
        None,
        doc="colour behind transparent parts, of margins, and of cells that a chart of another program leaves without "
        "a stitch, like #e8dfc8; default: white, or dark where that hides the outline; of margins that of the "
        "picture's border",
    )
    corners: str | None = kind.text(
        None,
        doc="corners of a carpet photographed at an angle, in pixels or percent: top left, top right, bottom right, "
        "bottom left; auto: found in the picture where the outline is clear",
    )
    crop: str | None = kind.text(
        None, doc='part of the picture that is used, by two opposite corners in pixels or percent: "10%,5% 90%,95%"'
    )
    turn: float = kind.angle(
        0.0, at_least=-360 * deg, at_most=360 * deg, doc="angle by which the picture is turned clockwise, like 90deg"
    )
    page: int = kind.count(1, at_least=1, at_most=10_000, doc="page of a PDF file that is the picture")

    @property
    def size(self) -> CarpetSize | None:
        """The size of the carpet where both sides are given."""
        return None if self.width is None or self.length is None else CarpetSize(self.width, self.length)

    @property
    def without_sides(self) -> "FitParams":
        """The same without a side of the carpet, once its size is known."""
        return replace(self, width=None, length=None)

    @property
    def only_turned(self) -> bool:
        """Whether the picture is turned, not by right angles alone, and all else is in shares of its sides."""
        quarters = self.turn / (math.pi / 2)
        in_shares = self.corners is None and (self.crop is None or self.crop.count("%") == 4)
        return in_shares and abs(quarters - round(quarters)) >= 1e-9

    def check_together(self) -> None:
        """Raise ParameterError for texts that are no points or colours."""
        if self.corners not in (None, AUTO):
            read_points("corners", self.corners, 4, CORNERS_EXAMPLE)
        if self.crop is not None:
            read_points("crop", self.crop, 2, CROP_EXAMPLE)
        if self.ground is not None:
            read_colour("ground", self.ground)


@record
class Fit:
    """What was done to fit the picture.

    kind     whole: its proportions are the carpet's; else stretch, crop or pad
    stretch  of the picture's width against its height [-]; negative where it is compressed
    cropped  share of the straightened and turned picture that the carpet does not show [-]
    padded   share of the carpet that is border [-]        border  colour of that border, `#rrggbb`
    turned   angle by which the picture was turned clockwise [rad]
    corners  of the carpet in the photograph [pixels]; None: it was not straightened
    clearness  of the outline, 0 to 1, where the corners were found in the picture
    shown    left, top, right and bottom of what the carpet shows, as shares of the prepared picture; beyond 0 and 1
             where it is padded
    outside  share of a round picture that lies outside of its outline, and has no ground of its own [-]
    hidden   share of the picture's outline that is hidden on the ground behind its transparent parts [-]
    """

    kind: str = "whole"
    stretch: float = 0.0
    cropped: float = 0.0
    padded: float = 0.0
    border: str | None = None
    turned: float = 0.0
    corners: tuple[tuple[float, float], ...] | None = None
    clearness: float | None = None
    shown: tuple[float, float, float, float] = _WHOLE
    outside: float = 0.0
    hidden: float = 0.0

    @property
    def words(self) -> str:
        """What was done, in words, in the order in which it was done."""
        done = []
        if self.corners:
            found = "" if self.clearness is None else f" (found, clearness {self.clearness:.2f})"
            done.append(f"straightened from {' '.join(f'{x:.1f},{y:.1f}' for x, y in self.corners)}{found}")
        if self.turned:
            turned = self.turned - (2 * math.pi if self.turned > math.pi else 0.0)
            done.append(f"turned by {format_quantity(turned, 'deg')}")
        if self.cropped:
            done.append(f"cropped, {format_quantity(self.cropped, '%', 3)} of the picture is not shown")
        if self.padded:
            done.append(f"border of {self.border}, {format_quantity(self.padded, '%', 3)} of the carpet")
        if abs(self.stretch) >= 0.0005:
            sense = "wider" if self.stretch > 0 else "narrower"
            done.append(f"drawn {format_quantity(abs(self.stretch), '%', 3)} {sense}")
        return ", ".join(done) or "whole picture"


def prepare_picture(
    rgb: Rgb, params: FitParams, progress: Progress = SILENT, *, size: CarpetSize | None = None
) -> tuple[MadeRgb, Fit]:
    """The picture straightened, turned by a stated angle and cropped to a stated part, and what was done.

    size  of the carpet, whose proportions a photographed carpet has; default: those of its corners in perspective

    Raises PictureError for corners of no rectangle, and for a part that is empty or not in the picture.
    """
    rgb, straight, params = _straightened(rgb, params, size, progress.part(0.0, 0.6))
    picture, fit = _turned(rgb, params, progress.part(0.6, 1.0))
    fit = replace(fit, corners=straight.corners, clearness=straight.clearness)
    if params.crop is None:
        return picture, fit
    part = _cut(picture, params.crop)
    return part, replace(fit, cropped=1 - (1 - fit.cropped) * _area(part) / _area(picture))


def fit_prepared(
    rgb: Rgb,
    fit: Fit,
    size: CarpetSize,
    params: FitParams,
    progress: Progress = SILENT,
    *,
    grid: tuple[int, int] | None = None,
) -> tuple[MadeRgb, Fit]:
    """A prepared picture as the carpet shows it by `params.fit`, and all that was done to it.

    fit   what was done to prepare it      size  of the carpet
    grid  rows and columns of knots: a picture with that grid is not stretched, cropped or padded

    The result has the carpet's proportions up to `Fit.stretch`; it is a view of the picture where nothing but its edges
    changes or it is turned by right angles.
    """
    if params.fit == "turn" and rgb.shape[:2] != grid and _suits_turned(rgb, size):
        rgb, fit = np.rot90(rgb, -1), replace(fit, turned=(fit.turned + math.pi / 2) % (2 * math.pi))
    if rgb.shape[:2] == grid:
        return rgb, fit
    if params.fit == "pad":
        border = read_colour("border", fit.border or params.ground or hex_colour(border_colour(rgb)))
        made = _padded(rgb, size, border, progress)
        padded = 1 - (1 - fit.padded) * _area(rgb) / _area(made)
        fit = replace(fit, padded=padded, border=hex_colour(border) if padded else None)
    elif params.fit == "stretch" or (params.fit != "crop" and abs(distortion(rgb, size)) <= LARGEST_DISTORTION):
        made = rgb
    else:
        made, part = _about_the_subject(rgb, size)
        fit = replace(fit, cropped=1 - (1 - fit.cropped) * _area(made) / _area(rgb), shown=part)
    stretch = distortion(made, size)
    name = "pad" if fit.padded else "crop" if made.shape != rgb.shape else "stretch" if stretch else "whole"
    shown = fit.shown if name == "crop" else _shown(rgb, made)
    return made, replace(fit, kind=name, stretch=stretch, shown=shown)


def fit_notes(fit: Fit, pixels: tuple[int, ...], size: CarpetSize, grid: tuple[int, int]) -> tuple[str, ...]:
    """Notes on a picture that is cropped, stretched, or coarser than the carpet.

    pixels  height and width of the fitted picture      grid  rows and columns of cells
    """
    (height, width), (rows, columns) = pixels, grid
    notes = []
    if fit.kind == "crop" or abs(fit.stretch) > LARGEST_DISTORTION:
        left, top, right, bottom = fit.shown
        cut = 1 - (right - left) * (bottom - top) if fit.kind == "crop" else 0.0
        done = f"{format_quantity(cut, '%', 3)} of the picture is cut off" if cut else "the picture is stretched"
        notes.append(
            f"{done}, which has other proportions than {size}: --size auto keeps it as it is, one side, --width or "
            "--length, gives the other, and --fit offers crop, pad, stretch and turn"
        )
    if width < columns or height < rows:
        pixels_of, cells = f"{width} x {height} pixels", f"{columns} x {rows} cells"
        notes.append(f"the picture ({pixels_of}) is coarser than the chart ({cells}): edges will be stepped")
    return tuple(notes)


def _area(rgb: Rgb) -> int:
    return int(rgb.shape[0]) * int(rgb.shape[1])


def border_colour(rgb: Rgb) -> Colour:
    """The colour of a picture's border: the median of the outermost pixels, channel by channel, where at least half of
    them have nearly that colour; else white.
    """
    border = np.concatenate([rgb[0], rgb[-1], rgb[1:-1, 0], rgb[1:-1, -1]])
    red, green, blue = np.sort(border, axis=0)[len(border) // 2].tolist()
    near = np.abs(border.astype(int) - (red, green, blue)).max(axis=1) <= _SAME
    return (red, green, blue) if 2 * np.count_nonzero(near) >= len(border) else (255, 255, 255)


def _straightened(
    rgb: Rgb, params: FitParams, size: CarpetSize | None, progress: Progress
) -> tuple[MadeRgb, Fit, FitParams]:
    """The carpet between the corners with its true proportions, and how it is to be turned then.

    They are those of the size, so that nothing of the carpet is cut; those of the perspective where no size is given,
    and where it is that of a part. A carpet that lies in the photograph is turned to stand as its size does.
    """
    if params.corners is None:
        return rgb, Fit(), params
    height, width = int(rgb.shape[0]), int(rgb.shape[1])
    if params.corners == AUTO:
        corners, clearness = find_outline(rgb, progress.part(0.0, 0.3))
    else:
        corners = in_pixels(read_points("corners", params.corners, 4, CORNERS_EXAMPLE), width, height)
        clearness = None
    check_corners(corners, width, height, f"corners={shortened(params.corners)!r}")
    proportions = true_proportions(corners, width, height)
    if size is not None:
        wanted, turned = size.width / size.length, params.turn % math.pi
        crosswise = math.pi / 4 < turned < 3 * math.pi / 4
        lies = abs(math.log(proportions * wanted)) + _CLEARLY < abs(math.log(proportions / wanted))
        if lies and params.turn == 0.0 and params.crop is None:
            params, crosswise = replace(params, turn=math.pi / 2), True
        of_the_size = 1 / wanted if crosswise else wanted
        if params.crop is None or abs(proportions / of_the_size - 1) <= _CREDIBLE:
            proportions = of_the_size
    picture = straightened(rgb, corners, proportions, progress.part(0.3, 1.0))
    return picture, Fit(corners=tuple((x, y) for x, y in corners.tolist()), clearness=clearness), params


def _turned(rgb: Rgb, params: FitParams, progress: Progress) -> tuple[MadeRgb, Fit]:
    """The picture turned clockwise: by right angles exactly, else resampled.

    Then the largest rectangle without corners from outside the picture is kept, with fit pad the whole picture.
    """
    quarters, fit = params.turn / (math.pi / 2), Fit(turned=params.turn % (2 * math.pi))
    if abs(quarters - round(quarters)) < 1e-9:
        return (np.rot90(rgb, -round(quarters)), fit) if round(quarters) % 4 else (rgb, Fit())
    height, width = int(rgb.shape[0]), int(rgb.shape[1])
    if params.fit == "pad":
        shape = outer_rectangle(width, height, params.turn)
        _check_padded(shape)
        outside = params.ground or hex_colour(border_colour(rgb))
        fit = replace(fit, padded=1 - width * height / (shape[0] * shape[1]), border=outside)
        border = read_colour("ground", outside)
    else:
        shape, border = inner_rectangle(width, height, params.turn), None
        fit = replace(fit, cropped=1 - shape[0] * shape[1] / (width * height))
    return projected(rgb, shape, rotation_about(params.turn, (height, width), shape), border, progress), fit


def _cut(rgb: Rgb, text: str) -> MadeRgb:
    """The part of the picture between two opposite corners, rounded to whole pixels."""
    height, width = int(rgb.shape[0]), int(rgb.shape[1])
    corners = np.rint(in_pixels(read_points("crop", text, 2, CROP_EXAMPLE), width, height)).astype(int)
    (left, top), (right, bottom) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    allowed = Sentence("picture.crop-bounds", width=width, height=height)
    if left < 0 or top < 0 or right > width or bottom > height:
        raise PictureError(Sentence("picture.crop-outside", crop=text), allowed=allowed, do=CROP_EXAMPLE)
    if left == right or top == bottom:
        raise PictureError(Sentence("picture.empty-part", crop=text), allowed=allowed, do=CROP_EXAMPLE)
    return rgb[top:bottom, left:right]


def _suits_turned(rgb: Rgb, size: CarpetSize) -> bool:
    """Whether the picture turned by 90 degrees is nearer to the carpet's proportions."""
    height, width = rgb.shape[:2]
    return bool((width - height) * (size.width - size.length) < 0)


def _sides(rgb: Rgb, size: CarpetSize, *, larger: bool) -> tuple[int, int]:
    """(height, width) with the carpet's proportions within or around the picture.

    A side differs from the picture's by an even number, so that the centre stays.
    """
    height, width = int(rgb.shape[0]), int(rgb.shape[1])
    proportions = size.width / size.length
    if (width > height * proportions) != larger:
        return height, _of_same_parity(height * proportions, width)
    return _of_same_parity(width / proportions, height), width


def _of_same_parity(side: float, like: int) -> int:
    """The positive whole number nearest to `side` that is even where `like` is, odd where it is odd."""
    odd = like % 2
    return max(2 * round((side - odd) / 2) + odd, 2 - odd)


def _about_the_subject(rgb: Rgb, size: CarpetSize) -> tuple[MadeRgb, tuple[float, float, float, float]]:
    """The largest part with the carpet's proportions about the subject, and its place, as of `Fit.shown`."""
    whole = int(rgb.shape[0]), int(rgb.shape[1])
    height, width = _sides(rgb, size, larger=False)
    if (height, width) == whole:
        return rgb, _WHOLE
    top = 0 if height == whole[0] else subject_start(rgb, height, across=False)
    left = 0 if width == whole[1] else subject_start(rgb, width, across=True)
    shown = left / whole[1], top / whole[0], (left + width) / whole[1], (top + height) / whole[0]
    return rgb[top : top + height, left : left + width], shown


def _shown(rgb: Rgb, made: Rgb) -> tuple[float, float, float, float]:
    """Left, top, right and bottom of a part, or of a padded picture, about the picture's centre, as shares of it."""
    height, width = int(rgb.shape[0]), int(rgb.shape[1])
    top, left = (height - int(made.shape[0])) // 2, (width - int(made.shape[1])) // 2
    return left / width, top / height, (left + made.shape[1]) / width, (top + made.shape[0]) / height


def _padded(rgb: Rgb, size: CarpetSize, border: Colour, progress: Progress) -> MadeRgb:
    """The picture in the middle of a border, with the carpet's proportions."""
    height, width = _sides(rgb, size, larger=True)
    if (height, width) == rgb.shape[:2]:
        return rgb
    _check_padded((height, width))
    made = np.empty((height, width, 3), dtype=np.uint8)
    line = np.full((width, 3), border, dtype=np.uint8)
    top, left = (height - rgb.shape[0]) // 2, (width - rgb.shape[1]) // 2
    for band in bands(height, width):
        made[band] = line
        first, stop = max(band.start, top), min(band.stop, top + rgb.shape[0])
        if first < stop:
            made[first:stop, left : left + rgb.shape[1]] = rgb[first - top : stop - top]
        progress(band.stop / height)
    return made


def _check_padded(shape: tuple[int, int]) -> None:
    if shape[0] * shape[1] > MOST_PADDED:
        raise PictureError(
            Sentence("picture.padded", width=shape[1], height=shape[0]),
            allowed=Sentence("picture.padded-most", count=MOST_PADDED // 1_000_000),
            do=Sentence("picture.padded-do"),
        )
