"""Where the cam shafts stand one above the other, and which warps each of them has.

A shaft at the distance z beyond the first has the lift L(z) = L (a + z) / a and, with the prime radius in proportion to
the lift or at least that of the bore, the guide radius G(z) = max(c L(z), Rb) + L(z) + e. Neighbours keep the gap g:

    z(j) = z(j-1) + G(z(j-1)) + g + G(z(j))

G is the larger of two lines, so that z(j) is the larger of the solutions with each of them. Where a line rises by 1 or
more there is none, as the shafts grow faster than they move apart: the lift is then the highest allowed.      [derived]
"""

from ilmek.machines.shedding.cam_shaft import HIGHEST_LIFT
from ilmek.machines.shedding.params import SheddingParams


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
    found = [0.0]
    before = max(slender * lift, least_prime) + lift + beyond
    for _ in range(1, shafts):
        near = found[-1] + before + params.shaft_gap + beyond
        lines = (((slender + 1) * lift, (slender + 1) * rate), (least_prime + lift, rate))
        solved = [(near + height) / (1 - slope) if slope < 1 else float("inf") for height, slope in lines]
        highest = (HIGHEST_LIFT / lift - 1) / rate if rate > 0 else float("inf")
        beyond = max(solved)
        if beyond > highest:
            beyond = near + max(slender * HIGHEST_LIFT, least_prime) + HIGHEST_LIFT
        found.append(beyond)
        own = min(lift + rate * beyond, HIGHEST_LIFT)
        before = max(slender * own, least_prime) + own + beyond
    return tuple(found)
