"""Structural error of a function-generating four-bar in closed form, with derivatives by ratios and start angles.

Freudenstein's equation with ground 1, crank a, coupler b, rocker c,

    R1 cos th4 - R2 cos th2 + R3 = cos(th2 - th4),    R1 = 1 / a, R2 = 1 / c, R3 = (1 + a^2 - b^2 + c^2) / (2 a c)

is Re(D* e^{i th4}) = C with D = R1 - e^{i th2}, C = R2 cos th2 - R3, and so

    e^{i th4} = D (C + i s sqrt(|D|^2 - C^2)) / |D|^2,    error = th4 - beta - psi(x),    th2 = alpha + phi(x)

All terms stay finite for infinitely long links: R1 = 0 and R2 = 0 are sliders, and a search passes through them. s is
the branch of the four-bar times the signs of a and c. The derivatives follow from the equation. [derived here]
"""

import math
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import Bool, ComplexArray, Float, FloatArray, RealField
from ilmek.plane.vectors import dot
from ilmek.records import record
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.function import Function

Weight: TypeAlias = Callable[[FloatArray], FloatArray]
"""Weight of the error at each x, above 0."""


class GeneratorLinks(NamedTuple):
    """Crank, coupler and rocker [ground links]; crank and rocker negative where they point opposite to their angles."""

    crank: float
    coupler: float
    rocker: float


class Generator(NamedTuple):
    """A function generator; numbers or arrays of one shape.

    by_crank, by_rocker, both  Freudenstein's R1, R2, R3 [1]
    crank_start, rocker_start  angles at the start of the function [rad]
    """

    by_crank: RealField
    by_rocker: RealField
    both: RealField
    crank_start: RealField
    rocker_start: RealField

    @property
    def numbers(self) -> Float[np.ndarray, "5"]:
        """The five numbers as an array, shape (5,)."""
        return np.array(self, dtype=float)

    @property
    def links(self) -> GeneratorLinks:
        """Link lengths of one generator [ground links]; inf where a ratio is 0."""
        r1, r2, r3 = (float(ratio) for ratio in self[:3])
        if r1 == 0 or r2 == 0:
            return GeneratorLinks(math.inf, math.inf, math.inf)
        a, c = 1 / r1, 1 / r2
        return GeneratorLinks(a, math.sqrt(max(0.0, 1 + a * a + c * c - 2 * a * c * r3)), c)

    def drawn(self, function: Function, x: float, sense: int, ground: float) -> FourBar:
        """The four-bar drawn at x, its ground link along the x axis from the origin.

        sense  s, +1 or -1      ground  length of the ground link [m]
        """
        at, links = np.array([x], dtype=float), self.links
        e2 = np.exp(1j * (self.crank_start + function.crank(at)))
        a, b = links.crank * complex(e2[0]), 1 + links.rocker * complex(_rocker_direction(self, e2, sense)[0])
        return FourBar(0j, complex(ground), a * ground, b * ground)


