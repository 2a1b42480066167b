"""The beat of a loom: one face for every machine that can beat its rows.

The component of such a machine has `beat`, a function of the loom's task. It plans the beat before the row is timed,
and designs its drive after:

    plan = MACHINES[BEATS[kind]].beat(task, kind)           `plan.beat`: stroke and time, from which the row is timed
    drive = plan.drive(task)                                with `task.period`, and the shedding among `task.designs`

The drive states force, torque, parts and work of all its mechanisms together, the rows that it leaves, and its outline
and path for the arrangement of the loom. Values that the user set for the machine are in both. In the loom it is
`Child(MACHINES[drive.name], drive.design, drive.number)`.
"""

from typing import Any, Protocol, runtime_checkable

import numpy as np

from ilmek.arrays import Complex, ComplexArray, FloatArray, RealField
from ilmek.machines.loom_task import LoomTask
from ilmek.records import computed, record, result, value_record
from ilmek.report import BillLine, Check, Work, at_least
from ilmek.timing.track import MotionLaw
from ilmek.weaving.fell import Fabric

GUIDED = "guide-cams"
"""The beat by the shedding cams themselves, which sink with their bearings."""

FORCE_TOLERANCE = 0.05
"""Share by which the force of a warp may be short: rows are then left less than 2 % too far apart."""


@value_record
class Beat:
    """A beat in time: forward, pressed, back.

    stroke   of the beater, along its path [m]          time      from rest to rest [s]
    forward  share of the time until the fell           pressed   share of it in which the beater presses
    law, back_law   of both motions                     actuator  its name on the cyclogram
    strokes  across the width; between the first and the last of several the beater counts as at the fell
    slide    run of the slide that carries it across [m]; 0: none
    park, park_time   run of the slide beyond its first and its last stroke, where it stands between beats, and its time
    """

    stroke: float
    time: float
    forward: float
    pressed: float
    law: MotionLaw
    back_law: MotionLaw
    actuator: str
    strokes: int = 1
    slide: float = 0.0
    park: float = 0.0
    park_time: float = 0.0

    @property
    def whole(self) -> float:
        """Time of the beat with the slide's runs beyond its strokes [s]."""
        return self.time + 2 * self.park_time


@record
class BeatPath:
    """The beater in the side view over a beat: x to the front, y up, the tip at the fell is 0.

    outline  convex polygons of the beater or comb, its tip at the fell [m]
    share    of the beat's time, ascending from 0 to 1 [-]      tip  displacement of the tip from the fell at them [m]
    pivot    about which it turns, level with the fell [m]; None: it does not turn
    """

    outline: tuple[ComplexArray, ...]
    share: FloatArray
    tip: ComplexArray
    pivot: float | None = None

    def __call__(self, share: RealField) -> ComplexArray:
        """Displacement of the tip from the fell [m] at shares of the time of a beat [-]."""
        return np.asarray(
            np.interp(share, self.share, self.tip.real) + 1j * np.interp(share, self.share, self.tip.imag)
        )

    def carried(self, points: ComplexArray, tip: ComplexArray) -> Complex[np.ndarray, "samples points"]:
        """Points of the outline [m] where the tip is at displacements from the fell [m], (samples,).

        z -> d + z (1 - d / p) / |1 - d / p|            d displacement, p pivot
        """
        if self.pivot is None:
            return np.asarray(tip[:, None] + points)
        turned = 1 - tip / self.pivot
        return np.asarray(tip[:, None] + points * (turned / np.abs(turned))[:, None])

    @property
    def rise(self) -> float:
        """Greatest height of the tip above the fell [m]."""
        return float(self.tip.imag.max())

    @property
    def at_rest(self) -> tuple[ComplexArray, ...]:
        """The outline where the beat begins [m]."""
        return tuple(self.carried(polygon, self.tip[:1])[0] for polygon in self.outline)


