"""Mirrors: a half or a quarter of a carpet that is completed by reflection.

On an odd number of columns (rows) the middle one belongs to the given part, which has it as its last.
"""

from ilmek.arrays import Indices, Pixels

MIRRORS = ("across", "along", "both")
"""across: the left half is given; along: the upper half; both: the upper left quarter."""


def part_grid(mirror: str, grid: tuple[int, int]) -> tuple[int, int]:
    """Rows and columns of the part that is given for a grid.

    mirror  across: the left half; along: the upper half; both: the upper left quarter; "": the whole

    >>> part_grid("both", (451, 300))
    (226, 150)
    """
    rows, columns = grid
    halves = (mirror in ("along", "both"), mirror in ("across", "both"))
    return (-(-rows // 2) if halves[0] else rows), (-(-columns // 2) if halves[1] else columns)


def complete(colours: Pixels | Indices, mirror: str) -> None:
    """Complete an area of colours (rows, columns, 3) or yarns, whose given part is drawn, by reflection, in place.

    >>> import numpy as np
    >>> area = np.array([[[1, 1, 1], [2, 2, 2], [0, 0, 0]]], dtype=np.uint8)
    >>> complete(area, "across")
    >>> area[..., 0].tolist()
    [[1, 2, 1]]
    """
    rows, columns = colours.shape[:2]
    if mirror in ("across", "both"):
        colours[:, columns - columns // 2 :] = colours[:, : columns // 2][:, ::-1]
    if mirror in ("along", "both"):
        colours[rows - rows // 2 :] = colours[: rows // 2][::-1]
