"""Motion of any place on a body, such as its mass centre, over the samples of a motion."""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField
from ilmek.linkage.motion import Motion


class AttachedPoint(NamedTuple):
    """Motion of a place on a body [m, m/s, m/s²]: complex, one value a sample."""

    position: ComplexArray
    velocity: ComplexArray
    acceleration: ComplexArray


def attached(motion: Motion, body: str, local: complex) -> AttachedPoint:
    """Motion of the place at `local` [m] in a body's frame."""
    moved = motion.body(body).carry(local)
    return AttachedPoint(
        _over(moved.position, motion), _over(moved.velocity, motion), _over(moved.acceleration, motion)
    )


def _over(value: ComplexField, motion: Motion) -> ComplexArray:
    """The value as an array over the samples: what stands still is one number in the motion."""
    return np.broadcast_to(np.asarray(value, dtype=np.complex128), motion.status.shape)
