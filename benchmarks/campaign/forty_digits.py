"""The motion of chains of dyads in decimal arithmetic, by other means than the engine's.

Every number is its value and first two derivatives by time (a truncated Taylor series). So the closed forms of the
positions alone give velocities and accelerations, and no formula for a rate is needed.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal, getcontext
from functools import cache
from typing import TypeAlias

from ilmek.linkage.groups.prp import CrossedSliders
from ilmek.linkage.groups.rpp import CrossSlide
from ilmek.linkage.groups.rpr import SlidingDyad
from ilmek.linkage.groups.rrp import SliderDyad
from ilmek.linkage.groups.rrr import RRRDyad
from ilmek.linkage.groups.turn import DrivenCrank
from ilmek.linkage.model import GROUND, Mechanism, Slide
from ilmek.linkage.structure import Plan

DIGITS = 50
"""Ten more than the forty that are claimed."""

Numbers: TypeAlias = tuple[Decimal, Decimal, Decimal]


class DoesNotClose(Exception):
    """A root of a negative number: the links do not reach."""


@dataclass(frozen=True, slots=True)
class Series:
    """x + x' t + x'' t^2 / 2, by value and derivatives."""

    x: Decimal
    v: Decimal
    a: Decimal

    def __add__(self, other: "Series") -> "Series":
        return Series(self.x + other.x, self.v + other.v, self.a + other.a)

    def __sub__(self, other: "Series") -> "Series":
        return Series(self.x - other.x, self.v - other.v, self.a - other.a)

    def __mul__(self, other: "Series") -> "Series":
        x, y = self, other
        return Series(x.x * y.x, x.v * y.x + x.x * y.v, x.a * y.x + 2 * x.v * y.v + x.x * y.a)

    def __truediv__(self, other: "Series") -> "Series":
        x = self.x / other.x
        v = (self.v - x * other.v) / other.x
        return Series(x, v, (self.a - 2 * v * other.v - x * other.a) / other.x)

    def root(self, sign: int) -> "Series":
        if self.x <= 0:
            raise DoesNotClose
        x = sign * self.x.sqrt()
        v = self.v / (2 * x)
        return Series(x, v, (self.a / 2 - v * v) / x)


def number(value: float | int) -> Series:
    return Series(Decimal(value), Decimal(0), Decimal(0))


HALF = number(0.5)


@dataclass(frozen=True, slots=True)
class Vector:
    """A complex series."""

    x: Series
    y: Series

    def __add__(self, other: "Vector") -> "Vector":
        return Vector(self.x + other.x, self.y + other.y)

    def __sub__(self, other: "Vector") -> "Vector":
        return Vector(self.x - other.x, self.y - other.y)

    def __mul__(self, other: "Vector") -> "Vector":
        return Vector(self.x * other.x - self.y * other.y, self.x * other.y + self.y * other.x)

    def times(self, factor: Series) -> "Vector":
        return Vector(self.x * factor, self.y * factor)

    def turned_back(self, by: "Vector") -> "Vector":
        """self conj(by): its components are dot(by, self) and cross(by, self)."""
        return Vector(self.x * by.x + self.y * by.y, self.y * by.x - self.x * by.y)

    def over(self, other: "Vector") -> "Vector":
        turned, square = self.turned_back(other), other.turned_back(other).x
        return Vector(turned.x / square, turned.y / square)


def vector(value: complex) -> Vector:
    return Vector(number(value.real), number(value.imag))


@cache
def direction(angle: float) -> tuple[Decimal, Decimal]:
    """Cosine and sine of a double [rad] by their series."""
    x = Decimal(angle)
    term, k, sums = Decimal(1), 0, [Decimal(0), Decimal(0)]
    while k < 8 or abs(term) > Decimal(10) ** (-DIGITS - 2):
        sums[k % 2] += term if k % 4 < 2 else -term
        k += 1
        term = term * x / k
    return sums[0], sums[1]


def fixed(angle: float) -> Vector:
    cosine, sine = direction(angle)
    zero = Decimal(0)
    return Vector(Series(cosine, zero, zero), Series(sine, zero, zero))


