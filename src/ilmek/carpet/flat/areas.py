"""Areas of labels in the cells of knots, in integers, and claims to knots by area."""

import numpy as np

from ilmek.arrays import Indices, NumberArray, UInt8
from ilmek.num.compiled import uncounted

NONE = 255
"""The label of a knot that nothing has claimed."""


@uncounted
def area_share(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"], rows: int, columns: int, row: int, column: int, label: int
) -> int:
    """Area of a label in a cell; the whole cell has 65536."""
    height, width = labels.shape
    area = 0
    for y in range(row * height // rows, ((row + 1) * height - 1) // rows + 1):
        deep = min((row + 1) * height, (y + 1) * rows) - max(row * height, y * rows)
        for x in range(column * width // columns, ((column + 1) * width - 1) // columns + 1):
            if labels[y, x] == label:
                area += deep * (min((column + 1) * width, (x + 1) * columns) - max(column * width, x * columns))
    return int(area * 65536 // (height * width))


@uncounted
def take_knot(claims: Indices, shares: NumberArray, row: int, column: int, label: int, share: int) -> None:  # noqa: PLR0917
    """A claim to a knot: of several, that with the largest share of the cell has it; then the darkest colour."""
    before = claims[row, column]
    if before == NONE or share > shares[row, column] or (share == shares[row, column] and label < before):
        claims[row, column], shares[row, column] = label, share
