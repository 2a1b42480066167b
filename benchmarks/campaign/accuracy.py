"""Loops close, Newton's method agrees, rates are derivatives: for random mechanisms of a kind that turn fully."""

from dataclasses import dataclass

import numpy as np

from benchmarks.campaign.exact import Points, truth
from benchmarks.campaign.random_linkages import Course, Family, far_from_dead, turn
from benchmarks.campaign.read import NEW, carried, field, poses
from ilmek.linkage.batch import Sweep
from ilmek.linkage.model import Slide
from ilmek.linkage.status import Status

SAMPLES = 512
"""Samples of a turn for the spectral derivatives."""


@dataclass
class Accuracy:
    """The worst found of any mechanism of a kind: of its size, and of its largest rate."""

    mechanisms: int = 0
    closure: float = 0.0
    newton: float = 0.0
    velocity: float = 0.0
    acceleration: float = 0.0

    def join(self, closure: float, newton: float, velocity: float, acceleration: float) -> None:
        """One family's worst."""
        self.closure, self.newton = max(self.closure, closure), max(self.newton, newton)
        self.velocity, self.acceleration = max(self.velocity, velocity), max(self.acceleration, acceleration)


def accuracy(kind: str, count: int, rng: np.random.Generator) -> Accuracy:
    """Mechanisms that turn fully, a turn each."""
    found, courses = Accuracy(), turn(kind, SAMPLES)
    for family in far_from_dead(kind, count, rng):
        swept = family.move(courses)
        found.mechanisms += len(family) if (swept.status == Status.OK).all() else 0
        found.join(closure(family, swept), newton(family, swept, courses, rng), *derivatives(swept))
    return found


def closure(family: Family, swept: Sweep) -> float:
    """The worst miss of any joint, of the size of its mechanism."""
    worst = np.zeros(swept.status.shape)
    reach = np.ones(len(family))
    for joint in family.plan.mechanism.joints:
        first, second = joint.bodies
        apart = field(swept, first, joint.name, 0) - field(swept, second, joint.name, 0)
        reach = np.maximum(reach, np.abs(field(swept, first, joint.name, 0)).max(axis=1))
        if isinstance(joint, Slide):
            guide = swept.bodies[second].direction
            turned = swept.bodies[first].direction * np.conj(guide * np.exp(1j * joint.turned))
            worst = np.maximum(worst, np.abs(turned - 1))
            apart = (apart * np.conj(guide * np.exp(1j * joint.along))).imag
        worst = np.maximum(worst, np.abs(apart))
    return float((worst.max(axis=1) / reach).max())


def newton(family: Family, swept: Sweep, courses: tuple[Course, Course, Course], rng: np.random.Generator) -> float:
    """The worst difference from Newton's method, each mechanism in a sample of its own, started a little away."""
    at = rng.integers(0, swept.status.shape[1], len(family))
    each = np.arange(len(family))
    start = {
        body: (origin + 1e-3 * rng.standard_normal(len(family)), angle + 1e-3 * rng.standard_normal(len(family)))
        for body, (origin, angle) in poses(family, swept, at).items()
    }
    known = truth(family, start, {crank: [course[crank][at] for course in courses] for crank in courses[0]})
    worst = 0.0
    for body in NEW:
        for point, motion in carried(family, known[body], body).items():
            for order, value in enumerate(motion):
                apart = field(swept, body, point, order)[each, at] - value
                worst = max(worst, float((np.abs(apart) / np.maximum(1, np.abs(value))).max()))
    return worst


def derivatives(swept: Sweep) -> tuple[float, float]:
    """The worst difference of velocities and accelerations from spectral derivatives, of the mechanism's largest."""
    pairs: list[list[tuple[Points, Points]]] = [[], []]
    for body, point in swept.points:
        if body in NEW:
            place, velocity, acceleration = (field(swept, body, point, order) for order in range(3))
            pairs[0].append((place, velocity))
            pairs[1].append((velocity, acceleration))
    for body in NEW:
        turning = swept.bodies[body]
        pairs[0].append((turning.direction, 1j * turning.omega * turning.direction))
        pairs[1].append((turning.omega, turning.alpha))
    return _worst(pairs[0]), _worst(pairs[1])


def _worst(pairs: list[tuple[Points, Points]]) -> float:
    error = np.max([np.abs(_derivative(value) - rate).max(axis=1) for value, rate in pairs], axis=0)
    scale = np.max([np.abs(rate).max(axis=1) for _, rate in pairs], axis=0)
    return float((error / scale).max())


def _derivative(field: Points) -> Points:
    """d/dt of a field over one turn of t."""
    samples = field.shape[1]
    order = np.fft.fftfreq(samples, 1 / samples)
    order[samples // 2] = 0
    rate: Points = np.fft.ifft(1j * order * np.fft.fft(field, axis=1), axis=1)
    return rate
