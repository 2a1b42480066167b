"""Where a thing lies in the frame of another: r -> origin + rotation r.

Axes of a scene [m]: x across, to the weaver's right; y up; z to the front. A part that lies in the side view has its
own axes there by `IN_SIDE_VIEW`: its x to the front, its y up, its z to the weaver's left.
"""

import math
from functools import lru_cache

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import ParameterError
from ilmek.records import record

_NOT_TURNED = np.eye(3)
_NOT_TURNED.flags.writeable = False

_RIGHT_ANGLES = 1e-9
"""Deviation of R R^T from the identity that counts as rounding."""


@record
class Placement:
    """A rigid displacement: origin [m] and rotation matrix.

    Raises ParameterError for a matrix that is no rotation.
    """

    origin: Float[np.ndarray, " 3"]
    rotation: Float[np.ndarray, "3 3"]

    def __post_init__(self) -> None:
        if not _is_rotation(self.rotation.tolist()):
            raise ParameterError("a matrix that is no rotation", allowed="orthogonal, of determinant 1")

    def after(self, inner: "Placement") -> "Placement":
        """First `inner`, then this: the place in the outer frame of a thing that lies at `inner` in this one."""
        if self.rotation is _NOT_TURNED:
            return _sure(self.origin + inner.origin, inner.rotation)
        turned = self.rotation if inner.rotation is _NOT_TURNED else self.rotation @ inner.rotation
        return _sure(self.points(inner.origin), turned)

    def points(self, points: Float[np.ndarray, "*n 3"]) -> Float[np.ndarray, "*n 3"]:
        """Points of the thing's own frame in the other [m]."""
        return np.asarray(self.origin + points @ self.rotation.T)

    @property
    def inverse(self) -> "Placement":
        """The place of the other frame in the thing's own."""
        return _sure(-self.rotation.T @ self.origin, self.rotation.T)


def _is_rotation(rows: list[list[float]]) -> bool:
    (a, b, c), (d, e, f), (g, h, i) = rows
    lengths = a * a + b * b + c * c, d * d + e * e + f * f, g * g + h * h + i * i
    across = a * d + b * e + c * f, a * g + b * h + c * i, d * g + e * h + f * i
    right = all(abs(own - 1) < _RIGHT_ANGLES for own in lengths) and all(abs(own) < _RIGHT_ANGLES for own in across)
    return right and a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) > 0


def _sure(origin: Float[np.ndarray, " 3"], turned: Float[np.ndarray, "3 3"]) -> Placement:
    """The placement of a matrix that is a rotation by its making: it is not checked."""
    made = object.__new__(Placement)
    object.__setattr__(made, "origin", origin)
    object.__setattr__(made, "rotation", turned)
    return made


def placement(
    x: float = 0.0,
    y: float = 0.0,
    z: float = 0.0,
    *,
    about: tuple[float, float, float] | None = None,
    angle: float = 0.0,
) -> Placement:
    """Turned about an axis by an angle [rad], then moved to (x, y, z) [m].      [Rodrigues' formula]

    >>> placement(1.0, about=(0, 0, 1), angle=math.pi / 2).points(np.array([1.0, 0.0, 0.0])).round(12).tolist()
    [1.0, 1.0, 0.0]
    """
    return _sure(np.array([x, y, z], dtype=float), _NOT_TURNED if about is None else rotation(about, angle))


@lru_cache(maxsize=1024)
def rotation(axis: tuple[float, float, float], angle: float) -> Float[np.ndarray, "3 3"]:
    """The matrix that turns about an axis by an angle [rad]; raises ParameterError for an axis without direction."""
    length = math.hypot(*axis)
    if not length > 0:
        raise ParameterError(f"an axis of length {length:g}", allowed="above 0")
    x, y, z = (component / length for component in axis)
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turned = np.asarray(np.eye(3) + math.sin(angle) * across + (1 - math.cos(angle)) * across @ across)
    turned.flags.writeable = False
    return turned


IDENTITY = placement()
"""The frame itself."""

IN_SIDE_VIEW = Placement(np.zeros(3), np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]))
"""A part drawn in the side view: its x to the front, its y up, its z to the weaver's left."""

ALONG_WIDTH = Placement(np.zeros(3), np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]))
"""A part whose z points along the width, to the weaver's right: its x up, its y to the front."""

UPRIGHT = Placement(np.zeros(3), np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]))
"""A part whose z points up: its x to the front, its y across."""
