"""Motion of any point on a body, such as its mass centre, over the samples of a motion.

    P = O + r,    P' = O' + i omega r,    P'' = O'' + (i alpha - omega²) r,    r = l e^{i theta}

[rigid body in plane motion: Norton, Design of Machinery, chapters 6 and 7]
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField
from ilmek.linkage.motion import Motion


class AttachedPoint(NamedTuple):
    """Position, velocity, acceleration of a body's point [m, m/s, m/s²], complex, one value per sample."""

    position: ComplexArray
    velocity: ComplexArray
    acceleration: ComplexArray


def attached(motion: Motion, body: str, local: complex) -> AttachedPoint:
    """Motion of a point of a body, at `local` [m], complex, in the body's frame.

    motion  with one value per sample      body  its name
    Returns arrays over the samples [m, m/s, m/s²]; NaN where the mechanism does not close.
    """
    with np.errstate(invalid="ignore", over="ignore"):  # at a dead centre rates are infinite; `status` says so
        moved = motion.body(body).carry(local)
    return AttachedPoint(
        _over(moved.position, motion), _over(moved.velocity, motion), _over(moved.acceleration, motion)
    )


def _over(value: ComplexField, motion: Motion) -> ComplexArray:
    """The value as an array over the samples; a point at rest is a single number in the motion."""
    return np.broadcast_to(np.asarray(value, dtype=np.complex128), motion.status.shape)
