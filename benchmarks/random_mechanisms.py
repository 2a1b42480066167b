"""Random mechanisms of every kind of class II, with random masses: what campaigns are run over.

A mechanism is drawn in place: bodies and joints stand anywhere, and every link is what joins them there. Each way of
putting a dyad together then closes, at the input where it was drawn and near it.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ilmek.dynamics.inertia import Inertia
from ilmek.linkage.model import GROUND, Body, Displacement, Input, Joint, Mechanism, Pin, Rotation, Slide

DYADS = ("RRR", "RRP", "RPR", "PRP", "RPP")
"""Outer joint on the first body, inner joint, outer joint on the second."""

REACH = 1.0


@dataclass(slots=True)
class Sketch:
    """A mechanism while it is drawn: poses of the bodies, their points, joints, inputs with the value drawn."""

    draw: np.random.Generator
    poses: dict[str, tuple[complex, float]] = field(default_factory=lambda: {GROUND: (0j, 0.0)})
    points: dict[str, dict[str, complex]] = field(default_factory=lambda: {GROUND: {}})
    joints: list[Joint] = field(default_factory=list)
    inputs: dict[Input, float] = field(default_factory=dict)
    branches: dict[str, int] = field(default_factory=dict)

    def place(self) -> complex:
        x, y = self.draw.uniform(-REACH, REACH, 2)
        return complex(x, y)

    def body(self) -> str:
        name = f"body {len(self.poses)}"
        self.poses[name] = self.place(), float(self.draw.uniform(-np.pi, np.pi))
        self.points[name] = {}
        return name

    def mark(self, body: str, point: str, at: complex) -> None:
        origin, angle = self.poses[body]
        self.points[body][point] = complex((at - origin) * np.exp(-1j * angle))

    def pin(self, first: str, second: str) -> str:
        name, at = f"joint {len(self.joints)}", self.place()
        self.mark(first, name, at)
        self.mark(second, name, at)
        self.joints.append(Pin(name, first, second))
        return name

    def slide(self, body: str, guide: str) -> tuple[str, float]:
        """A slide, and its travel as drawn."""
        name, root = f"joint {len(self.joints)}", self.place()
        along, travel = self.draw.uniform(-np.pi, np.pi), self.draw.uniform(-REACH, REACH)
        turned = self.poses[body][1] - self.poses[guide][1]
        self.mark(guide, name, root)
        self.mark(body, name, complex(root + travel * np.exp(1j * (self.poses[guide][1] + along))))
        self.joints.append(Slide(name, body, guide, float(along), turned))
        return name, float(travel)

    def driven(self, carrier: str) -> None:
        body = self.body()
        if self.draw.random() < 0.8:
            name = self.pin(carrier, body)
            self.inputs[Rotation(body, name)] = self.poses[body][1] - self.poses[carrier][1]
        else:
            name, travel = self.slide(body, carrier)
            self.inputs[Displacement(name)] = travel

    def dyad(self, kind: str, first: str, second: str) -> None:
        """A dyad hung on two bodies, put together either way."""
        a, b = self.body(), self.body()
        ends = ((kind[0], a, first), (kind[1], a, b), (kind[2], b, second))
        for at, (joint, one, other) in enumerate(ends):
            swapped = self.draw.random() < 0.5
            one, other = (other, one) if swapped else (one, other)
            name = self.pin(one, other) if joint == "R" else self.slide(one, other)[0]
            if at == 1:
                self.branches[name] = int(self.draw.choice((-1, 1)))

    def mechanism(self) -> Mechanism:
        bodies = tuple(Body(name, points) for name, points in self.points.items())
        return Mechanism(bodies, tuple(self.joints), tuple(self.inputs), self.branches, pose=self.poses)


def random_mechanism(draw: np.random.Generator) -> tuple[Mechanism, dict[str, float]]:
    """A mechanism of one or two inputs and one to three dyads, and its inputs' values as drawn."""
    sketch = Sketch(draw)
    sketch.driven(GROUND)
    if draw.random() < 0.3:
        sketch.driven(str(draw.choice(list(sketch.poses))))
    for _ in range(int(draw.integers(1, 4))):
        moving = list(sketch.poses)[1:]
        first = str(draw.choice(moving))
        second = str(draw.choice([body for body in sketch.poses if body != first]))
        sketch.dyad(str(draw.choice(DYADS)), first, second)
    return sketch.mechanism(), {entry.name: value for entry, value in sketch.inputs.items()}


def random_inertias(draw: np.random.Generator, mechanism: Mechanism) -> dict[str, Inertia]:
    """Masses and moments of most bodies; the others are massless."""
    numbers: Callable[..., np.ndarray] = draw.uniform
    weighed = [body for body in mechanism.moving if draw.random() < 0.9]
    return {
        body: Inertia(float(mass), complex(x, y), float(moment))
        for body, (mass, x, y, moment) in zip(
            weighed, numbers((0.1, -1, -1, 0.01), (5, 1, 1, 1), (len(weighed), 4)), strict=True
        )
    }
