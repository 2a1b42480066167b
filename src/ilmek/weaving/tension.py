"""Tension of the warps over the rows between two take-ups: weaving, shed, take-up.

A warp of length L and stiffness EA runs between two cylinders. Lengthening it by d, or releasing d less of it, changes
its tension by EA d / L. With w the carpet woven between two take-ups and c the crimp of the warp,

    weaving    w (1 + c) of warp becomes w of carpet: its crimp shortens the warp by w c     T + EA w c / L
    shed       the open shed lengthens the warp by dL (`shed`)                               T + EA dL / L while open
    take-up    the lower cylinder winds w, the upper one releases w (1 + c)                  the tension at rest
               the upper cylinder locked                                                     T + EA w / L
               the upper cylinder releases only w                                            T as after weaving

So the tension does not drop between two take-ups. Weaving tightens the warps, and the upper cylinder releases w c more
than the lower one winds. The carpet counts as stiff as its warps. Yarn creeps under
a steady tension; this is not considered.

Shed on a sprung back rest. Held fast, a lifted warp gains g = EA dL / L. A bar of a rate s times that of its warps
leaves them s / (1 + s) of their mean gain. With a bar for each parity that is g; with one bar for all warps it is
g / 2, and the lifted warps are g / 2 tighter than the mean, the others as much slacker.
[derived]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.yarns import usual_warp_density
from ilmek.units import N, mm

USUAL_TENSION, USUAL_PITCH = 15 * N, 2 * mm
"""Tension of a usual warp [N] at a pitch [m]: the thesis' loom [thesis 3.1]."""


def usual_tension(pitch: float, density: float | None = None) -> float:
    """Usual tension of a warp [N]: 15 N for the usual warp at 2 mm, proportional to the warp's mass.   [thesis 3.1]

    pitch    of the warps [m]
    density  mass per length of a warp [kg/m]; default: of the usual warp at the pitch

    >>> round(usual_tension(2e-3), 9)
    15.0
    """
    mass = usual_warp_density(pitch) if density is None else density
    return USUAL_TENSION * mass / usual_warp_density(USUAL_PITCH)


@dataclass(frozen=True, slots=True)
class TakeUpTension:
    """Tensions of a warp over the rows between two take-ups [N].

    rate    EA / L, tension over lengthening [N/m]      rest    after a take-up
    woven   before the next take-up                     shed    before the next take-up, with the shed open
    locked  after a take-up by the lower cylinder alone
    """

    rate: float
    rest: float
    woven: float
    shed: float
    locked: float


def take_up_tension(tension: float, rate: float, woven: float, crimp: float, lengthening: float) -> TakeUpTension:
    """Tensions of a warp between two take-ups.

    tension      at rest, after a take-up [N]       rate  EA / L [N/m]
    woven        w, carpet between two take-ups [m] crimp c, warp over carpet - 1
    lengthening  dL of the warp in the open shed [m]

    >>> found = take_up_tension(15.0, 1200.0, 4e-3, 0.03, 0.02)
    >>> [round(one, 3) for one in (found.rest, found.woven, found.shed, found.locked)]
    [15.0, 15.144, 39.144, 19.944]
    """
    after = tension + rate * woven * crimp
    return TakeUpTension(rate, tension, after, after + rate * lengthening, after + rate * woven)


RATE_SHARE, TENSION_MOST, TENSION_LEAST = 0.1, 1.5, 0.5
"""Of a sprung back rest: its rate over that of its warps; greatest and least tension in the shed over that at rest.

Assumed by this project."""


def compensated_tension(tension: float, gain: float, bars: int, share: float = RATE_SHARE) -> tuple[float, float]:
    """Tensions [N] of a lifted and of another warp in the open shed, on a sprung back rest.

    tension  at rest [N]      gain   of a lifted warp on a fixed back rest [N]
    bars     2, one for each parity, or 1 for all       share  rate of a bar over that of its warps

    >>> [round(one, 6) for one in compensated_tension(15.0, 11.0, 2)], compensated_tension(15.0, 11.0, 1)
    ([16.0, 15.0], (21.0, 10.0))
    """
    mean = tension + gain * bars / 2 * share / (1 + share)
    apart = gain * (1 - bars / 2)
    return mean + apart, mean - apart if bars == 1 else tension


def bars_needed(
    tension: float, gain: float, share: float = RATE_SHARE, most: float = TENSION_MOST, least: float = TENSION_LEAST
) -> int:
    """Bars of a sprung back rest that keep its tensions, 1 or 2; arguments as of `compensated_tension`.

    most, least  allowed in the open shed, over the tension at rest
    """
    high, low = compensated_tension(tension, gain, 1, share)
    return 1 if high <= most * tension and low >= least * tension else 2


def tension_history(tension: TakeUpTension, rows_between: int, rows: int) -> tuple[FloatArray, FloatArray]:
    """Rows woven [-] and tension [N] of an even warp over some rows, as corners of a line, (6 rows + 1,) each.

    Each row is knotted, then its shed opens and closes, then the other shed, in which the even warp rests. After every
    `rows_between` rows a take-up restores the tension.
    """
    gain, lift = (tension.woven - tension.rest) / rows_between, tension.shed - tension.woven
    at, over = [0.0], [tension.rest]
    for row in range(rows):
        base = tension.rest + gain * (row % rows_between)
        last = base + gain if (row + 1) % rows_between else tension.rest
        at += (row + np.array([0.0, 0.7, 0.775, 0.85, 1.0, 1.0])).tolist()
        over += [base, base, base + gain / 2 + lift, base + gain / 2, base + gain, last]
    return np.array(at), np.array(over)


def capstan(friction: float, wrap: float) -> float:
    """Ratio [1] of the tensions of a yarn before and behind a cylinder at slip: e^(f phi).   [Euler, Eytelwein]

    friction  coefficient f, 0 or more      wrap  angle of wrap phi [rad], 0 or more

    >>> capstan(0.0, 1.0)
    1.0
    """
    return math.exp(friction * wrap)
