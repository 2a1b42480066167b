"""How fast the bodies of a tree move over the turns of its drives, and their kinetic energy.

    v = o' + R' r         of a point r of the body;   E = (m |o'|² + 2 o' . R' f + tr(R' S R'^T)) / 2

o, R pose of the body, m, f, S moments of its mass [`part.moments`]. The speed is that of the fastest corner of the
body's hull: no point in it is faster, as |v| is convex. Derivatives are central differences within the pieces between
which each motion is straight.
"""

from collections.abc import Mapping

import numpy as np
from scipy.spatial import ConvexHull

from ilmek.arrays import Float, FloatArray
from ilmek.part.poses import Chain, chains, drive_angles, poses
from ilmek.part.tree import RigidBody, Tree
from ilmek.records import record
from ilmek.units import deg, mm, turn

_STEP = 2 * deg
"""Greatest distance of two angles of a drive at which the bodies are looked at [rad]."""

DEVIATION = 1 * mm
"""Of the hull from round shapes [m]."""

_APART = 1e-5
"""Of both poses of a central difference, at most [rad]."""


@record
class MovingEnergy:
    """Greatest speed of a point of a body [m/s], and greatest energy of one such body with all that it carries [J].

    returned  mean power of the falls of this energy [W]: what a drive without losses takes back while it brakes
    """

    speed: float
    energy: float
    returned: float = 0.0


def moving_energies(tree: Tree, periods: Mapping[str, float]) -> dict[str, MovingEnergy]:
    """Of each body that moves, by its id; periods: time of a turn of each drive [s], one at a time."""
    first: dict[str, Chain] = {}
    for chain in chains(tree):
        first.setdefault(chain[-1].name, chain)
    most, counts = dict[str, MovingEnergy](), tree.counts()
    for drive, period in periods.items():
        angle = drive_angles(tree, drive)
        moved = {
            name: _moved(chain, drive, angle, turn / period) for name, chain in first.items() if _moves(chain, drive)
        }
        for name, (speed, _) in moved.items():
            carried = (counts[own] / counts[name] * moved[own][1] for own in tree.carried_by(name))
            before = most.get(name, MovingEnergy(0.0, 0.0))
            whole = sum(carried, np.zeros(1))
            energy, falls = max(before.energy, float(np.max(whole))), np.maximum(whole - np.roll(whole, -1), 0.0)
            returned = before.returned + float(np.sum(falls)) / period
            most[name] = MovingEnergy(max(before.speed, speed), energy, returned)
    return most


def _moves(chain: Chain, drive: str) -> bool:
    motions = (link.body.joint.motion for link in chain if link.moves)
    return any(motion is not None and motion.drive == drive for motion in motions)


def _moved(chain: Chain, drive: str, angle: FloatArray, speed: float) -> tuple[float, FloatArray]:
    """Greatest speed of a body [m/s], and its own energy in each piece of the drive's angle [J]."""
    number = np.ceil(np.diff(angle) / _STEP).astype(int)
    begin, length = np.repeat(angle[:-1], number), np.repeat(np.diff(angle) / number, number)
    inside = np.arange(len(begin)) - np.repeat(np.cumsum(number) - number, number)
    middle, apart = begin + (inside + 0.5) * length, np.minimum(length / 4, _APART)
    before, after = (poses(chain, drive, middle + sign * apart) for sign in (-1, 1))
    rate = speed / (2 * apart)
    origin = (after.origin - before.origin) * rate[:, None]
    turning = (after.rotation - before.rotation) * rate[:, None, None]
    body = chain[-1].body
    moments = body.moments
    energy = (
        moments.zeroth * (origin**2).sum(1)
        + 2 * (origin * (turning @ moments.first)).sum(1)
        + np.einsum("nij,jk,nik->n", turning, moments.second, turning)
    ) / 2
    corners = _corners(body)
    points = origin[:, None] + corners @ turning.transpose(0, 2, 1)
    return float(np.linalg.norm(points, axis=2).max(initial=0.0)), np.maximum(energy, 0.0)


def _corners(body: RigidBody) -> Float[np.ndarray, "n 3"]:
    """Corners of the hull of a body, in its frame, to `DEVIATION` [m]; its origin where no part has a shape."""
    placed = [
        position.points(corners)
        for own in body.occurrences
        if own.part.shape is not None
        for corners in [_hull(np.concatenate(own.part.shape.pieces(DEVIATION)))]
        for position in own.positions
    ]
    return _hull(np.concatenate(placed)) if placed else np.zeros((1, 3))


def _hull(points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "m 3"]:
    return np.asarray(points[ConvexHull(points).vertices])
