"""Random mechanisms of every group of class II, many variants of a plan at once.

Two cranks O-A and Q-B, driven by courses of their own, carry the group; so both of what it hangs on moves, and every
body's frame lies anywhere. A family has one plan: its slides' angles, and which body is the guide, are drawn once, all
points of all bodies once for each variant.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.batch import Sweep, sweep
from ilmek.linkage.groups.rpp import CrossSlide
from ilmek.linkage.model import GROUND, Body, Joint, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.structure import Plan, plan
from ilmek.plane.vectors import cross

KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP")
LEAST = {"RRR": 0.2, "RRP": 0.2, "RPR": 0.1, "PRP": 0.2, "RPP": 0.0}
"""Least margin (see `ilmek.linkage.batch.Sweep`) of a mechanism that counts as far from its dead centres."""

CHUNK = 256
"""Variants in a family at most, so that its motion fits the memory."""

Course = dict[str, FloatArray]


@dataclass(frozen=True)
class Family:
    """Variants of one plan: (body, point) -> places [m], free joint -> branches."""

    kind: str
    plan: Plan
    places: dict[tuple[str, str], ComplexArray]
    branches: dict[str, FloatArray] = field(default_factory=dict)

    def chosen(self, which: np.ndarray) -> "Family":
        """Some of the variants."""
        places = {one: place[which] for one, place in self.places.items()}
        return Family(self.kind, self.plan, places, {name: sign[which] for name, sign in self.branches.items()})

    def __len__(self) -> int:
        return len(next(iter(self.places.values())))

    def move(self, courses: tuple[Course, Course, Course]) -> Sweep:
        """The motion of all bodies and of all joints' points."""
        mechanism = self.plan.mechanism
        points = [(body, joint.name) for joint in mechanism.joints for body in joint.bodies]
        return sweep(self.plan, self.places, *courses, branches=self.branches, bodies=mechanism.moving, points=points)

    def judge(self, courses: tuple[Course, Course, Course]) -> Sweep:
        """Statuses and margins alone."""
        return sweep(self.plan, self.places, *courses, branches=self.branches)


def turn(kind: str, samples: int) -> tuple[Course, Course, Course]:
    """One turn of both cranks, the second at a changing speed; values, speeds, accelerations.

    Lines on both cranks (PRP) keep within a share of a turn of one another, so that they never are parallel.
    """
    t = np.arange(samples) * (2 * np.pi / samples)
    way = 1 if kind == "PRP" else -1
    ones = np.ones(samples)
    return (
        {"left": t, "right": way * t + 0.4 * np.sin(t)},
        {"left": ones, "right": way + 0.4 * np.cos(t)},
        {"left": 0 * t, "right": -0.4 * np.sin(t)},
    )


def far_from_dead(kind: str, count: int, rng: np.random.Generator) -> Iterator[Family]:
    """Families of together `count` mechanisms that turn fully and keep well away from dead centres."""
    while count > 0:
        drawn = draw(kind, 4096, rng)
        swept = drawn.judge(turn(kind, 128))
        good = np.flatnonzero((swept.status == 0).all(axis=1) & (swept.margin >= LEAST[kind]))[:count]
        if len(good):
            count -= len(good)
            for start in range(0, len(good), CHUNK):
                yield drawn.chosen(good[start : start + CHUNK])


def draw(kind: str, variants: int, rng: np.random.Generator) -> Family:
    """A family of mechanisms of a kind, most of which close somewhere, and some everywhere."""

    def between(low: float, high: float) -> FloatArray:
        return rng.uniform(low, high, variants)

    def anywhere(low: float, high: float) -> ComplexArray:
        return np.asarray(between(low, high) * np.exp(1j * between(-np.pi, np.pi)))

    first = anywhere(0, 1)
    second = anywhere(0, 1) if kind == "RPP" else first + anywhere(1.5, 3)
    left, right = anywhere(0, 0.5), anywhere(0, 0.5)
    places = {
        (GROUND, "O"): first,
        (GROUND, "Q"): second,
        ("left", "O"): left,
        ("right", "Q"): right,
        ("left", "A"): left + anywhere(0.1, 0.5),
        ("right", "B"): right + anywhere(0.1, 0.5),
        ("one", "A"): anywhere(0, 0.5),
        ("two", "B"): anywhere(0, 0.5),
        ("one", "C"): anywhere(0, 0.5),
        ("two", "C"): anywhere(0, 0.5),
    }
    if kind == "RPR":  # offsets greater than the pins' distance, too
        places["two", "B"] = anywhere(0, 3)
    outer = kind[0], kind[2]
    if kind[1] == "R":
        for body, joint, end in (("one", outer[0], "A"), ("two", outer[1], "B")):
            if joint == "R":
                places[body, "C"] = places[body, end] + anywhere(0.5, 4)
    joints = (
        Pin("O", GROUND, "left"),
        Pin("Q", GROUND, "right"),
        _joint("A", "left", "one", outer[0], rng),
        _joint("B", "right", "two", outer[1], rng),
        _joint("C", "one", "two", kind[1], rng),
    )
    free = "C" if kind in {"RRR", "RRP", "RPR"} else ""
    bodies = dict.fromkeys(body for body, _ in places)
    mechanism = Mechanism(
        tuple(Body(body, {p: complex(at[0]) for (b, p), at in places.items() if b == body}) for body in bodies),
        joints,
        (Rotation("left", "O"), Rotation("right", "Q")),
        branches={free: +1} if free else {},
    )
    branches = {free: rng.choice([-1.0, 1.0], variants)} if free else {}
    planned = plan(mechanism)
    step = planned.steps[-1]
    if isinstance(step, CrossSlide) and np.abs(cross(step.track.lead, step.track.twist * step.lead)) < LEAST["PRP"]:
        return draw(kind, variants, rng)
    return Family(kind, planned, places, branches)


def _joint(name: str, known: str, new: str, kind: str, rng: np.random.Generator) -> Joint:
    """A pin, or a slide in any direction, either body its guide."""
    if kind == "R":
        return Pin(name, known, new)
    along, turned = rng.uniform(-np.pi, np.pi, 2)
    body, guide = (new, known) if rng.integers(2) else (known, new)
    return Slide(name, body, guide, float(along), float(turned))