def turning(angle: float, speed: float, acceleration: float) -> Vector:
    (c, s), w, a = direction(angle), Decimal(speed), Decimal(acceleration)
    return Vector(Series(c, -s * w, -s * a - c * w * w), Series(s, c * w, c * a - s * w * w))


@dataclass(frozen=True, slots=True)
class Placed:
    """A body: origin and direction of its frame."""

    origin: Vector
    direction: Vector

    def carry(self, local: complex) -> Vector:
        return self.origin + self.direction * vector(local)

    @property
    def rates(self) -> tuple[Decimal, Decimal]:
        """Angular velocity and acceleration."""
        rate = Vector(
            Series(self.direction.x.v, self.direction.x.a, Decimal(0)),
            Series(self.direction.y.v, self.direction.y.a, Decimal(0)),
        )
        turned = rate.turned_back(self.direction)
        return turned.y.x, turned.y.v


def motion(plan: Plan, drive: tuple[float, float, float]) -> dict[str, Placed]:
    """Every body; drive: value, speed and acceleration of the only input. Raises DoesNotClose."""
    getcontext().prec = DIGITS
    bodies = {GROUND: Placed(vector(0j), vector(1 + 0j))}
    for step in plan.steps:
        SOLVERS[type(step)](plan.mechanism, step, bodies, drive)
    return bodies


def _pinned(on: Placed, hinge: complex, at: complex, turned: Vector) -> Placed:
    return Placed(on.carry(hinge) - turned * vector(at), turned)


def _between(mechanism: Mechanism, one: str, other: str) -> str:
    return next(joint.name for joint in mechanism.joints if set(joint.bodies) == {one, other})


def _slide(mechanism: Mechanism, body: str, guide: str) -> Slide:
    joint = mechanism.joint(_between(mechanism, body, guide))
    assert isinstance(joint, Slide)
    assert joint.guide == guide
    return joint


def _turn(
    mechanism: Mechanism, step: DrivenCrank, bodies: dict[str, Placed], drive: tuple[float, float, float]
) -> None:
    pin = _between(mechanism, step.body, step.carrier)
    on = bodies[step.carrier]
    turned = on.direction * turning(*(step.sign * one for one in drive))
    bodies[step.body] = _pinned(on, mechanism.point(step.carrier, pin), mechanism.point(step.body, pin), turned)


def _arm(mechanism: Mechanism, body: str, start: str, end: str) -> Vector:
    return vector(mechanism.point(body, end)) - vector(mechanism.point(body, start))


def _rrr(mechanism: Mechanism, step: RRRDyad, bodies: dict[str, Placed], drive: object) -> None:  # noqa: ARG001 - all alike
    pins = [_between(mechanism, link, on) for link, on in zip(step.links, step.on, strict=True)]
    arms = [_arm(mechanism, link, pin, step.pin) for link, pin in zip(step.links, pins, strict=True)]
    A, B = (bodies[on].carry(mechanism.point(on, pin)) for on, pin in zip(step.on, pins, strict=True))
    aa, bb = (arm.turned_back(arm).x for arm in arms)
    d = B - A
    dd = d.turned_back(d).x
    along = HALF + HALF * (aa - bb) / dd
    across = (aa / dd - along * along).root(step.branch)
    C = A + Vector(along, across) * d
    for link, on, pin, arm, start in zip(step.links, step.on, pins, arms, (A, B), strict=True):
        hinge, at = mechanism.point(on, pin), mechanism.point(link, pin)
        bodies[link] = _pinned(bodies[on], hinge, at, (C - start).over(arm))


