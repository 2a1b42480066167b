"""The compensator's lever as a mechanism of the linkage engine, with its springs and warps as loads."""

from collections.abc import Iterable, Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics import Forces, Inertia, Spring
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.loads import Wrench
from ilmek.linkage import Body, Mechanism, Motion, Pin, Plan, Rotation, plan
from ilmek.linkage.model import GROUND
from ilmek.linkage.solve import solve
from ilmek.machines.tension_compensator.geometry import Lever, WarpPath
from ilmek.machines.tension_compensator.synthesis import SprungLever
from ilmek.records import record

LEVER, PIVOT, BAR, SPRINGS = "lever", "pivot", "bar", "springs"


@record
class WarpSheet:
    """The warps of a bar as a load on its lever: a number of them, their path, and their tensions [N], by sample."""

    warps: float
    path: WarpPath
    bar: complex
    tension: FloatArray

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """The force on the bar."""
        pull = self.path.pull(motion.carried(LEVER, self.bar).position)
        yield Wrench(LEVER, self.warps * self.tension * pull, self.bar)


def lever_plan(lever: Lever) -> Plan:
    """The lever on its pivot, with its input, the angle of the springs' arm."""
    mechanism = Mechanism(
        bodies=(
            Body(GROUND, {PIVOT: lever.pivot, SPRINGS: complex(lever.anchor)}),
            Body(LEVER, {PIVOT: 0j, BAR: lever.bar_point, SPRINGS: complex(lever.reach)}),
        ),
        joints=(Pin(PIVOT, GROUND, LEVER),),
        inputs=(Rotation(LEVER, PIVOT),),
        name="tension compensator",
    )
    return plan(mechanism)


def lever_forces(one: SprungLever, phi: FloatArray, speed: FloatArray, tension: FloatArray) -> Forces:
    """Forces of the lever at rotations [rad] with their rates [rad/s], under the tensions of its warps [N], by sample.

    In equilibrium the effort of its input is 0: no drive but warps and springs holds it.
    """
    motion = solve(lever_plan(one.lever), -phi, -speed)
    spring = Spring((GROUND, SPRINGS), (LEVER, SPRINGS), one.springs * one.rate, one.free_length)
    sheet = WarpSheet(one.task.warps, one.lever.path, one.lever.bar_point, tension)
    return inverse(motion, {}, (spring, sheet))


def spring_forces(one: SprungLever, phi: FloatArray) -> FloatArray:
    """Force of each of the springs at rotations of the lever [N]."""
    return np.asarray(one.rate * (one.free_length - one.lever.spring_length(phi)))
