# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""What a four-bar of a path may be: bounds on its numbers, a crank that turns fully, a transmission angle: compiled.

    D <= kind (r1 - r2),   r1 + r2 <= E,    D, E = sqrt(r3^2 + r4^2 -+ 2 kappa r3 r4),    kappa = cos(least mu)

D and E are what coupler and rocker span at the least and at the greatest transmission angle; r1 - r2 and r1 + r2 are
the distances A-B0 between which they must be. kind is +1 for crank-rockers, -1 for double-cranks. With kappa = 1 these
are Grashof's inequalities: D = |r3 - r4|, E = r3 + r4.
"""

import math

import numpy as np

from ilmek.arrays import Float, RealField
from ilmek.num.compiled import compiled
from ilmek.synthesis.path.model import SIZE, Design

LIMITS = 2 * SIZE + 3
"""Upper and lower bound of each number, then the three rows of the turning crank."""

GRACE = 1e-12
"""By how much, in sizes of the path, the crank's limits may be overstepped."""

Rows = Float[np.ndarray, "23 10"]
Slack = Float[np.ndarray, "23"]


def spans(coupler: RealField, rocker: RealField, kappa: RealField) -> tuple[RealField, RealField]:
    """D and E [m], of any shape; compiled as `_spans`."""
    squares, slant = coupler * coupler + rocker * rocker, 2.0 * kappa * coupler * rocker
    return np.sqrt(np.maximum(squares - slant, 0.0)), np.sqrt(squares + slant)


_spans = compiled(spans)


@compiled
def excess(design: Design, kind: int, kappa: float) -> float:
    """By how much [m] the crank's limits are overstepped; 0 or less where they hold."""
    D, E = _spans(design[2], design[3], kappa)
    return float(max(D - kind * (design[0] - design[1]), design[0] + design[1] - E))


@compiled
def limit_rows(design: Design, low: Design, high: Design, kind: int, kappa: float, rows: Rows, slack: Slack) -> None:
    """The limits about a design: rows (step) <= slack, the transmission angle's in their tangents."""
    rows[:] = 0.0
    for i in range(SIZE):
        rows[2 * i, i], rows[2 * i + 1, i] = 1.0, -1.0
        slack[2 * i], slack[2 * i + 1] = max(high[i] - design[i], 0.0), max(design[i] - low[i], 0.0)
    r1, r2, r3, r4 = design[0], design[1], design[2], design[3]
    D, E = _spans(design[2], design[3], kappa)
    near, mirrored, far = 2 * SIZE, 2 * SIZE + 1, 2 * SIZE + 2
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