def _rrp(mechanism: Mechanism, step: SliderDyad, bodies: dict[str, Placed], drive: object) -> None:  # noqa: ARG001 - all alike
    link, slider, (on, guide) = step.link, step.slider, step.on
    hinge, slide = _between(mechanism, link, on), _slide(mechanism, slider, guide)
    e, turned = bodies[guide].direction * fixed(slide.along), bodies[guide].direction * fixed(slide.turned)
    A = bodies[on].carry(mechanism.point(on, hinge))
    reach = turned * _arm(mechanism, slider, slide.name, step.pin)
    Q = bodies[guide].carry(mechanism.point(guide, slide.name)) + reach
    arm = _arm(mechanism, link, hinge, step.pin)
    d = (A - Q).turned_back(e)
    s = d.x + (arm.turned_back(arm).x - d.y * d.y).root(step.branch)
    C = Q + e.times(s)
    bodies[link] = _pinned(bodies[on], mechanism.point(on, hinge), mechanism.point(link, hinge), (C - A).over(arm))
    bodies[slider] = Placed(C - turned * vector(mechanism.point(slider, step.pin)), turned)


def _rpr(mechanism: Mechanism, step: SlidingDyad, bodies: dict[str, Placed], drive: object) -> None:  # noqa: ARG001 - all alike
    guide, body = step.links
    slide = _slide(mechanism, body, guide)
    pins = [_between(mechanism, link, on) for link, on in zip(step.links, step.on, strict=True)]
    A, B = (bodies[on].carry(mechanism.point(on, pin)) for on, pin in zip(step.on, pins, strict=True))
    way, twist = fixed(slide.along), fixed(slide.turned)
    across = _arm(mechanism, guide, pins[0], slide.name) + twist * _arm(mechanism, body, slide.name, pins[1])
    o, d = across.turned_back(way).y, B - A
    t = (d.turned_back(d).x - o * o).root(step.branch)
    turned = d.over(Vector(t, o)).turned_back(way)
    for link, on, pin, turn in zip(step.links, step.on, pins, (turned, turned * twist), strict=True):
        bodies[link] = _pinned(bodies[on], mechanism.point(on, pin), mechanism.point(link, pin), turn)


def _prp(mechanism: Mechanism, step: CrossedSliders, bodies: dict[str, Placed], drive: object) -> None:  # noqa: ARG001 - all alike
    lines = []
    for slider, on in zip(step.sliders, step.on, strict=True):
        slide = _slide(mechanism, slider, on)
        turned = bodies[on].direction * fixed(slide.turned)
        zero = bodies[on].carry(mechanism.point(on, slide.name)) + turned * _arm(
            mechanism, slider, slide.name, step.pin
        )
        lines.append((zero, bodies[on].direction * fixed(slide.along), turned))
    (P, e, _), (Q, f, _) = lines
    s = f.turned_back(Q - P).y / f.turned_back(e).y
    C = P + e.times(s)
    for slider, (_, _, turned) in zip(step.sliders, lines, strict=True):
        bodies[slider] = Placed(C - turned * vector(mechanism.point(slider, step.pin)), turned)


def _rpp(mechanism: Mechanism, step: CrossSlide, bodies: dict[str, Placed], drive: object) -> None:  # noqa: ARG001 - all alike
    link, slider, (on, guide) = step.link, step.slider, step.on
    outer, inner, hinge = (
        _slide(mechanism, slider, guide),
        _slide(mechanism, link, slider),
        _between(mechanism, link, on),
    )
    mid = bodies[guide].direction * fixed(outer.turned)
    far = mid * fixed(inner.turned)
    bodies[link] = _pinned(bodies[on], mechanism.point(on, hinge), mechanism.point(link, hinge), far)
    e, f = bodies[guide].direction * fixed(outer.along), mid * fixed(inner.along)
    G = bodies[guide].carry(mechanism.point(guide, outer.name))
    end = bodies[link].carry(mechanism.point(link, inner.name))
    start = end - mid * _arm(mechanism, slider, outer.name, inner.name)  # slider's outer point if z = 0
    s = f.turned_back(start - G).y / f.turned_back(e).y
    P = G + e.times(s)
    bodies[slider] = Placed(P - mid * vector(mechanism.point(slider, outer.name)), mid)


SOLVERS: Mapping[type, Callable[..., None]] = {
    DrivenCrank: _turn,
    RRRDyad: _rrr,
    SliderDyad: _rrp,
    SlidingDyad: _rpr,
    CrossedSliders: _prp,
    CrossSlide: _rpp,
}
