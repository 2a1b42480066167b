"""The beat of a loom: one face for every machine that can beat its rows.

The component of such a machine has `beat`, a function of the loom's task. It plans the beat before the row is timed,
and designs its drive after:

    plan = MACHINES[BEATS[kind]].beat(task, kind)           `plan.beat`: stroke and time, from which the row is timed
    drive = plan.drive(task)                                with `task.period`, and the shedding among `task.designs`

The drive states force, torque, parts and work of all its mechanisms together, and the rows that it leaves. Values that
the user set for the machine are in both. In the loom it is `Child(MACHINES[drive.name], drive.design, drive.number)`.
"""

from dataclasses import dataclass
from typing import Any, Protocol

from ilmek.machines.loom_task import LoomTask
from ilmek.records import computed, record, result
from ilmek.report import Part, Work
from ilmek.weaving.fell import Fabric


@dataclass(frozen=True, slots=True)
class Beat:
    """A beat in time: forward, pressed, back.

    stroke   of the beater [m]                          time      from rest to rest [s]
    forward  share of the time until the fell          pressed   share of it in which the beater presses
    law      of both motions                            actuator  its name on the cyclogram
    """

    stroke: float
    time: float
    forward: float
    pressed: float
    law: str
    actuator: str


@record
class BeatDrive:
    """What beats the rows of a loom, designed.

    name, design  of its machine                      beat         in time
    fabric        at the fell, for one warp           torque       greatest, on the crank shaft of all [N m]; else 0
    parts, work   of all its mechanisms together
    """

    name: str
    design: Any
    task: LoomTask
    beat: Beat
    fabric: Fabric
    parts: tuple[Part, ...]
    work: tuple[Work, ...]
    torque: float
    crank_rockers: int = result(
        "1", "crank-rockers that drive the beater, all alike, on one crank shaft; 0: none", name="beaters"
    )
    force: float = result("N", "greatest force of the beat on the whole width", name="beat_force")

    beat_force_width = computed("N/m", "the same over the width", lambda it: it.force / it.task.params.width)
    beat_force_warp = computed("N", "the same for a warp", lambda it: it.force / it.task.warps)
    beat_force_knot = computed("N", "the same for a knot", lambda it: it.force / it.task.columns)
    beat_torque_max = computed("Nm", "greatest torque on the crank shaft of all crank-rockers", lambda it: it.torque)

    @computed("N", "force for a warp that the required row pitch needs, with the fabric as assumed")
    def beat_force_needed(self) -> float:
        return float(self.fabric.resistance(self.task.row_pitch))

    @computed("mm", "distance of the rows that the beat leaves, with the fabric as assumed")
    def row_pitch_left(self) -> float:
        return float(self.fabric.spacing(self.beat_force_warp))

    @property
    def number(self) -> int:
        """Mechanisms, all alike: the crank-rockers, or one comb."""
        return self.crank_rockers or 1


class PlannedBeat(Protocol):
    """A beat before the row is timed."""

    @property
    def beat(self) -> Beat:
        """The beat in time."""
        ...

    def drive(self, task: LoomTask) -> BeatDrive:
        """Its drive for the loom's task with the period of the row. Raises the errors of the machine's design."""
        ...
