"""The anchor of a body: a point of it near the others, so that distances do not lose digits to a distant origin.

A mechanism of 0.1 m at 100 m from the origin of its drawing has 13 digits of its coordinates left, and 16 of their
differences. Inside a solution the world's origin is the ground's anchor.
"""

from collections.abc import Container, Mapping

from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.model import GROUND, Body, Mechanism


def anchor_name(mechanism: Mechanism, body: str) -> str | None:
    """The anchor of a body: its first point that belongs to a joint, or its first; None for a body without a point."""
    return _anchor(mechanism.body(body), {joint.name for joint in mechanism.joints})


def _anchor(body: Body, joints: Container[str]) -> str | None:
    return next((name for name in body.points if name in joints), next(iter(body.points), None))


def anchors(mechanism: Mechanism) -> Mapping[str, complex]:
    """Body -> its anchor in its frame [m]; 0 for a body without a point."""
    joints = {joint.name for joint in mechanism.joints}
    names = ((body, _anchor(body, joints)) for body in mechanism.bodies)
    return {body.name: 0j if name is None else body.points[name] for body, name in names}


def span(mechanism: Mechanism) -> float:
    """Largest distance of a body's point from the body's anchor [m]; 1 if all are 0."""
    at = anchors(mechanism)
    lengths = (abs(point - at[body.name]) for body in mechanism.bodies for point in body.points.values())
    return max(lengths, default=0.0) or 1.0


def local_ground(mechanism: Mechanism) -> BodyMotion:
    """The ground at rest with its anchor at zero: the world of a solution."""
    return BodyMotion(PointMotion(0j, 0j, 0j), anchors(mechanism)[GROUND], 1 + 0j, 0.0, 0.0)
