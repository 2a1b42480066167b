"""A sheet of squared paper, read: one knot a cell, with a confidence.

lines → lattice → cells → colours, each in its module.

A picture that nobody calls a sheet is one where its lines repeat nearly everywhere, are strong, and its cells are many,
even and of few colours: exports of chart programs are, no photograph, carpet or drawing that was tried.
"""

import math

import numpy as np

from ilmek.arrays import BoolArray, Float, Indices, Int64, Rgb, UInt8
from ilmek.carpet.paper.cells import MOST_ALTERNATING, Cells, read_cells
from ilmek.carpet.paper.colours import cell_colours
from ilmek.carpet.paper.lattice import divided, find_lattice
from ilmek.carpet.paper.lines import NEARLY_EVERYWHERE, SOMEWHERE, LineEnergy, Spread, line_energy, no_grid, pitches
from ilmek.carpet.paper.parts import parts
from ilmek.carpet.paper.placing import border_beside, off_lattice
from ilmek.errors import PictureError
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.units import counted

_LEAST_CELLS, _LEAST_EVEN, _EVEN, _MOST_DOUBTFUL, _LEAST_LINES, _MOST_COLOURS = 16, 0.9, 10.0, 0.03, 3.0, 64
"""Of such a picture: cells along each side, share of even cells and their range of lightness [codes], share of doubtful
cells, coherence of the lines, number of colours."""

_CLEAR, _CLEARER, _MOST_PITCHES = 1.0, 1.2, 3
"""Coherence of the lines from which on no heavy lines are looked for; ratio from which on the lines of twice
a pitch are the lines, and not letters; number of pitches that are tried."""

_LEAST_CHANGING = 8
"""Least number of lines at which colours change that says whether they are all even, or all odd."""

MOST_SHOWN, VIEW = 500, 60
"""Largest number of doubtful cells that are shown, and side of the view of each [pixels]."""


@record
class PaperReading:
    """What was read from a sheet.

    palette     sRGB of its colours, most cells first     numbers   of each cell's colour (rows, columns)
    confidence  of each cell, 0 to 1                      doubtful  the cells to be looked at
    cells       where they lie in the picture, and how they look there
    beside      share of a side beside which the drawing seems to go on, on the worst side
    shown       row and column of the most doubtful cells, from the top left, 0 first; at most MOST_SHOWN
    views       the picture about each of these, VIEW pixels and three cells wide
    stated      size and quality of the carpet were given, and they state the same grid
    """

    palette: UInt8[np.ndarray, "colours 3"]
    numbers: Indices
    confidence: Float[np.ndarray, "rows columns"]
    doubtful: BoolArray
    cells: Cells
    beside: float
    shown: Int64[np.ndarray, "shown 2"]
    views: UInt8[np.ndarray, "shown side side 3"]
    stated: bool = False

    @property
    def grid(self) -> tuple[int, int]:
        """Rows and columns."""
        return int(self.numbers.shape[0]), int(self.numbers.shape[1])

    @property
    def rgb(self) -> Rgb:
        """The chart as a picture: each cell one pixel."""
        colours: Rgb = self.palette[self.numbers]
        return colours

    @property
    def doubts(self) -> int:
        """Number of doubtful cells."""
        return int(np.count_nonzero(self.doubtful))

    @property
    def on_every_second(self) -> float:
        """The share of the changes of colour on every second line, down or across; 0.5 where few lines have changes."""
        return min(_on_every_second(self.numbers), _on_every_second(self.numbers.T))

    @property
    def words(self) -> str:
        """What was found, for the user."""
        rows, columns = self.grid
        found = f"{columns} × {rows} cells in {counted(len(self.palette), 'colour')}"
        return f"squared paper of {found}, {f'{self.doubts:,} of them doubtful' if self.doubts else 'none doubtful'}"

    @property
    def certain(self) -> bool:
        """Whether this is squared paper though nobody said so."""
        return (
            min(self.grid) >= _LEAST_CELLS
            and len(self.palette) <= _MOST_COLOURS
            and self.cells.usual >= _LEAST_LINES
            and float(np.mean(self.cells.spread < _EVEN)) >= _LEAST_EVEN
            and self.doubts <= _MOST_DOUBTFUL * self.numbers.size
        )


