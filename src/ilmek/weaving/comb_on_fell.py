"""The comb as a beam on the fell: uniformity of its pressure.

    E I w'''' + k w = 0,   l = (k / 4 E I)^(1/4),   q = k w       [Winkler foundation; Hetenyi, Beams on Elastic
                                                                   Foundation, 1946]

w [m] is the displacement of the fell, q [N/m] the pressure, k [N/m^2] the stiffness of the fell over the width. The
comb is pushed down by one distance at its supports; its ends are free. Each piece is propagated by Krylov's functions
K1 = cosh z cos z, K2 = (cosh z sin z + sinh z cos z) / 2, K3 = sinh z sin z / 2, K4 = (cosh z sin z - sinh z cos z) / 4
of z = l x, each the derivative of the next, K1' = -4 K4: the exact solution. Pieces are at most 1.5 / l long, so
that the functions stay of one magnitude.

Supported at both ends, the pressure in the middle over that at the ends is
cosh u cos u / (cosh^2 u cos^2 u + sinh^2 u sin^2 u), u = l W / 2.
"""

import math

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.records import record
from ilmek.units import format_quantity

MOST_PIECES = 500
"""Pieces of a comb: their equations are solved in about half a second."""

RIGID = 0.02
"""Largest l W of a rigid comb: its deflection is below 1e-7 of the displacement of the fell."""

_LONGEST = 1.5
_DENSE = 201


@record
class FellPressure:
    """Pressure of a comb on the fell across its width.

    x          positions across the width [m]      share  pressure over the mean pressure [-]; its mean is 1
    curvature  of the comb for a mean pressure of 1 N/m [1/N]
    number     l W [-]: below 1 the comb is stiff relative to the fell
    """

    x: FloatArray
    share: FloatArray
    curvature: FloatArray
    number: float

    @property
    def least(self) -> float:
        """Least pressure over the mean."""
        return float(self.share.min())

    @property
    def most(self) -> float:
        """Largest pressure over the mean."""
        return float(self.share.max())

    @property
    def uniformity(self) -> float:
        """Least over largest pressure; below 0 the comb leaves the fell somewhere."""
        return self.least / self.most


def krylov(z: FloatArray) -> FloatArray:
    """Krylov's functions K1 to K4 [1] of z [1], shape (4, *z.shape)."""
    c, s = np.cosh(z), np.sinh(z)
    cos, sin = np.cos(z), np.sin(z)
    return np.stack([c * cos, (c * sin + s * cos) / 2, s * sin / 2, (c * sin - s * cos) / 4])


def fell_pressure(
    width: float, supports: Float[np.ndarray, " supports"], rigidity: float, foundation: float
) -> FellPressure:
    """Pressure across the width of a comb that is pushed down at its supports.

    width     W of the comb [m]             supports    their positions from its left end [m], one or more
    rigidity  E I of the comb [N m^2]       foundation  k, stiffness of the fell over the width [N/m^2]
    A comb that is rigid relative to the fell presses evenly, or tilts about a single support. Raises ParameterError for
    a comb so long and soft that it needs more than MOST_PIECES pieces.
    """
    root = (foundation / (4 * rigidity)) ** 0.25
    number = root * width
    x = np.unique(np.concatenate([np.linspace(0.0, width, _DENSE), supports]))
    if number < RIGID:
        return FellPressure(x, _rigid(x, width, supports), np.zeros_like(x), number)
    nodes = _nodes(width, supports, _LONGEST / root)
    states = _states(nodes, supports, root)
    piece = np.clip(np.searchsorted(nodes, x, side="right") - 1, 0, nodes.size - 2)
    functions = krylov(root * (x - nodes[piece]))
    pushed = np.sum(functions * states[piece].T, axis=0)
    bent = np.sum(_moved(functions, 2) * states[piece].T, axis=0) * root**2
    # The pressure's integral over a piece is the step of w''' / 4 l over it, by the equation itself.
    mean = float(np.sum([-(_end(states[i], root * step)[3] - states[i][3]) for i, step in enumerate(np.diff(nodes))]))
    mean /= 4 * root * width
    return FellPressure(x, pushed / mean, bent / (mean * foundation), number)


