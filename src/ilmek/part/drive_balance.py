"""Whether motors and hands move all that is free: the degrees of freedom of a tree, and the axes that are driven.

    J dq = 0      what joints and closures require [`part.mobility`]
    dq_i = 0      at each axis that a motor or a hand holds, and at each body that nothing has to drive

The degrees of freedom are the coordinates less the rank of the first rows and of those of the bodies that nothing has
to drive. Motors drive all of them where all rows together have the rank of the number of coordinates; none is in excess
where each axis adds one to the rank.                                    [Angeles, Spatial Kinematic Chains, 4]
"""

from collections.abc import Iterator, Sequence

import numpy as np

from ilmek.part.mobility import TreeMobility, independent_rows, left_free
from ilmek.part.tree import RigidBody, Tree
from ilmek.records import record


@record
class DriveBalance:
    """The degrees of freedom of a tree beside its motors.

    number    degrees of freedom, without those of the bodies that nothing has to drive
    axes      that the motors drive: their number, over that of those which drive one together
    driven    degrees of freedom that motors and hands take
    by_hand   ids of the bodies that the weaver's hands move, once for each place
    undriven  ids of the bodies that move though nothing holds them, each before what follows it
    excess    ids of the motors that drive what another one drives, or nothing
    passive   ids of the bodies that nothing has to drive, once for each place
    """

    number: int
    axes: int
    driven: int
    by_hand: tuple[str, ...]
    undriven: tuple[str, ...]
    excess: tuple[str, ...]
    passive: tuple[str, ...]


def drive_balance(tree: Tree) -> DriveBalance:
    """The degrees of freedom of a tree, the bodies that have no motor, and the motors in excess."""
    mobility = TreeMobility(tree)
    bodies = [chain[-1].body for chain, _ in mobility.coordinates]
    resting = [number for number, body in enumerate(bodies) if body.joint.passive]
    motors = {
        part.id: number // part.purchase.drives
        for part, number in tree.occurrences()
        if part.purchase is not None and part.purchase.drives
    }
    left = dict(motors)
    by_hand = tuple(number for number, body in enumerate(bodies) if body.joint.hand)
    axes = (*_driven(bodies, left), *by_hand)
    unit, known = np.eye(len(bodies)), mobility.jacobian
    rows = np.concatenate([known, unit[resting], unit[list(axes)]])
    before = len(known) + len(resting)
    needed = set(independent_rows(rows))
    driven = sum(row >= before for row in needed)
    twice = (
        bodies[axis].joint.motor or bodies[axis].joint.hand
        for row, axis in enumerate(axes, before)
        if row not in needed
    )
    return DriveBalance(
        number=len(bodies) - len(needed) + driven,
        axes=sum(motors.values()),
        driven=driven,
        by_hand=tuple(bodies[number].id for number in by_hand),
        undriven=tuple(dict.fromkeys(bodies[column].id for column in left_free(rows))),
        excess=tuple(dict.fromkeys((*twice, *(motor for motor, number in left.items() if number)))),
        passive=tuple(bodies[number].id for number in resting),
    )


def _driven(bodies: Sequence[RigidBody], left: dict[str, int]) -> Iterator[int]:
    """Numbers of the coordinates that motors drive: of a body with more places than motors those of the first places.

    left  number of axes by the id of their motor; then of those that are left
    """
    for number, body in enumerate(bodies):
        if left.get(body.joint.motor, 0) > 0:
            left[body.joint.motor] -= 1
            yield number
