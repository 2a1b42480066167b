"""Exact reading: the grid of the picture is the grid of knots.

A chart or a drawing made knot by knot states its own grid. Size and quality then follow from each other:

    columns = width · across,   rows = length · along
"""

from ilmek.carpet.design import knot_grid
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize


def has_grid(grid: tuple[int, int], size: CarpetSize, quality: Quality) -> bool:
    """Whether a carpet of this size and quality has these rows and columns; False also where it cannot be woven."""
    return (round(size.length * quality.along), round(size.width * quality.across)) == grid and min(grid) > 1


def of_grid(
    grid: tuple[int, int], size: CarpetSize | None, quality: Quality | None, usual: Quality
) -> tuple[CarpetSize, Quality]:
    """Size and quality of a carpet of these rows and columns, of which at most one is given.

    usual  the quality where neither is given
    Raises CarpetError where the other is out of bounds.
    """
    rows, columns = grid
    if size is not None:
        quality = quality or Quality(columns / size.width, rows / size.length)
    else:
        quality = quality or usual
        size = CarpetSize(columns / quality.across, rows / quality.along)
    knot_grid(size, quality)
    return size, quality