def _rigid(x: FloatArray, width: float, supports: FloatArray) -> FloatArray:
    """Pressure of a rigid comb over the mean: even, or tilted about a single support until the moments balance."""
    if supports.size > 1:
        return np.ones_like(x)
    lever = x - supports[0]
    arm = width / 2 - float(supports[0])
    square = width**2 / 12 + arm**2
    return np.asarray((1 - arm / square * lever) / (1 - arm**2 / square))


def _nodes(width: float, supports: FloatArray, longest: float) -> FloatArray:
    """Ends and supports, and positions between them at most `longest` apart."""
    fixed = np.unique(np.concatenate([[0.0, width], supports]))
    parts = [max(1, math.ceil(step / longest)) for step in np.diff(fixed).tolist()]
    if sum(parts) > MOST_PIECES:
        raise ParameterError(
            f"a comb {format_quantity(width, 'm')} wide is too soft: {sum(parts)} pieces of its length bend apart",
            allowed=f"at most {MOST_PIECES}",
            do="set a larger comb_depth, or fewer warps",
        )
    filled = [np.linspace(fixed[i], fixed[i + 1], part + 1)[:-1] for i, part in enumerate(parts)]
    return np.concatenate([*filled, [width]])


def _moved(functions: FloatArray, order: int) -> FloatArray:
    """The functions' derivatives of an order: K1' = -4 K4, K2' = K1, K3' = K2, K4' = K3."""
    moved = functions
    for _ in range(order):
        moved = np.stack([-4 * moved[3], moved[0], moved[1], moved[2]])
    return moved


def _transfer(z: float) -> FloatArray:
    """Transfer matrix of (w, w', w'', w''') by l x from the start of a piece of length z to its end."""
    one, two, three, four = krylov(np.array(z)).tolist()
    return np.array(
        [
            [one, two, three, four],
            [-4 * four, one, two, three],
            [-4 * three, -4 * four, one, two],
            [-4 * two, -4 * three, -4 * four, one],
        ]
    )


def _end(state: FloatArray, z: float) -> FloatArray:
    return np.asarray(_transfer(z) @ state)


def _states(nodes: FloatArray, supports: FloatArray, root: float) -> FloatArray:
    """(w, w', w'', w''') by l x at the start of each piece, the comb pushed down by 1 at its supports."""
    pieces = nodes.size - 1
    matrix, right = np.zeros((4 * pieces, 4 * pieces)), np.zeros(4 * pieces)
    supported = {int(np.argmin(np.abs(nodes - support))) for support in supports}
    row = 0

    def condition(parts: list[tuple[int, FloatArray]], value: float = 0.0) -> None:
        nonlocal row
        for piece, coefficients in parts:
            matrix[row, 4 * piece : 4 * piece + 4] += coefficients
        right[row] = value
        row += 1

    one = np.eye(4)
    condition([(0, one[2])])
    condition([(0, one[0])], 1.0) if 0 in supported else condition([(0, one[3])])
    for node in range(1, pieces):
        over = _transfer(root * float(nodes[node] - nodes[node - 1]))
        for order in range(3):
            condition([(node - 1, over[order]), (node, -one[order])])
        if node in supported:
            condition([(node, one[0])], 1.0)
        else:
            condition([(node - 1, over[3]), (node, -one[3])])
    over = _transfer(root * float(nodes[-1] - nodes[-2]))
    condition([(pieces - 1, over[2])])
    condition([(pieces - 1, over[0])], 1.0) if pieces in supported else condition([(pieces - 1, over[3])])
    return np.linalg.solve(matrix, right).reshape(pieces, 4)
