"""What is seen of a machine's parts as strokes of a figure, at rest and in motion."""

from collections.abc import Iterable

from ilmek.part.projection import MovingOutline, PieceOutline
from ilmek.part.tree import Tree
from ilmek.report import MovingStroke, Stroke


def drawn(seen: Iterable[PieceOutline], *, filled: bool = True) -> tuple[Stroke, ...]:
    """Outlines at rest, dashed where they are a room."""
    return tuple(
        Stroke(curve, "construction" if outline.part.envelope else "outline", closed=True, filled=filled)
        for outline in seen
        for curve in outline.curves
    )


def named_strokes(outlines: Iterable[MovingOutline]) -> tuple[MovingStroke, ...]:
    """Outlines in motion, each with the name and so the colour of its body."""
    return tuple(
        MovingStroke(outline.points, "path", outline.body.rpartition("/")[2], closed=True) for outline in outlines
    )


def moving_bodies(tree: Tree, drive: str, *, but: str = "") -> tuple[str, ...]:
    """Bodies that a drive moves or a moving one carries, in the order of the tree; none on the body `but`."""
    moving: list[str] = []
    for body in tree.bodies:
        motion = body.joint.motion
        if body.parent != but and (body.parent in moving or (motion is not None and motion.drive == drive)):
            moving.append(body.id)
    return tuple(moving)
