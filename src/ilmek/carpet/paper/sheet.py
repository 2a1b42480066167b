"""A sheet of squared paper, read: one knot a cell, with a confidence.

lines → lattice → cells → colours, each in its module.
"""

import numpy as np

from ilmek.arrays import BoolArray, Float, Indices, Rgb, UInt8
from ilmek.carpet.paper.cells import Cells, read_cells
from ilmek.carpet.paper.colours import cell_colours
from ilmek.carpet.paper.lattice import find_lattice
from ilmek.carpet.paper.lines import line_energy
from ilmek.progress import SILENT, Progress
from ilmek.records import record


@record
class PaperReading:
    """What was read from a sheet.

    palette     sRGB of its colours, most cells first     numbers   of each cell's colour (rows, columns)
    confidence  of each cell, 0 to 1                      doubtful  the cells to be looked at
    cells       where they lie in the picture, and how they look there
    """

    palette: UInt8[np.ndarray, "colours 3"]
    numbers: Indices
    confidence: Float[np.ndarray, "rows columns"]
    doubtful: BoolArray
    cells: Cells

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


def read_sheet(rgb: Rgb, progress: Progress = SILENT) -> PaperReading:
    """The chart on a sheet of squared paper. Raises PictureError where no grid is found."""
    rgb = np.ascontiguousarray(rgb)
    energy = line_energy(rgb, progress.part(0.0, 0.4))
    lattice = find_lattice(energy)
    progress(0.8)
    cells = read_cells(rgb, energy, lattice)
    progress(0.9)
    found = cell_colours(cells.colours, cells.spread)
    return PaperReading(found.palette, found.numbers, found.confidence, found.doubtful, cells)
