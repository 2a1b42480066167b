"""Instant centres of every pair of bodies of any mechanism, and the centrodes.

    v_i(z) = V_i + i w_i z    (V_i: velocity of the body's point at the world's origin)
    v_i(z) = v_j(z)    ->     z = i (V_i - V_j) / (w_i - w_j)

at infinity, normal to V_i - V_j, for equal angular velocities. The three centres of any three bodies are on one line
[Aronhold, Kennedy; Norton, Design of Machinery, sections 6.3 to 6.5]. Only the ratio of velocities counts: any speed
of the input but zero will do.
"""

from collections.abc import Mapping
from itertools import combinations

import numpy as np

from ilmek.arrays import Bool, Complex
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND
from ilmek.linkage.motion import Motion
from ilmek.records import record

PARALLEL = 1e-12
"""Greatest zero of the difference of angular velocities, times the mechanism's size, against that of velocities."""


@record
class InstantCentre:
    """The instant centre of two bodies at each sample.

    position   in the world [m]; NaN where it is at infinity, or the bodies have no relative motion
    far        whether it is at infinity        direction  unit complex towards it if so, up to sign; else NaN
    """

    position: Complex[np.ndarray, " samples"]
    far: Bool[np.ndarray, " samples"]
    direction: Complex[np.ndarray, " samples"]


@record
class Centrodes:
    """Paths [m] of the instant centre of a moving body: in the frame of the reference body, and in its own.

    The second rolls on the first without sliding and carries the body. One point per sample.
    """

    fixed: Complex[np.ndarray, " samples"]
    moving: Complex[np.ndarray, " samples"]


def instant_centre(motion: Motion, first: str, second: str = GROUND) -> InstantCentre:
    """The instant centre of two bodies over a motion.

    Raises MechanismError for an unknown body, one body given twice, or a motion with all inputs at rest.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.solve import solve
    >>> from ilmek.linkage.structure import plan
    >>> motion = solve(plan(four_bar(4.0, 2.0, 4.0, 2.5, branch=+1)), np.pi / 2, 1.0)
    >>> instant_centre(motion, "crank", "rocker").position.imag.round(12) + 0.0
    array([0.])
    """
    _check(motion, first, second)
    one, other = motion.body(first), motion.body(second)
    apart = [body.anchor.velocity - 1j * body.omega * body.anchor.position for body in (one, other)]
    parting = np.broadcast_to(apart[0] - apart[1], motion.status.shape) + 0j
    turning = np.broadcast_to(np.asarray(one.omega - other.omega, dtype=float), motion.status.shape)
    size = max((abs(p) for body in motion.plan.mechanism.bodies for p in body.points.values()), default=1.0) or 1.0
    far = np.abs(turning) * size <= PARALLEL * np.abs(parting)
    still = (parting == 0) & (turning == 0)
    near = ~far & np.isfinite(parting)
    position = np.full(parting.shape, np.nan + 1j * np.nan)
    position[near] = 1j * parting[near] / turning[near]
    direction = np.full(parting.shape, np.nan + 1j * np.nan)
    towards = far & ~still
    direction[towards] = 1j * parting[towards] / np.abs(parting[towards])
    return InstantCentre(position, towards, direction)


def instant_centres(motion: Motion) -> Mapping[tuple[str, str], InstantCentre]:
    """All n (n - 1) / 2 instant centres of a mechanism of n bodies, the ground among them, by the pair's names.

    The pairs are in the mechanism's order of bodies. Raises MechanismError where all inputs are at rest.
    """
    names = [body.name for body in motion.plan.mechanism.bodies]
    return {(first, second): instant_centre(motion, first, second) for first, second in combinations(names, 2)}


def centrodes(motion: Motion, body: str, against: str = GROUND) -> Centrodes:
    """The fixed and the moving centrode of a body against another, one point per sample; NaN at infinity.

    Raises MechanismError as `instant_centre`.
    """
    centre = instant_centre(motion, body, against).position
    return Centrodes(*((centre - motion.origin(name)) * np.conj(motion.direction(name)) for name in (against, body)))


def _check(motion: Motion, first: str, second: str) -> None:
    mechanism = motion.plan.mechanism
    for name in (first, second):
        mechanism.body(name)
    if first == second:
        raise MechanismError(f"body {first!r} against itself has no instant centre", do="name two bodies")
    if all(not np.any(drive.speed) for drive in motion.drives.values()):
        raise MechanismError(
            f"{mechanism.name} is at rest: it has no instant centres", do="solve it with speed=1 of an input"
        )
