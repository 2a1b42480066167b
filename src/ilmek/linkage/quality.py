"""Quality of a linkage: Grashof's class, transmission angle, dead centres, range of the input.

Four-bars are given by their lengths [m], in the order of `four_bar`: ground g, crank a, coupler b, rocker c, with the
crank's angle against the ground link A0 -> B0. The formulas are the law of cosines in the triangle A, B0, B.
[Norton, Design of Machinery, chapters 2 and 4]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import lengths
from ilmek.linkage.model import Pin
from ilmek.linkage.motion import Motion
from ilmek.plane.vectors import cross, dot

_TURNING = {"ground": "double-crank", "crank": "crank-rocker", "coupler": "double-rocker", "rocker": "rocker-crank"}


@dataclass(frozen=True, slots=True)
class Grashof:
    """Grashof's class of a four-bar.

    ratio     (shortest + longest) / (sum of the other two): below 1 the shortest link turns fully against the others
    kind      double-crank, crank-rocker, double-rocker, rocker-crank (by the shortest link: ground, crank, coupler,
              rocker), change point (ratio 1), or triple-rocker (ratio above 1: no link turns fully)
    crank_turns  whether the crank turns fully against the ground
    """

    ratio: float
    kind: str
    crank_turns: bool


def grashof(ground: float, crank: float, coupler: float, rocker: float) -> Grashof:
    """Grashof's class of a four-bar [Norton, Design of Machinery, section 2.13]; equal within 1e-12 is a change point.

    Raises MechanismError for a length that is not above zero.
    >>> grashof(0.300, 0.0597, 0.2007, 0.2308).kind
    'crank-rocker'
    """
    named = dict(ground=ground, crank=crank, coupler=coupler, rocker=rocker)
    lengths("four-bar", **named)
    ordered = sorted(named.values())
    ratio = (ordered[0] + ordered[3]) / (ordered[1] + ordered[2])
    if abs(ratio - 1) <= 1e-12:
        kind = "change point"
    elif ratio > 1:
        kind = "triple-rocker"
    else:
        kind = _TURNING[min(named, key=lambda name: named[name])]
    return Grashof(ratio, kind, kind in ("double-crank", "crank-rocker"))


def input_range(ground: float, crank: float, coupler: float, rocker: float) -> tuple[tuple[float, float], ...]:
    """Crank angles [rad] in which the four-bar closes: intervals (from, to), ascending, within (-pi, pi].

        |b - c| <= |A B0| <= b + c    with    |A B0|^2 = g^2 + a^2 - 2 g a cos(crank angle)

    ((-pi, pi),) where the crank turns fully; () where the links never meet; the ends are the dead centres of the crank,
    coupler and rocker in line. An interval about pi is written with its end beyond: (to, 2 pi - to).
    Raises MechanismError for a length that is not above zero.

    >>> [[round(math.degrees(end), 3) for end in ends] for ends in input_range(0.300, 0.200, 0.200, 0.230)]
    [[-117.226, 117.226]]
    """
    lengths("four-bar", ground=ground, crank=crank, coupler=coupler, rocker=rocker)
    least = (ground**2 + crank**2 - (coupler + rocker) ** 2) / (2 * ground * crank)
    most = (ground**2 + crank**2 - (coupler - rocker) ** 2) / (2 * ground * crank)
    if least > 1 or most < -1:
        return ()
    inner, outer = math.acos(min(most, 1.0)), math.acos(max(least, -1.0))
    if most >= 1:
        return ((-outer, outer),)
    if least <= -1:
        return ((inner, 2 * math.pi - inner),)
    return (-outer, -inner), (inner, outer)


@dataclass(frozen=True, slots=True)
class DeadCentre:
    """A dead centre of the rocker, crank and coupler in line: angles [rad] of both against the ground link."""

    crank_angle: float
    rocker_angle: float
    extended: bool


def dead_centres(ground: float, crank: float, coupler: float, rocker: float, *, branch: int) -> tuple[DeadCentre, ...]:
    """The ends of the rocker's swing: extended (|A0 B| = a + b), then folded (|A0 B| = |a - b|), where they exist.

    With B = r e^{i crank angle}, r = a + b or a - b, and |B - g| = c: cos(crank angle) = (r^2 + g^2 - c^2) / (2 r g).
    ground, crank, coupler, rocker  lengths g, a, b, c [m]      branch  as in `four_bar`
    Returns none, one or both, with angles [rad] within (-pi, pi].
    Raises MechanismError for a length that is not above zero, or a branch that is neither +1 nor -1.

    >>> extended, folded = dead_centres(0.300, 0.0597, 0.2007, 0.2308, branch=+1)
    >>> round(math.degrees(extended.crank_angle), 1), round(math.degrees(folded.crank_angle), 1)
    (48.0, -132.0)
    """
    lengths("four-bar", ground=ground, crank=crank, coupler=coupler, rocker=rocker)
    if branch not in (+1, -1):
        raise MechanismError(f"branch of the four-bar is {branch!r}", allowed="+1 or -1")
    dead_centres = []
    for extended, reach in ((True, crank + coupler), (False, crank - coupler)):
        cosine = (reach**2 + ground**2 - rocker**2) / (2 * reach * ground) if reach else math.inf
        if abs(cosine) <= 1:
            angle = branch * (1 if extended else -1) * math.acos(cosine)
            rocker_angle = math.atan2(reach * math.sin(angle), reach * cosine - ground)
            dead_centres.append(DeadCentre(angle, rocker_angle, extended))
    return tuple(dead_centres)


def transmission_extremes(ground: float, crank: float, coupler: float, rocker: float) -> tuple[float, float]:
    """Least and greatest angle [rad] between coupler and rocker over the closing crank angles of a four-bar.

    cos mu = (b^2 + c^2 - |A B0|^2) / (2 b c), extreme where |A B0| is: |g - a| at crank angle 0, g + a at pi; 0 or pi
    where the crank does not reach these angles. The relevant measure is the smaller distance from 0 or pi.
    Arguments are lengths g, a, b, c [m].
    Raises MechanismError for a length that is not above zero.

    >>> [round(math.degrees(mu), 2) for mu in transmission_extremes(0.300, 0.0597, 0.2007, 0.2308)]
    [67.26, 112.76]
    """
    lengths("four-bar", ground=ground, crank=crank, coupler=coupler, rocker=rocker)
    ends = (abs(ground - crank), ground + crank)
    cosines = [(coupler**2 + rocker**2 - reach**2) / (2 * coupler * rocker) for reach in ends]
    least, greatest = (math.acos(min(1.0, max(-1.0, cosine))) for cosine in cosines)
    return least, greatest


def transmission_angle(
    motion: Motion, pin: str, *, from_points: tuple[str, str] | None = None
) -> Float[np.ndarray, " samples"]:
    """Angle [rad], 0 to pi, between the two links at a pin, at each sample; NaN where they do not close.

    Each link is the line from its other pin to this one. For the free pin of an RRR dyad this is the transmission
    angle: best at pi/2, a dead centre at 0 and pi.
    from_points  a point of each link, in the pin's order of bodies; default: the first other pin of each link in the
                 mechanism's order. Required in practice for links with three pins or more
    Raises MechanismError for an unknown pin or point, a slide, or a link with no other pin.
    """
    joint = motion.plan.mechanism.joint(pin)
    if not isinstance(joint, Pin):
        raise MechanismError(f"{pin!r} is a slide", allowed="a transmission angle is at a pin between two links")
    starts = from_points or tuple(_other_pin(motion, body, pin) for body in joint.bodies)
    first, second = (_link(motion, body, start, pin) for body, start in zip(joint.bodies, starts, strict=True))
    return np.arctan2(np.abs(cross(first, second)), dot(first, second))


def least_transmission_angle(motion: Motion, pin: str) -> float:
    """Smallest acute transmission angle [rad] over the samples: the least of mu and pi - mu; NaN if a sample is NaN."""
    mu = transmission_angle(motion, pin)
    return float(np.min(np.minimum(mu, np.pi - mu)))


def _other_pin(motion: Motion, body: str, pin: str) -> str:
    """The first other pin of a body in the mechanism's order."""
    mechanism = motion.plan.mechanism
    others = [j.name for j in mechanism.joints if isinstance(j, Pin) and body in j.bodies and j.name != pin]
    if not others:
        raise MechanismError(f"body {body!r} of {mechanism.name} has no pin but {pin!r}", do="choose another pin")
    return others[0]


def _link(motion: Motion, body: str, start: str, pin: str) -> np.ndarray:
    """From a body's point to its pin, in the world [m]."""
    mechanism = motion.plan.mechanism
    link: np.ndarray = motion.direction(body) * (mechanism.point(body, pin) - mechanism.point(body, start))
    return link
