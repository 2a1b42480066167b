"""What the compiled forms of all groups share: rows of samples, an instruction, a point carried by its body.

All rows lie in one array, those of a body one after the other, `BLOCK` samples each: the compiler sees that no row
overlaps another, and works on several samples at once (measured for an RRR dyad: 2 ns a state, 17 ns one by one).
`min(count, BLOCK)` shows it that no index is negative, where Python counts from the end.

A body takes ten rows: position, velocity and acceleration of its anchor (x and y each), direction (x and y), omega,
alpha. A dyad takes those of its two bodies and its margin; with sliders also, for each line, the motion of the pin's
point at zero travel, and the travel with its rates. Rows are in SI units and radians.
"""

import math
from collections.abc import Callable

from ilmek.arrays import ComplexArray, ComplexField, FloatArray
from ilmek.linkage.body_motion import carried_acceleration, carried_velocity
from ilmek.num.compiled import compiled
from ilmek.plane.vectors import cross, oblique
from ilmek.records import record

BLOCK = 128
"""Samples in a row: all rows of a mechanism fit the first or second cache."""

BODY, DRIVE = 10, 3
"""Rows of a body, and of an input: value, speed, acceleration."""

VELOCITY, ACCELERATION, DIRECTION, OMEGA, ALPHA = 2, 4, 6, 8, 9
"""Rows of a body after its anchor's position."""

SECOND, MARGIN, ZERO, TRAVEL, LINE = 10, 20, 21, 27, 9
"""Rows of a dyad: its second body and its margin. With sliders also the zero of the line, and travel, speed and
acceleration along it. LINE is the distance in rows to the same rows of a second line."""

NUMBERS = 6
"""Greatest number of complex numbers of an instruction."""


@record
class Instruction:
    """A step of the compiled executor. Its functions are kernels, all of the same arguments.

    kernel  (to, of, also, count, numbers): writes `count` samples to the rows from `to` on. `of` and `also` are the
            rows of bodies that it reads, or of an input
    scale   (numbers): the greatest possible margin and the shortest length [m], as those of the group's step; None: it
            has no margin
    gap     (to, of, numbers, i): gap [m] in sample i, where the margin is no real number
    shifts  whether it moves an anchor that was written before
    """

    kernel: Callable[[FloatArray, FloatArray, FloatArray, int, ComplexArray], None]
    scale: Callable[[ComplexArray], tuple[float, float]] | None = None
    gap: Callable[[FloatArray, FloatArray, ComplexArray, int], float] | None = None
    shifts: bool = False


cross_kernel, oblique_kernel = compiled(cross), compiled(oblique)
carried_velocity_kernel = compiled(carried_velocity)
carried_acceleration_kernel = compiled(carried_acceleration)


@compiled
def pair(rows: FloatArray, at: int) -> complex:
    """Read a complex sample: the real part at index `at`, the imaginary part one row further on."""
    return complex(rows[at], rows[at + BLOCK])


@compiled
def put(rows: FloatArray, at: int, value: ComplexField) -> None:
    """Write a complex sample; see `pair`."""
    rows[at] = value.real
    rows[at + BLOCK] = value.imag


@compiled
def _carry(point: FloatArray, body: FloatArray, _: FloatArray, count: int, numbers: ComplexArray) -> None:
    """Motion of a body's point, at `numbers[0]` [m] from the anchor in the body's frame."""
    local = numbers[0]
    for i in range(min(count, BLOCK)):
        arm = pair(body, DIRECTION * BLOCK + i) * local
        omega, alpha = body[OMEGA * BLOCK + i], body[ALPHA * BLOCK + i]
        put(point, i, pair(body, i) + arm)
        v, a = VELOCITY * BLOCK + i, ACCELERATION * BLOCK + i
        put(point, v, carried_velocity_kernel(pair(body, v), arm, omega))
        put(point, a, carried_acceleration_kernel(pair(body, a), arm, omega, alpha))


CARRY = Instruction(_carry)
"""Six rows of a body's point."""


@compiled
def unable(_dyad: FloatArray, _of: FloatArray, _numbers: ComplexArray, _i: int) -> float:
    """The gap of lines that do not cross: NaN."""
    return math.nan