def _on_every_second(numbers: Indices) -> float:
    """The larger share of the changes along the rows that lie on the odd lines, or on the even ones."""
    changes = np.count_nonzero(np.diff(numbers, axis=1), axis=0)
    if np.count_nonzero(changes) < _LEAST_CHANGING:
        return 0.5
    return float(max(changes[::2].sum(), changes[1::2].sum()) / changes.sum())


def squared_paper(rgb: Rgb, progress: Progress = SILENT) -> PaperReading | None:
    """The chart on a picture that is squared paper beyond doubt; None: it is not."""
    try:
        reading = read_sheet(rgb, progress, NEARLY_EVERYWHERE)
    except PictureError:
        return None
    return reading if reading.certain else None


def read_sheet(rgb: Rgb, progress: Progress = SILENT, spread: Spread = SOMEWHERE) -> PaperReading:
    """The chart on a sheet of squared paper whose lines extend so far.

    Raises PictureError where no grid is found.
    """
    rgb = np.ascontiguousarray(rgb)
    energy, cells = _clearest(rgb, progress.part(0.0, 0.9), spread)
    colours = cell_colours(cells.colours, cells.spread)
    doubtful = colours.doubtful | off_lattice(cells.x, cells.y)
    beside = border_beside(cells.around, colours.palette, colours.numbers)
    rows, columns = np.nonzero(doubtful)
    order = np.argsort(colours.confidence[rows, columns], kind="stable")[:MOST_SHOWN]
    shown = np.stack([rows[order], columns[order]], axis=-1)
    pitch = energy.factor * 0.5 * (energy.pitch_x + energy.pitch_y)
    views = _views(rgb, cells.x[rows, columns][order], cells.y[rows, columns][order], pitch)
    return PaperReading(colours.palette, colours.numbers, colours.confidence, doubtful, cells, beside, shown, views)


def _clearest(rgb: Rgb, progress: Progress, spread: Spread) -> tuple[LineEnergy, Cells]:
    """The cells of the pitch whose lines are clearest; heavy lines, clearer still, are at many times the pitch."""
    likely = pitches(rgb, spread)[:_MOST_PITCHES]
    progress(0.1)
    if not likely:
        raise no_grid("no lines at equal distances")
    clearest: tuple[LineEnergy, Cells] | None = None
    refusals: list[PictureError] = []
    finest = 0.0  # product of both pitches
    for pitch in likely:
        multiple = math.sqrt(pitch[0] * pitch[1] / finest) if clearest else 1.0
        if clearest and clearest[1].usual >= _CLEAR and _every(clearest[1]) and abs(multiple - 2) > 0.3:
            continue
        energy = line_energy(rgb, pitch, progress.part(0.1, 0.5))
        try:
            lattice = find_lattice(energy)
            number = parts(rgb, lattice, min(pitch))
            if number > 1:
                pitch = (pitch[0] / number, pitch[1] / number)
                energy = line_energy(rgb, pitch, progress.part(0.5, 0.6))
                lattice = divided(lattice, number, energy)
            cells = read_cells(rgb, energy, lattice)
        except PictureError as refusal:
            refusals.append(refusal)
            continue
        if clearest is None or _clearer(cells, clearest[1]):
            clearest, finest = (energy, cells), pitch[0] * pitch[1]
    if clearest is None:
        raise refusals[0]
    return clearest


def _every(cells: Cells) -> bool:
    """Whether lines are at every place, and not at every second one only."""
    return cells.alternating <= MOST_ALTERNATING


def _clearer(cells: Cells, before: Cells) -> bool:
    """Whether the lines of another pitch are the lines, rather than those before."""
    if _every(cells) != _every(before):
        return _every(cells) and cells.usual >= _CLEAR
    return cells.usual > _CLEARER * before.usual


def _views(
    rgb: Rgb, x: Float[np.ndarray, " shown"], y: Float[np.ndarray, " shown"], pitch: float
) -> UInt8[np.ndarray, "shown side side 3"]:
    """The picture about points, VIEW × VIEW pixels for three cells each."""
    reach = (np.arange(VIEW) + 0.5) / VIEW * 3 * pitch - 1.5 * pitch
    across = np.clip(x[:, None] + reach, 0, rgb.shape[1] - 1).astype(np.intp)
    along = np.clip(y[:, None] + reach, 0, rgb.shape[0] - 1).astype(np.intp)
    views: UInt8[np.ndarray, "shown side side 3"] = rgb[along[:, :, None], across[:, None, :]]
    return views
