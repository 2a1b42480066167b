"""Many hands at once: four-bars by their pins where the finger's tip is lowest, their motion, and what they keep.

The coupler turns by f; crank and coupler pin follow by the dyad of crank and rocker, whose far pivot is turned back:

    A = dyad(A0, B0 - L e^{i f}; |A - A0|, |B - B0|),   L = B - A at f = 0             [linkage.groups.rrr]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray, IntArray
from ilmek.linkage.groups import rrr
from ilmek.machines.knotting_four_bar.hands.section import FOOT, InclinedSection, finger_points
from ilmek.plane.vectors import cross, dot
from ilmek.synthesis.four_bar import FourBar
from ilmek.units import mm, turn

TURNED = 1.4
"""Greatest angle of the coupler to either side of the middle [rad]."""

EYE = 5 * mm
"""Room about a moving pin [m]."""

BEARING = 9 * mm
"""Room about a pivot: of the driven shaft's housing in the plate [m]."""

LEAST_LINK = 13 * mm
"""Least distance of two pins of a link, and of the pivots [m]: the housing of a shaft beside a pin."""

BETWEEN = 0.5 * mm
"""Least distance of a finger's pillar from the links that it passes [m]."""

COLUMNS = 15 * mm
"""Height that plates and columns take over all that moves [m]."""

ROUNDING = 1e-9
"""Length that counts as rounding [m]."""

CHUNK = 16
"""Hands whose clearance is computed at once: few, for their points to stay in the cache."""


@dataclass(frozen=True, slots=True, eq=False)
class HandBatch:
    """Hands at the middle of their stroke; pins [m], of each hand one.

    depth  d of its finger [m]      a0, b0  pivots of crank and rocker      a, b  pins of the coupler
    """

    depth: FloatArray
    a0: ComplexArray
    b0: ComplexArray
    a: ComplexArray
    b: ComplexArray

    def __getitem__(self, chosen: object) -> "HandBatch":
        return HandBatch(*(np.atleast_1d(getattr(self, name)[chosen]) for name in self.__slots__))

    def __len__(self) -> int:
        return len(self.depth)

    @property
    def values(self) -> FloatArray:
        """The numbers of each hand, (hands, 9) [m]."""
        pins = (self.a0, self.b0, self.a, self.b)
        return np.stack([self.depth, *(part for pin in pins for part in (pin.real, pin.imag))], axis=1)

    @staticmethod
    def of(values: FloatArray) -> "HandBatch":
        """The hands of `values`; one of no depth has none of its numbers."""
        rows = np.where(values[:, :1] > 0, values, np.nan)
        return HandBatch(rows[:, 0], *(rows[:, k] + 1j * rows[:, k + 1] for k in (1, 3, 5, 7)))

    def four_bar(self, number: int, tracer: complex | None = None) -> FourBar:
        """The four-bar of a hand, with the foot of its finger as tracer [m]."""
        a0, b0, a, b = (complex(pin[number]) for pin in (self.a0, self.b0, self.a, self.b))
        return FourBar(a0, b0, a, b, tracer=tracer)


@dataclass(frozen=True, slots=True, eq=False)
class MovedHands:
    """The left hands of a batch over the coupler's angle, (hands, samples).

    f       angles of the coupler [rad]          crank   unwrapped [rad]
    a       coupler pins on the crank [m]        active  samples between both ends of the stroke
    centre  of the fingers' arcs at f = 0 [m], their radius and span from tip to foot
    """

    hands: HandBatch
    f: FloatArray
    a: ComplexArray
    crank: FloatArray
    active: BoolArray
    centre: ComplexArray
    radius: FloatArray
    span: FloatArray

    def carried(self, at: ComplexArray) -> ComplexArray:
        """Where points of the couplers at f = 0, (hands,), are over the samples [m]."""
        return np.asarray(self.a + (at - self.hands.a)[:, None] * np.exp(1j * self.f))

    @property
    def b(self) -> ComplexArray:
        """Coupler pins on the rocker [m]."""
        return self.carried(self.hands.b)

    @property
    def tip(self) -> ComplexArray:
        """Tips of the fingers [m]."""
        return self.carried(self.centre - 1j * self.radius)

    @property
    def foot_at(self) -> ComplexArray:
        """Feet of the fingers at f = 0 [m]."""
        return np.asarray(self.centre - 1j * self.radius * np.exp(-1j * self.span))

    @property
    def transmission(self) -> FloatArray:
        """Acute angle of coupler and rocker [rad], least over the stroke."""
        coupler, rocker = self.b - self.a, self.b - self.hands.b0[:, None]
        angle = np.arctan2(np.abs(cross(coupler, rocker)), np.abs(dot(coupler, rocker)))
        return np.asarray(np.min(np.where(self.active, angle, turn), axis=1))

    @property
    def swing(self) -> FloatArray:
        """Angle of the crank from one end of the stroke to the other [rad]; NaN where it turns back on it."""
        step, both = np.diff(self.crank, axis=1), self.active[:, 1:] & self.active[:, :-1]
        whole = np.sum(np.where(both, step, 0.0), axis=1)
        one_way = np.all(~both | (step * np.sign(whole)[:, None] > 0), axis=1)
        return np.where(one_way, np.abs(whole), np.nan)

    def clearance(self, section: InclinedSection, chosen: IntArray, count: int) -> FloatArray:
        """Least distance of the fingers of chosen hands from the warps over the stroke [m]; count: points of edges."""
        least = np.empty(len(chosen))
        for start in range(0, len(chosen), CHUNK):
            part = chosen[start : start + CHUNK]
            width = section.task.finger_width
            points = finger_points(self.centre[part], self.radius[part], self.span[part], width, count)
            from_a = points - self.hands.a[part][:, None]
            moved = self.a[part][:, :, None] + from_a[:, None, :] * np.exp(1j * self.f)[..., None]
            parked = np.where(self.active[part][:, :, None], moved, 1j)
            least[start : start + CHUNK] = section.clearance(parked)
        return least