@record
class StructuralErrors:
    """(free parameters, x) -> weighted structural error [rad] and its derivatives.

    The error is inf where the four-bar does not close; everywhere, if it closes at all x but not over the whole range.

    sense   s, +1 or -1
    known   all five numbers of the `Generator`, for those that are not free
    free    which of the five numbers are free
    weight  of the error at each x, above 0; default: 1
    """

    function: Function
    sense: int
    known: Float[np.ndarray, "5"]
    free: Bool[np.ndarray, "5"]
    weight: Weight | None = None

    def generator(self, parameters: FloatArray) -> Generator:
        """The generator with the free numbers replaced."""
        numbers = self.known.copy()
        numbers[self.free] = parameters
        return Generator(*numbers)

    def __call__(self, parameters: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Errors and derivatives, as `exchange.Errors`."""
        one = self.generator(parameters)
        e2 = np.exp(1j * (one.crank_start + self.function.crank(x)))
        direction = _rocker_direction(one, e2, self.sense)
        with np.errstate(divide="ignore", invalid="ignore"):
            slopes = _slopes(one, e2, direction)
        error = np.angle(direction * np.exp(-1j * (one.rocker_start + self.function.rocker(x))))
        not_closed = ~(np.isfinite(error) & np.isfinite(slopes).all(axis=-1))
        if not not_closed.any() and not margin(self.function, one) > 0:
            not_closed[:] = True
        weight = np.ones(len(x)) if self.weight is None else self.weight(x)
        error = np.where(not_closed, np.inf, weight * error)
        return error, np.where(not_closed[:, None], 0.0, weight[:, None] * slopes)[:, self.free]


def margin(function: Function, one: Generator) -> float:
    """Margin of a generator from a dead centre of its crank over the range: least of 1 - C^2 / |D|^2 [1].

    0 at a dead centre, below 0 where the four-bar does not close. C^2 - |D|^2 is convex in cos th2, so the ends of the
    range and the crossings of the ground line suffice.
    """
    turned = function.crank(np.array([function.start, function.stop], dtype=float))
    low, high = sorted(float(one.crank_start + turn) for turn in turned)
    cosines = [math.cos(low), math.cos(high)]
    cosines += [(-1.0) ** k for k in range(math.ceil(low / math.pi), math.floor(high / math.pi) + 1)]
    r1, r2, r3 = (float(ratio) for ratio in one[:3])
    return min(1 - (r2 * cosine - r3) ** 2 / max(r1 * r1 + 1 - 2 * r1 * cosine, 1e-300) for cosine in cosines)


def structural_error(function: Function, one: Generator, sense: int, x: FloatArray) -> FloatArray:
    """Unweighted structural errors [rad] of generators at x, NaN where they do not close.

    one  numbers of any shape      sense  s, +1 or -1      x  shape (points,)

    Returns an array of the generators' shape, followed by that of x.
    """
    each = Generator(*(np.asarray(number)[..., None] for number in one))
    direction = _rocker_direction(each, np.exp(1j * (each.crank_start + function.crank(x))), sense)
    return np.asarray(np.angle(direction * np.exp(-1j * (each.rocker_start + function.rocker(x)))))


def design_table(
    function: Function, starts: tuple[RealField, RealField], x: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Columns of R1, R2, R3 and right side of Freudenstein's equation at x, for each pair of start angles [rad]."""
    th2 = np.asarray(starts[0])[..., None] + function.crank(x)
    th4 = np.asarray(starts[1])[..., None] + function.rocker(x)
    return np.stack([np.cos(th4), -np.cos(th2), np.ones_like(th2)], axis=-1), np.asarray(np.cos(th2 - th4))


def design_fit(
    function: Function, starts: tuple[FloatArray, FloatArray], x: FloatArray, shares: FloatArray
) -> Generator:
    """Generators of least design error for each pair of start angles [rad]; `shares` weight the squares at x."""
    table, right = design_table(function, starts, x)
    root = np.sqrt(shares)
    ratios = (np.linalg.pinv(root[:, None] * table, rcond=1e-10) @ (root * right)[..., None])[..., 0]
    return Generator(ratios[..., 0], ratios[..., 1], ratios[..., 2], *starts)


def of_four_bar(
    four_bar: FourBar,
    function: Function,
    drawn_at: float,
    given_starts: tuple[float | None, float | None] = (None, None),
) -> tuple[int, Generator]:
    """Sense and generator of a four-bar drawn at x = drawn_at.

    given_starts  given start angles of crank and rocker [rad]: a link that points opposite to its angle is negative
    """
    at, frame = np.array([drawn_at], dtype=float), four_bar.b0 - four_bar.a0
    a, b, c = (length / abs(frame) for length in four_bar.lengths[1:])
    angles = np.angle([(four_bar.a - four_bar.a0) / frame, (four_bar.b - four_bar.b0) / frame])
    starts = angles - np.array([function.crank(at)[0], function.rocker(at)[0]])
    signs = [
        1 if one is None or math.cos(start - one) > 0 else -1 for one, start in zip(given_starts, starts, strict=True)
    ]
    from_pins = [float(start) if one is None else one for one, start in zip(given_starts, starts, strict=True)]
    a, c = signs[0] * a, signs[1] * c
    return four_bar.branch * signs[0] * signs[1], Generator(
        1 / a, 1 / c, (1 + a * a - b * b + c * c) / (2 * a * c), *from_pins
    )


def _rocker_direction(one: Generator, e2: ComplexArray, sense: int) -> ComplexArray:
    """e^{i th4}; NaN where the four-bar does not close."""
    with np.errstate(divide="ignore", invalid="ignore"):
        across = one.by_crank - e2
        square = across.real**2 + across.imag**2
        along = one.by_rocker * e2.real - one.both
        return np.asarray(across * (along + 1j * sense * np.sqrt(square - along**2)) / square)


def _slopes(one: Generator, e2: ComplexArray, e4: ComplexArray) -> Float[np.ndarray, "points 5"]:
    """Derivatives of the error by R1, R2, R3, crank_start, rocker_start."""
    columns = (e4.real, -e2.real, np.ones(e2.shape), one.by_rocker * e2.imag - dot(1j * e2, e4))
    lever = -dot(one.by_crank - e2, 1j * e4)
    return np.stack([*(column / lever for column in columns), -np.ones(e2.shape)], axis=-1)
