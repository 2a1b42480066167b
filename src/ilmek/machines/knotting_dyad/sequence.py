"""The order in which the head ties a knot: both arms, the centre gripper, and who carries which end of the yarn.

A rigid arm cannot go round a warp, which is an endless line across its path. So each arm dips through the gap outside
its own warp, reaches behind the warp to the middle, and goes back on the same path. Between the warps a third gripper
goes to and fro, upright and straight: the centre gripper, as in the thesis' weaver.

    symmetric    each arm leads an end behind its warp, the centre gripper draws it out to the front
    asymmetric   on the open side the roles change: the centre gripper leads the end behind, and the arm, which
                 has come in empty, draws it out

The arms come one after the other, for at the middle they would meet. While they change they move together.
                                                                                        [thesis 2.1.2, 2.2.3, Fig 2.11]
"""

from dataclasses import dataclass

from ilmek.weaving.knots.word import Knot

LEFT, RIGHT, CENTRE = "left", "right", "centre"
OUT, IN = 0.0, 1.0


@dataclass(frozen=True, slots=True)
class Phase:
    """A part of the cycle; the parts follow one another.

    left, right  the arms' path parameter s at its begin and end, equal where the arm stands still
    centre       height of the centre gripper's tip above the warps' axes at its begin and end [m]
    carries      who holds the first and the second end of the yarn meanwhile; "" where it lies in the pile
    Where both arms move, s_left + s_right <= 1 must hold at every moment.
    """

    name: str
    left: tuple[float, float]
    right: tuple[float, float]
    centre: tuple[float, float]
    carries: tuple[str, str]


def sequence(knot: Knot, front: float, behind: float) -> tuple[Phase, ...]:
    """The phases of a cycle.

    front, behind  heights of the centre gripper's tip at rest and at the hand-over [m], behind < 0 < front
    The arm of an open side comes in empty; the arm that comes first is the left one, or that of the open side.

    >>> from ilmek.weaving.knots.word import knot
    >>> [phase.name for phase in sequence(knot("symmetric"), 0.01, -0.004)][:2]
    ['left arm in', 'centre gripper to the left arm']
    """
    one, other = (RIGHT, LEFT) if knot.opens == "right" else (LEFT, RIGHT)
    drawn = bool(knot.opens)
    begins = CENTRE if drawn else one  # who brings the first end, and who takes it
    takes = one if drawn else CENTRE
    rest, go, down, up = (front, front), (OUT, IN), (front, behind), (behind, front)
    return (
        _phase(f"{one} arm in", one, go, (OUT, OUT), rest, (begins, other)),
        _phase(f"centre gripper to the {one} arm", one, (IN, IN), (OUT, OUT), down, (begins, other)),
        _phase("centre gripper out", one, (IN, IN), (OUT, OUT), up, (takes, other)),
        _phase(f"{one} arm out, {other} arm in", one, (IN, OUT), go, rest, (one if drawn else "", other)),
        _phase(f"centre gripper to the {other} arm", one, (OUT, OUT), (IN, IN), down, ("", other)),
        _phase("centre gripper out with its end", one, (OUT, OUT), (IN, IN), up, ("", CENTRE)),
        _phase(f"{other} arm out", one, (OUT, OUT), (IN, OUT), rest, ("", "")),
    )


def _phase(  # noqa: PLR0917
    name: str,
    one: str,
    first: tuple[float, float],
    second: tuple[float, float],
    centre: tuple[float, float],
    carries: tuple[str, str],
) -> Phase:
    """A phase of the arm that comes first and of the one that comes second."""
    left, right = (first, second) if one == LEFT else (second, first)
    return Phase(name, left, right, centre, carries)