def moved(section: InclinedSection, hands: HandBatch, samples: int) -> tuple[MovedHands, BoolArray]:
    """The hands over their strokes, and which of them have one: both ends in front of the warps, closed in between."""
    task = section.task
    f = np.linspace(-TURNED, TURNED, samples)[None, :]
    middle = samples // 2
    radius = section.radius(hands.depth)
    centre = -section.half_chord + 1j * (radius - hands.depth)
    coupler = (hands.b - hands.a)[:, None]
    far = hands.b0[:, None] - coupler * np.exp(1j * f)
    side = np.sign(cross(far[:, middle] - hands.a0, hands.a - hands.a0))[:, None]
    lengths = np.abs(hands.a - hands.a0)[:, None], np.abs(hands.b - hands.b0)[:, None]
    with np.errstate(invalid="ignore", divide="ignore"):
        a = np.asarray(rrr.position(hands.a0[:, None], far, *lengths, branch=side))
        tip = a + (centre - 1j * radius - hands.a)[:, None] * np.exp(1j * f)
        front = tip.imag >= task.front
        last = np.argmax(front[:, middle:], axis=1) + middle
        first = middle - np.argmax(front[:, middle::-1], axis=1)
    number = np.arange(samples)[None, :]
    active = (number >= first[:, None]) & (number <= last[:, None])
    ends = front[:, middle:].any(axis=1) & front[:, middle::-1].any(axis=1)
    closed = ends & ~np.any(np.isnan(a) & active, axis=1)
    a = np.where(np.isnan(a), hands.a[:, None], a)
    high = (radius - hands.depth - task.standoff - FOOT) / radius
    span = f[0, last] + np.arccos(np.clip(high, -1.0, 1.0))
    crank = np.unwrap(np.angle(a - hands.a0[:, None]), axis=1)
    return MovedHands(hands, f, a, crank, active, centre, radius, span), closed


def lacks(section: InclinedSection, hands: MovedHands) -> FloatArray:
    """What hands lack of the limits of links, transmission, swing and room, and of room about their pillars.

    The sum of all, each length in `EYE`, each angle in its limit; 0 within all.
    """
    task, at = section.task, hands.hands
    links = [np.abs(p - q) for p, q in ((at.a, at.a0), (at.b, at.b0), (at.b, at.a), (at.b0, at.a0))]
    feet = [np.abs(hands.foot_at - pin) for pin in (at.a, at.b)]
    pillar, still = hands.carried(hands.foot_at), np.ones((1, hands.f.size))
    outmost = hands.carried(hands.centre - 1j * hands.radius * np.exp(-1j * np.minimum(hands.span, turn / 4)))
    rooms = [(hands.a, EYE), (hands.b, EYE), (pillar, FOOT), *((p[:, None] * still, BEARING) for p in (at.a0, at.b0))]
    off = [_from_segment(pillar, pivot[:, None], pin) for pivot, pin in ((at.a0, hands.a), (at.b0, hands.b))]
    lengths = [
        section.least_depth - at.depth,
        *(LEAST_LINK - length for length in links),
        *(EYE + FOOT + BETWEEN - length for length in feet),
        *(over(hands.active, EYE + FOOT + BETWEEN - length) for length in off),
    ]
    for points, room in (*rooms, (outmost, task.finger_width / 2)):
        aside = np.abs(points.real - section.shift) + room
        beyond = aside - task.room_length / 2, points.imag + room + COLUMNS - task.room_height
        lengths += (over(hands.active, one) for one in beyond)
    lengths += (over(hands.active, task.standoff - points.imag + room) for points, room in rooms)
    angles = [1 - hands.transmission / task.transmission_limit, hands.swing / task.swing_limit - 1]
    wanting = [*(np.where(length > ROUNDING, length / EYE, 0.0) for length in lengths), *angles]
    return np.asarray(np.sum(np.maximum(wanting, 0.0), axis=0))


def over(active: BoolArray, values: FloatArray) -> FloatArray:
    """The greatest of the active values, over the last axis."""
    return np.asarray(np.max(np.where(active, values, -np.inf), axis=1))


def _from_segment(points: ComplexArray, start: ComplexArray, end: ComplexArray) -> FloatArray:
    """Distance of points from segments [m]."""
    along, to = end - start, points - start
    share = np.clip(dot(to, along) / np.maximum(dot(along, along), 1e-300), 0.0, 1.0)
    return np.asarray(np.abs(to - share * along))
