"""Faces of parts that stand to each other and lie on each other, and that screws may hold."""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from ilmek.arrays import Float
from ilmek.part.part import HolePattern, Part
from ilmek.part.placement import Placement
from ilmek.part.poses import Chain, chains, poses
from ilmek.part.seat_faces import Depth, SeatFace, depth_below, seat_faces
from ilmek.part.shapes import Turned, box_corners, shape_box
from ilmek.part.tree import STANDING, RigidBody, Tree
from ilmek.part.welds import welded_together
from ilmek.units import mm, um

BOLTED = frozenset(
    {
        "stepper", "servo", "reducer", "linear guide", "guide carriage", "linear axis", "sensor", "load cell",
        "light barrier", "yarn sensor", "yarn brake", "interlock", "actuator", "emergency stop", "button",
        "tool", "duct", "input module", "motor adapter",
    }
)  # fmt: skip
"""Kinds of bought parts that are held by screws."""

_NEVER = frozenset({"cam plate", "guard mesh", "fastener", "magnet"})
"""Processes of made parts that are held otherwise."""

_MOST = 200
"""Pieces of a part in a body from which they are a stack."""

_LEAST = 6 * mm
"""Width of a contact from which the smallest screws have room [m]."""

_FLUSH = 20 * um
"""Distance within which faces lie on each other [m]."""


@dataclass(frozen=True, eq=False)
class StandingPiece:
    """A piece that stands in a rigid group: part, its body, where it is in the group and in its body."""

    part: Part
    body: RigidBody
    lies: Placement
    own: Placement
    box: Float[np.ndarray, "2 3"]


@dataclass(frozen=True, eq=False)
class FaceSide:
    """A face of a piece in a contact."""

    piece: StandingPiece
    face: SeatFace

    @property
    def part(self) -> Part:
        """The part."""
        return self.piece.part

    @cached_property
    def frame(self) -> Placement:
        """Of the face in the group."""
        return self.piece.lies.after(self.face.position)

    def depth(self, point: complex, radius: float) -> Depth:
        """Of a hole of a radius at a point of the face."""
        assert self.part.shape is not None
        return depth_below(self.part.shape, self.face, point, radius)


def standing_groups(tree: Tree) -> Iterator[tuple[StandingPiece, ...]]:
    """The pieces that stand to each other, of like bodies those of the first."""
    groups: dict[tuple[str, ...], list[StandingPiece]] = defaultdict(list)
    for chain in chains(tree):
        moving = [k for k, link in enumerate(chain) if link.body.joint.kind not in STANDING]
        carrier = chain[: moving[-1] + 1] if moving else ()
        if any(link.index for link in carrier):
            continue
        groups[tuple(link.name for link in carrier)] += _pieces(chain, len(carrier))
    return (tuple(group) for group in groups.values())


def _pieces(chain: Chain, first: int) -> Iterator[StandingPiece]:
    """The pieces of the last body of a chain, in the frame of its link before `first`."""
    here = poses(chain[first:], "", np.zeros(1))
    lies = Placement(here.origin[0], here.rotation[0])
    for occurrence in chain[-1].body.occurrences:
        part = occurrence.part
        if part.shape is None or occurrence.turning or len(occurrence.positions) > _MOST:
            continue
        corners = _corners(part)
        for position in occurrence.positions:
            stands = lies.after(position)
            points = stands.points(corners)
            yield StandingPiece(part, chain[-1].body, stands, position, np.stack([points.min(0), points.max(0)]))


@lru_cache(maxsize=4096)
def _corners(part: Part) -> Float[np.ndarray, "8 3"]:
    assert part.shape is not None
    return box_corners(*shape_box(part.shape))


def _can(part: Part) -> bool:
    """Whether screws hold a part."""
    if part.fixing:
        return False
    if part.purchase is not None:
        return part.process in BOLTED
    return part.process not in _NEVER and part.drawing is None


def face_contacts(group: Sequence[StandingPiece]) -> list[tuple[FaceSide, FaceSide]]:
    """Faces that lie on each other of parts that are screwed: those of catalogues first."""
    sides = [FaceSide(piece, face) for piece in group if _can(piece.part) for face in seat_faces(piece.part.shape)]
    if not sides:
        return []
    frames = [side.frame for side in sides]
    normals = np.array([frame.rotation[:, 2] for frame in frames])
    levels = (normals * np.array([frame.origin for frame in frames])).sum(1)
    boxes = np.array([_face_box(side.face, frame) for side, frame in zip(sides, frames, strict=True)])
    turned, level = np.round(normals * 1e3).astype(int), np.round(levels / _FLUSH).astype(int)
    numbers: dict[tuple[int, ...], list[int]] = defaultdict(list)
    for number, key in enumerate(np.column_stack([turned, level]).tolist()):
        numbers[tuple(key)].append(number)
    pairs: dict[tuple[int, int], list[tuple[tuple[bool, float], FaceSide, FaceSide]]] = defaultdict(list)
    for first, (*key, height) in enumerate(np.column_stack([-turned, -level]).tolist()):
        for other in (k for step in (-1, 0, 1) for k in numbers.get((*key, height + step), ())):
            one, two = sides[first], sides[other]
            if first < other and abs(levels[first] + levels[other]) < _FLUSH and _may(one.piece, two.piece):
                shared = np.minimum(boxes[first, 1], boxes[other, 1]) - np.maximum(boxes[first, 0], boxes[other, 0])
                _, width, long = np.sort(shared).tolist()
                if (shared > -_FLUSH).all() and width > 2 * mm:
                    size = width > _LEAST, width * long
                    pairs[id(one.piece), id(two.piece)].append((size, one, two))
    face_contacts = [
        (one, two)
        for own in pairs.values()
        for _, one, two in sorted(own, key=lambda contact: contact[0], reverse=True)[:2]
    ]
    return sorted(face_contacts, key=lambda both: not any(patterns_of(side.part) for side in both))


def _face_box(face: SeatFace, frame: Placement) -> Float[np.ndarray, "2 3"]:
    low, high = face.low, face.high
    corners = frame.points(np.array([[x, y, 0.0] for x in (low.real, high.real) for y in (low.imag, high.imag)]))
    return np.stack([corners.min(0), corners.max(0)])


def _may(one: StandingPiece, two: StandingPiece) -> bool:
    """Whether two pieces may be screwed to each other."""
    parts = one.part, two.part
    turned = [isinstance(part.shape, Turned) for part in parts]
    bought = [part.purchase is not None for part in parts]
    return (
        parts[0] is not parts[1]
        and not all(turned)
        and not (any(turned) and any(bought))
        and not welded_together(*parts)
    )


def pattern_of(side: FaceSide) -> HolePattern | None:
    """The holes that a catalogue states of a face; None: it states none."""
    return next((row for row in patterns_of(side.part) if side.face.up in row.faces), None)


def patterns_of(part: Part) -> tuple[HolePattern, ...]:
    """The holes of a bought part that its catalogue states."""
    return part.purchase.holes if part.purchase is not None else ()


def is_given(side: FaceSide) -> bool:
    """Whether screws stand only in the holes that a catalogue states: none in a face without."""
    bought = side.part.purchase
    return bought is not None and bool(bought.holes) and (pattern_of(side) is not None or not bought.drilled)
