"""Where the cam shafts stand one above the other, and which warps each of them has.

A shaft at the distance z beyond the first has the lift L(z) = L (a + z) / a and, with the prime radius in proportion to
the lift or at least that of the bore, the guide radius G(z) = max(c L(z), Rb) + L(z) + e. Neighbours keep the gap g:

    z(j) = z(j-1) + G(z(j-1)) + g + G(z(j))

G is the larger of two lines, so that z(j) is the larger of the solutions with each of them. Where a line rises by 1 or
more there is none, as the shafts grow faster than they move apart; z is then so large that its check fails.  [derived]
"""

import math

from ilmek.machines.shedding.params import SheddingParams
from ilmek.units import m

FARTHEST = 20 * m
"""Distance at which shafts that grow faster than they move apart are computed."""


def dealt(warps: int, shafts: int) -> tuple[tuple[int, int], ...]:
    """Even and odd warps of each shaft; the warps, the first of them odd, are dealt to the shafts in turn.

    >>> dealt(600, 1), dealt(7, 2), dealt(8, 3)
    (((300, 300),), ((0, 4), (3, 0)), ((1, 2), (2, 1), (1, 1)))
    """
    found = []
    for index in range(shafts):
        number, odd_first = len(range(index, warps, shafts)), index % 2 == 0
        first = number if shafts % 2 == 0 else (number + 1) // 2
        found.append((number - first, first) if odd_first else (first, number - first))
    return tuple(found)


def positions(params: SheddingParams, shafts: int, slender: float, least_prime: float = 0.0) -> tuple[float, ...]:
    """Distances of the shafts beyond the first one [m].

    slender      c, prime radius for the pressure angle over the lift
    least_prime  Rb, prime radius that the bore needs [m]
    """
    lift, spans = params.lift, params.spans_of_warp
    rate = lift / spans[0] if spans else 0.0
    beyond = params.guide_height - params.roller_radius
    positions = [0.0]
    before = max(slender * lift, least_prime) + lift + beyond
    for _ in range(1, shafts):
        near = positions[-1] + before + params.shaft_gap + beyond
        lines = (((slender + 1) * lift, (slender + 1) * rate), (least_prime + lift, rate))
        solved = [(near + height) / (1 - slope) if slope < 1 else math.inf for height, slope in lines]
        positions.append(min(max(solved), FARTHEST))
        own = lift + rate * positions[-1]
        before = max(slender * own, least_prime) + own + beyond
    return tuple(positions)
