"""What holds hubs along their shafts: measured on meshes, with nothing of the tree but its parts and its poses.

A hub is a part whose bore has a keyway or is square, on a shaft that fits it, in a body that moves. A set screw, a
clamp or an adhesive holds it; else it is held on each side where its own face meets what does not slide: a shoulder of
the shaft, a bearing, a ring, a nut, a reducer; or a hub that is held.
"""

from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ilmek.part.features import FeatureOfSize, features_of_size
from ilmek.part.part import CLAMP, SET_SCREW, Part
from ilmek.part.placement import Placement
from ilmek.part.poses import chains, poses
from ilmek.part.tree import JointKind, Tree
from ilmek.sentences import Sentence
from ilmek.units import mm

TOUCH, NEAR = 0.35 * mm, 0.02 * mm
"""Gap along the axis within which faces count as meeting, and distance of axes and radii that counts as none [m]."""

STANDS = {JointKind.FIXED, JointKind.MISSING}
"""Joints of what does not move."""

HELD = {"bearing", "fastener", "reducer", "clutch and brake"}
"""Kinds of what does not slide on a shaft."""


class Ring(NamedTuple):
    """A part about an axis: ends along it, least and greatest radius [m]; bore: radius of a keyed or square bore."""

    part: Part
    low: float
    high: float
    inner: float
    outer: float
    bore: float


class Standing(NamedTuple):
    """A part of a body where it stands, and the points of its mesh there [m]."""

    body: str
    part: Part
    stands: Placement
    points: NDArray[np.float64]


def loose_hubs(tree: Tree) -> set[str]:
    """Ids of the hubs that nothing holds on one side or the other."""
    standing = list(_standing(tree))
    loose: set[str] = set()
    seen: set[tuple[str, tuple[float, ...]]] = set()
    with_hubs = {
        one.body for one in standing if any(own.inside and (own.keyway or own.square) for own in _features(one.part))
    }
    for shaft in standing:
        for feature in _features(shaft.part) if shaft.body and shaft.body in with_hubs else ():
            if feature.inside or not (feature.keyway or feature.square):
                continue
            frame = shaft.stands.after(feature.position)
            line = tuple(np.round(np.concatenate([frame.origin[:2], frame.rotation[:, 2]]), 4))
            if (shaft.part.id, line) not in seen:
                seen.add((shaft.part.id, line))
                loose |= _loose(shaft, frame, feature.size, standing)
    return loose


def _standing(tree: Tree) -> Iterator[Standing]:
    """Each part at each of its positions."""
    meshes: dict[str, NDArray[np.float64]] = {}
    for chain in chains(tree):
        here, moves = poses(chain, "", np.zeros(1)), any(link.body.joint.kind not in STANDS for link in chain)
        body = Placement(here.origin[0], here.rotation[0])
        for own in chain[-1].body.occurrences:
            if own.part.shape is not None:
                points = meshes.setdefault(own.part.id, own.part.shape.mesh(0.2 * mm).points)
                for position in own.positions:
                    stands = body.after(position)
                    yield Standing(chain[-1].name if moves else "", own.part, stands, stands.points(points))


def _loose(shaft: Standing, frame: Placement, size: float, standing: list[Standing]) -> set[str]:
    to_axis = frame.inverse
    near = [one for one in standing if one is not shaft and _about(one, to_axis)]
    rings = [_ring(one, to_axis) for one in near]
    steps = _steps(shaft, to_axis)
    held = [_stopped(rings, steps, side) for side in (1, -1)]
    hubs = (
        number
        for number, ring in enumerate(rings)
        if near[number].body == shaft.body and ring.bore and abs(2 * ring.bore - size) < NEAR
    )
    return {rings[number].part.id for number in hubs if not (held[0][number] and held[1][number])}


@lru_cache(maxsize=4096)
def _features(part: Part) -> tuple[FeatureOfSize, ...]:
    return features_of_size(part.shape) if part.shape else ()


def _about(one: Standing, to_axis: Placement) -> bool:
    """Whether a feature of a part lies about the axis."""
    for feature in _features(one.part):
        lies = to_axis.after(one.stands).after(feature.position)
        if np.hypot(*lies.origin[:2]) < NEAR and abs(abs(lies.rotation[2, 2]) - 1) < 1e-6:
            return True
    return False


def _ring(one: Standing, to_axis: Placement) -> Ring:
    points = to_axis.points(one.points)
    radii = np.hypot(points[:, 0], points[:, 1])
    bores = [own for own in _features(one.part) if own.inside]
    keyed = [own.size / 2 for own in bores if own.keyway is not None or own.square]
    least = min((own.size / 2 for own in bores), default=float(radii.min()))
    low, high = float(points[:, 2].min()), float(points[:, 2].max())
    return Ring(one.part, low, high, least, float(radii.max()), keyed[0] if keyed else 0.0)


def _steps(shaft: Standing, to_axis: Placement) -> list[tuple[float, float, float]]:
    """Begin, end and radius of the shaft's round and square lengths; of a square the radius at its corners."""
    steps = []
    for feature in _features(shaft.part):
        if not feature.inside:
            lies = to_axis.after(shaft.stands).after(feature.position)
            ends = sorted((lies.origin[2], lies.origin[2] + lies.rotation[2, 2] * feature.length))
            steps.append((float(ends[0]), float(ends[1]), feature.size / 2))
    return steps


def _stopped(rings: list[Ring], steps: list[tuple[float, float, float]], side: int) -> NDArray[np.bool_]:
    """Whether each ring cannot move to one side along the axis."""
    low, high, inner, outer = (np.array([ring[k] for ring in rings]) for k in range(1, 5))
    end, facing = (high, low) if side > 0 else (low, high)
    stopped = np.array([_is_held(ring) for ring in rings], dtype=bool)
    for begin, last, radius in steps:
        stopped |= (radius > inner + NEAR) & (np.abs((begin if side > 0 else last) - end) < TOUCH)
    for number in np.argsort(-side * end):
        meets = (np.abs(facing - end[number]) < TOUCH) & (inner < outer[number] - NEAR) & (outer > inner[number] + NEAR)
        meets[number] = False
        stopped[number] |= bool(stopped[meets].any())
    return stopped


def _is_held(ring: Ring) -> bool:
    part = ring.part
    fixed = {SET_SCREW, CLAMP} & set(part.seats) or Sentence("sheet.bonded") in part.notes
    return part.process in HELD or "nut" in part.title or bool(fixed)
