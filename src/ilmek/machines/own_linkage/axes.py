"""Axes of the pins of a mechanism and lines of its slides: what one pin, or one rail, is made for.

Pins of several pairs of bodies at one point are one axis. A slide's line lies in the guiding body; the carriage is at
the sliding body's point of the joint's name, and travels as far as the motion takes it.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from ilmek.dynamics.inverse_run import InverseRun
from ilmek.linkage.model import GROUND, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.outputs import Travel, output_history
from ilmek.records import record

_SAME = 1e-9
"""Distance [m] below which two points of a body are one."""


@record
class PinAxis:
    """An axis about which bodies turn.

    name    of the first of its joints      joints  of two bodies each
    points  body -> point of the axis in its frame [m]
    driven  the body that an input turns against the ground: the axis is that of its shaft; "": none
    """

    name: str
    joints: tuple[str, ...]
    points: Mapping[str, complex]
    driven: str = ""


@record
class SlideLine:
    """A line along which a body slides in another.

    on, along      point and unit vector of the line in the guide's frame [m]
    at, forward    the point of the carriage, and the same direction, in the sliding body's frame
    travel         least and greatest distance of the carriage from `on` along the line [m]
    """

    name: str
    body: str
    guide: str
    on: complex
    along: complex
    at: complex
    forward: complex
    travel: tuple[float, float]


def pin_axes(mechanism: Mechanism) -> tuple[PinAxis, ...]:
    """The axes of a mechanism's pins, in the order of its joints."""
    groups: list[tuple[list[str], dict[str, complex]]] = []
    for joint in mechanism.joints:
        if not isinstance(joint, Pin):
            continue
        points = {body: mechanism.point(body, joint.name) for body in joint.bodies}
        met = [group for group in groups if any(_meets(group[1], body, point) for body, point in points.items())]
        names = [name for group in met for name in group[0]] + [joint.name]
        for group in met:
            points = group[1] | points
            groups.remove(group)
        groups.append((names, points))
    turned = {entry.about: entry.body for entry in mechanism.inputs if isinstance(entry, Rotation)}
    return tuple(PinAxis(names[0], tuple(names), points, _driven(names, points, turned)) for names, points in groups)


def _meets(points: Mapping[str, complex], body: str, point: complex) -> bool:
    return body in points and abs(points[body] - point) < _SAME


def _driven(joints: list[str], points: Mapping[str, complex], turned: Mapping[str, str]) -> str:
    """The body that an input turns about one of the joints, where the ground is the other."""
    bodies = [turned[joint] for joint in joints if joint in turned and GROUND in points]
    if bodies and bodies[0] == GROUND:
        return next(body for body in points if body != GROUND)
    return bodies[0] if bodies else ""


def slide_lines(motion: Motion) -> tuple[SlideLine, ...]:
    """The lines of a mechanism's slides, with their travel over a motion."""
    return tuple(_slide_lines(motion))


def _slide_lines(motion: Motion) -> Iterator[SlideLine]:
    mechanism = motion.plan.mechanism
    for joint in mechanism.joints:
        if isinstance(joint, Slide):
            value = output_history(motion, Travel(joint.name)).value
            points = (mechanism.point(body, joint.name) for body in (joint.guide, joint.body))
            along = complex(np.exp(1j * joint.along))
            on, at = points
            forward = along * complex(np.exp(-1j * joint.turned))
            ends = float(np.nanmin(value)), float(np.nanmax(value))
            yield SlideLine(joint.name, joint.body, joint.guide, on, along, at, forward, ends)


@record
class JointLoads:
    """Greatest forces and torques of a mechanism; 0 where it has none.

    pins     axis -> body -> greatest force of the axis on it, summed over its joints [N]
    slides   slide -> greatest force across its line, and couple [N, N m]
    torques  driven body -> greatest torque [N m]
    """

    pins: Mapping[str, Mapping[str, float]]
    slides: Mapping[str, tuple[float, float]]
    torques: Mapping[str, float]


def joint_loads(mechanism: Mechanism, axes: tuple[PinAxis, ...], run: InverseRun | None) -> JointLoads:
    """The loads of a run; of none where there are no forces."""
    if run is None:
        return JointLoads({}, {}, {})
    forces = run.forces
    bodies = {joint.name: joint.bodies for joint in mechanism.joints}

    def on(axis: PinAxis, body: str) -> float:
        return sum(_peak(forces.reactions[name]) for name in axis.joints if body in bodies[name])

    return JointLoads(
        {axis.name: {body: on(axis, body) for body in axis.points} for axis in axes},
        {name: (_peak(forces.reactions[name]), _peak(couple)) for name, couple in forces.couples.items()},
        {name: _peak(effort) for name, effort in forces.efforts.items()},
    )


def _peak(values: np.ndarray) -> float:
    """Greatest magnitude of what is known; 0 where nothing is."""
    size = np.abs(values)
    return float(np.max(size[np.isfinite(size)], initial=0.0))