@record
class BeatDrive:
    """What beats the rows of a loom, designed.

    name, design  of its machine                      beat         in time
    fabric        at the fell, for one warp           torque       greatest, on the crank shaft of all [N m]; else 0
    parts, work   of all its mechanisms together      path         in the side view
    machine_checks   of its machine: they are in its report      loom_checks  what it asks of the loom's other machines
    striking      ids of what strikes, teeth first      use  of its machine in this loom, where the design has none
    """

    name: str
    design: Any
    task: LoomTask
    beat: Beat
    fabric: Fabric
    parts: tuple[BillLine, ...]
    work: tuple[Work, ...]
    torque: float
    path: BeatPath
    machine_checks: tuple[Check, ...]
    crank_rockers: int = result(
        "1", "crank-rockers that drive the beater, all alike, on one crank shaft; 0: none", name="beaters"
    )
    force: float = result("N", "force of the beat on all warps that are beaten at once", name="beat_force")
    beaten: int = result("1", "warps that are beaten at once", name="beaten_warps", least=0.0)
    frame_force: float = result("N", "greatest force of the beat on the frame", name="beat_frame_force")
    loom_checks: tuple[Check, ...] = ()
    striking: tuple[str, ...] = ()
    use: Any = None

    beat_strokes = computed("1", "strokes of a beat across the width", lambda it: it.beat.strokes)
    beat_time = computed("s", "time of a beat from rest to rest, all its strokes", lambda it: it.beat.time)
    beat_force_width = computed(
        "N/m", "the same over the width of these warps", lambda it: it.force / (it.beaten * it.task.cloth.warp_pitch)
    )
    beat_force_warp = computed("N", "the same for a warp", lambda it: it.force / it.beaten)
    beat_force_knot = computed("N", "the same for a knot", lambda it: 2 * it.force / it.beaten)
    beat_torque_max = computed("Nm", "greatest torque on the crank shaft of all crank-rockers", lambda it: it.torque)

    @computed("N", "force for a warp that the required row pitch needs, with the fabric as assumed")
    def beat_force_needed(self) -> float:
        return float(self.fabric.resistance(self.task.cloth.row_distance))

    @computed("mm", "distance of the rows that the beat leaves, with the fabric as assumed")
    def row_pitch_left(self) -> float:
        return float(self.fabric.spacing(self.beat_force_warp))

    @computed("N", "tension that the beat adds to a warp", name="beat_warp_tension")
    def warp_force_extra(self) -> float:
        return self.fabric.warp_rate * float(self.fabric.fell(min(self.beat_force_warp, self.beat_force_needed)))

    @property
    def number(self) -> int:
        """Mechanisms, all alike: the crank-rockers, or one comb."""
        return self.crank_rockers or 1

    @property
    def outline(self) -> tuple[ComplexArray, ...]:
        """Convex polygons of what strikes, in the side view, its striking edge at 0 when it is at the fell [m]."""
        return self.path.outline

    @property
    def checks(self) -> tuple[Check, ...]:
        """What the loom asks of the beat beside the checks of its machine."""
        needed = self.beat_force_needed * (1 - FORCE_TOLERANCE)
        source = (
            "force that the rows need, 5 % less allowed; fabric assumed by this project: hammer.packing, laid_pitch"
        )
        cure = "set beat=auto, a lower tension, or a coarser quality along"
        stroke = "height above the fell: room for the weft"
        return (
            at_least("beat: force of a warp", self.beat_force_warp, needed, "N", source).with_cure(
                cure, *self.striking
            ),
            at_least("beat: stroke", self.path.rise, stroke_needed(self.task), "mm", stroke).with_cure(
                "set a larger stroke", *self.striking
            ),
            *self.loom_checks,
        )


def stroke_needed(task: LoomTask) -> float:
    """Stroke of the beater [m]: it comes from above the weft, which a carrier or, without a side view, hands lay."""
    return task.side.beat_stroke if task.side is not None else task.params.hands.weft_laid


@runtime_checkable
class PlannedBeat(Protocol):
    """A beat before the row is timed."""

    @property
    def beat(self) -> Beat:
        """The beat in time."""
        ...

    @property
    def path(self) -> BeatPath:
        """What beats, in the side view."""
        ...

    def drive(self, task: LoomTask) -> BeatDrive:
        """Its drive for the loom's task with the period of the row. Raises the errors of the machine's design."""
        ...
