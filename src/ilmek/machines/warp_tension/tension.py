"""The warps' tension over a row and between take-ups: what the weaving, the shed and the motor's steps change.

Between the cylinders a length L of warp is held, of the stiffness EA; a change of the way between the holds, or of the
length that is held, by d changes its tension by EA d / L. With r a row's pitch and c the crimp,

    row        r (1 + c) of warp becomes r of carpet: its waves shorten it by r c          T + EA r c / L   a row
    shed       lifted by s in the middle of two spans a: 2 (sqrt(a² + s²) - a) longer      T + EA dL / L    while open
    take-up    lower cylinder on by r, upper one off by r (1 + c): the tension of before
               the upper one locked                                                        T + EA r / L
               the upper one off by the same angle                                         T as after the row

so that between two take-ups nothing drops: the weaving draws the warps tighter, and what the upper cylinder lets off
beyond the lower one's way, r c, is the correction: r c / R of its angle. The carpet counts as stiff as its warps.
A stepper's full step turns the cylinder by 1.8 degrees over the ratio; that is the least that the tension can be set.

Cotton breaks at 17 cN/tex and 8 %: EA about 2.1 N/tex [Handbook of Properties of Textile and Technical Fibres, table
7.3, ring-spun, carded]. Yarn gives way in time under a steady pull, which is not reckoned.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.carpet.ground import WARP_DENSITY_PER_PITCH, warp_stiffness
from ilmek.machines.warp_tension.design import WarpTensionDesign
from ilmek.units import turn

STRENGTH = 0.17e6
"""Breaking force over mass per length of cotton yarn [N m/kg]: 17 cN/tex."""

STEPS = 200
"""Full steps of a stepper's turn."""


@dataclass(frozen=True, slots=True)
class WarpTension:
    """Tensions of a warp [N].

    stiffness   EA [N]              rate      EA / L [N/m]             breaking  force of a warp
    rest        after a take-up     woven     before the next one      shed      the same with the shed open
    locked      after a take-up by the lower cylinder alone
    correction  of the upper cylinder's angle at a take-up [rad]       step      that the motor's step changes
    """

    stiffness: float
    rate: float
    breaking: float
    rest: float
    woven: float
    shed: float
    locked: float
    correction: float
    step: float


def tension_of(design: WarpTensionDesign) -> WarpTension:
    """The warps' tensions over the rows between two take-ups."""
    params = design.params
    mass = WARP_DENSITY_PER_PITCH * params.pitch
    stiffness = params.warp_stiffness or warp_stiffness(params.pitch)
    rate, way = stiffness / params.free_length, params.rows_between * params.row_pitch
    woven = params.tension + rate * way * params.crimp
    return WarpTension(
        stiffness,
        rate,
        STRENGTH * mass,
        params.tension,
        woven,
        woven + rate * shed_lengthening(params.shed_lift, params.shed_span),
        woven + rate * way,
        way * params.crimp / design.outer_radius,
        rate * design.outer_radius * turn / STEPS / design.reducer.ratio,
    )


def shed_lengthening(lift: float, span: float) -> float:
    """What the open shed lengthens a warp by [m]: 2 (sqrt(a² + s²) - a).

    >>> round(shed_lengthening(0.060, 0.170), 6)
    0.020555
    """
    return float(2 * lift**2 / (np.hypot(lift, span) + span))


def course(design: WarpTensionDesign, rows: int) -> tuple[FloatArray, FloatArray]:
    """Rows woven and the tension of an even warp [N] over some rows: knots, its shed, the other one, take-up."""
    tension, every = tension_of(design), design.params.rows_between
    gain, lift = (tension.woven - tension.rest) / every, tension.shed - tension.woven
    at, over = [0.0], [tension.rest]
    for row in range(rows):
        base = tension.rest + gain * (row % every)
        now = np.array([0.0, 0.7, 0.775, 0.85, 1.0, 1.0])
        last = base + gain if (row + 1) % every else tension.rest
        at += (row + now).tolist()
        over += [base, base, base + gain / 2 + lift, base + gain / 2, base + gain, last]
    return np.array(at), np.array(over)
