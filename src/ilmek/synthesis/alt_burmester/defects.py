"""Circuit, branch and order defects of a four-bar whose coupler angles at the positions are known.

The configurations are known, so nothing is searched: hundreds of four-bars take a tenth of a second. For the full check
of one with its errors see `candidate.judge`, which uses the same circuits and the same order.
"""

import math

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.synthesis.alt_burmester.four_bars import CompleteFourBar
from ilmek.synthesis.circuit_loops import CircuitLoop, circuit_loops
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.precision import PositionMatch, order


def best_drive(one: CompleteFourBar, points: ComplexArray) -> tuple[FourBar, str | None]:
    """The four-bar driven by the link that avoids defects, and the defect that is left, by its filter's name.

    points  of the task [m], in order. A link that rotates fully is the crank; where none does, either may be driven.
    """
    defect = motion_defect(one.four_bar, one, points)
    if defect is None or one.four_bar.grashof.crank_turns:
        return one.four_bar, defect
    other = one.four_bar.reversed()
    return (other, None) if motion_defect(other, one, points) is None else (one.four_bar, defect)


def motion_defect(drawn: FourBar, one: CompleteFourBar, points: ComplexArray) -> str | None:
    """The first of one_circuit, one_branch and in_order that the four-bar fails; None for none.

    drawn   its four-bar, or that with crank and rocker exchanged      points  of the task [m], in order
    """
    assert drawn.tracer is not None
    turns = np.exp(1j * one.angles)
    a, b = (points + turns * (pin - drawn.tracer) for pin in (drawn.a, drawn.b))
    across = ((drawn.b0 - a).conj() * (b - a)).imag
    loops = circuit_loops(drawn)
    found = [
        _match(loops, float(np.angle(p - drawn.a0)), 1 if sign >= 0 else -1) for p, sign in zip(a, across, strict=True)
    ]
    if len({match.loop for match in found}) > 1:
        return "one_circuit"
    if len({match.branch for match in found}) > 1:
        return "one_branch"
    met = order(found, loops)
    return None if met is not None and met.kept else "in_order"


def _match(loops: tuple[CircuitLoop, ...], crank: float, branch: int) -> PositionMatch:
    """A known configuration on its circuit: crank angle [rad] and branch."""
    for index, loop in enumerate(loops):
        if loop.branch:
            if loop.branch == branch:
                return PositionMatch(index, crank, crank, branch, 0.0)
            continue
        middle, half = 0.5 * (loop.low + loop.high), 0.5 * (loop.high - loop.low)
        off = math.remainder(crank - middle, 2 * math.pi)
        if abs(off) <= half + 1e-6 or index == len(loops) - 1:
            u = branch * math.acos(min(1.0, max(-1.0, off / half)))
            return PositionMatch(index, u, middle + off, branch, 0.0)
    return PositionMatch(0, crank, crank, branch, 0.0)
