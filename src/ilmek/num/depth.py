"""Kernels of a depth picture: triangles into pixels, and which pieces of lines are seen.

Coordinates in pixels: x to the right, y up, z towards the eye; the centre of pixel (row, column) is (column, row). A
point of a triangle with corners a, b, c is a + u (b - a) + v (c - a), 0 <= u, v, u + v <= 1.

A line is hidden where it lies farther than `slack` behind the farthest of the nine pixels about it: the one under it
shows what is on both sides of an edge. So an edge is seen up to a pixel beyond what covers it.
"""

import numpy as np

from ilmek.arrays import Bool, Float, Float32, Int, Int32
from ilmek.num.compiled import compiled, uncounted


@uncounted
def draw_triangles(
    corners: Float[np.ndarray, "n 3 3"],
    number: int,
    depth: Float32[np.ndarray, "rows columns"],
    numbers: Int32[np.ndarray, "rows columns"],
) -> None:
    """Draw triangles of a number into a picture: where they are nearest, `depth` is their z, `numbers` the number."""
    rows, columns = depth.shape
    for k in range(corners.shape[0]):
        ax, ay, az = corners[k, 0]
        bx, by, bz = corners[k, 1, 0] - ax, corners[k, 1, 1] - ay, corners[k, 1, 2] - az
        cx, cy, cz = corners[k, 2, 0] - ax, corners[k, 2, 1] - ay, corners[k, 2, 2] - az
        area = bx * cy - by * cx
        if area <= 0:
            continue
        low = max(0, int(np.ceil(ay + min(0.0, by, cy))))
        high = min(rows - 1, int(np.floor(ay + max(0.0, by, cy))))
        across, upwards = (bz * cy - cz * by) / area, (cz * bx - bz * cx) / area
        for row in range(low, high + 1):
            y = row - ay
            left, right = np.floor(ax + min(0.0, bx, cx)), np.ceil(ax + max(0.0, bx, cx))
            # Along the row u area = x cy - y cx, v area = y bx - x by and their sum stay between 0 and the area.
            for slope, level in ((cy, y * cx), (-by, -y * bx), (by - cy, y * (bx - cx) - area)):
                if slope > 0:
                    left = max(left, ax + level / slope)
                elif slope < 0:
                    right = min(right, ax + level / slope)
            for column in range(max(0, int(np.ceil(left))), min(columns - 1, int(np.floor(right))) + 1):
                z = az + across * (column - ax) + upwards * y
                if z > depth[row, column]:
                    depth[row, column] = z
                    numbers[row, column] = number


@uncounted
def is_seen(x: float, y: float, z: float, depth: Float32[np.ndarray, "rows columns"], slack: float) -> bool:
    """Whether a point is not behind all of the nine pixels about it; beyond the picture it is seen."""
    rows, columns = depth.shape
    row, column = int(np.round(y)), int(np.round(x))
    if row < 1 or column < 1 or row > rows - 2 or column > columns - 2:
        return True
    for i in range(row - 1, row + 2):
        for j in range(column - 1, column + 2):
            if z + slack >= depth[i, j]:
                return True
    return False


@compiled
def seen_samples(
    starts: Float[np.ndarray, "n 3"],
    ends: Float[np.ndarray, "n 3"],
    counts: Int[np.ndarray, " n"],
    depth: Float32[np.ndarray, "rows columns"],
    slack: float,
) -> Bool[np.ndarray, " samples"]:
    """Whether samples of lines are seen: of each line so many, in the middles of equal pieces of it."""
    seen = np.zeros(counts.sum(), dtype=np.bool_)
    number = 0
    for k in range(starts.shape[0]):
        for sample in range(counts[k]):
            share = (sample + 0.5) / counts[k]
            x = starts[k, 0] + share * (ends[k, 0] - starts[k, 0])
            y = starts[k, 1] + share * (ends[k, 1] - starts[k, 1])
            z = starts[k, 2] + share * (ends[k, 2] - starts[k, 2])
            seen[number] = is_seen(x, y, z, depth, slack)
            number += 1
    return seen
