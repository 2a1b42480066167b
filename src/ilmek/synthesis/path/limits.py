# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Limits in path synthesis: bounds of the numbers, full rotation of the crank, transmission angle: compiled.

    D <= kind (r1 - r2),   r1 + r2 <= E,    D, E = sqrt(r3^2 + r4^2 -+ 2 kappa r3 r4),    kappa = cos(least mu)

D and E are the distances |A B0| at the least and at the greatest allowed transmission angle; r1 - r2 and r1 + r2 are
the extreme distances |A B0|. kind is +1 for crank-rockers, -1 for double-cranks. With kappa = 1 these are the Grashof
inequalities: D = |r3 - r4|, E = r3 + r4. With a greatest ratio of two links, each is at most `ratio` times the crank
(crank-rocker) or the ground link (double-crank): the shortest of all.
"""

import math

import numpy as np

from ilmek.arrays import Float, RealField
from ilmek.num.compiled import compiled
from ilmek.synthesis.path.model import SIZE, Design

LIMITS = 2 * SIZE + 6
"""Upper and lower bound of each number, three rows for the ratio of links, three for the rotation of the crank."""

MARGIN = 1e-4
"""Share of the ratio of links that steps keep free: the curved limits move the shortest link after a step."""

TOLERANCE = 1e-12
"""Allowed violation of the crank's limits, in sizes of the path."""

Rows = Float[np.ndarray, "26 10"]
Slack = Float[np.ndarray, "26"]


def spans(coupler: RealField, rocker: RealField, kappa: RealField) -> tuple[RealField, RealField]:
    """D and E [m] of coupler and rocker [m], of any shape; compiled as `_spans`."""
    squares, slant = coupler * coupler + rocker * rocker, 2.0 * kappa * coupler * rocker
    return np.sqrt(np.maximum(squares - slant, 0.0)), np.sqrt(squares + slant)


_spans = compiled(spans)


@compiled
def excess(design: Design, kind: int, kappa: float) -> float:
    """Violation of the crank's limits [m]; 0 or less where they are met."""
    D, E = _spans(design[2], design[3], kappa)
    return float(max(D - kind * (design[0] - design[1]), design[0] + design[1] - E))


@compiled
def ratio_excess(design: Design, kind: int, ratio: float) -> float:
    """Length by which the shortest link is too short for the ratio of links [m]; 0 or less where it is kept."""
    shortest = 1 if kind > 0 else 0
    return float(max(design[0], design[1], design[2], design[3]) / ratio - design[shortest])


@compiled
def limit_rows(
    design: Design, low: Design, high: Design, kind: int, kappa: float, ratio: float, rows: Rows, slack: Slack
) -> None:
    """Linearised limits about a design, rows @ step <= slack, written to `rows` and `slack`.

    design, low, high  the ten numbers and their bounds [m, rad], shape (10,)      kind, kappa  +1 or -1, cosine [1]
    ratio  greatest ratio of two links [1]; inf: none
    """
    rows[:] = 0.0
    for i in range(SIZE):
        rows[2 * i, i], rows[2 * i + 1, i] = 1.0, -1.0
        slack[2 * i], slack[2 * i + 1] = max(high[i] - design[i], 0.0), max(design[i] - low[i], 0.0)
    r1, r2, r3, r4 = design[0], design[1], design[2], design[3]
    D, E = _spans(design[2], design[3], kappa)
    row, shortest = 2 * SIZE, 1 if kind > 0 else 0
    for i in range(4):
        if i == shortest:
            continue
        slack[row] = math.inf
        if math.isfinite(ratio):
            rows[row, i], rows[row, shortest] = 1.0, -ratio * (1.0 - MARGIN)
            slack[row] = max(ratio * (1.0 - MARGIN) * design[shortest] - design[i], 0.0)
        row += 1
    near, mirrored, far = 2 * SIZE + 3, 2 * SIZE + 4, 2 * SIZE + 5
    for row in (near, mirrored):
        rows[row, 0], rows[row, 1] = -kind, kind
    if kappa >= 1.0:
        rows[near, 2], rows[near, 3], slack[near] = 1.0, -1.0, max(kind * (r1 - r2) - r3 + r4, 0.0)
        rows[mirrored, 2], rows[mirrored, 3], slack[mirrored] = -1.0, 1.0, max(kind * (r1 - r2) + r3 - r4, 0.0)
    else:
        rows[near, 2], rows[near, 3] = (r3 - kappa * r4) / D, (r4 - kappa * r3) / D
        slack[near], slack[mirrored] = max(kind * (r1 - r2) - D, 0.0), math.inf
    rows[far, 0] = rows[far, 1] = 1.0
    rows[far, 2], rows[far, 3], slack[far] = -(r3 + kappa * r4) / E, -(r4 + kappa * r3) / E, max(E - r1 - r2, 0.0)
