"""The belt axis that moves the carrier: belt and pulleys, motor and reducer.

    F(t) = m a(t) + (R + T)/eta           R friction on the guide, T tension of the weft, eta of belt and guide
    M = F r,   J = m r²                   r pitch radius of the pulleys, m all that the belt moves, the belt included

The belt runs round two equal pulleys at the ends of the stroke; half of the teeth of a pulley are in mesh. The duty of
the motor is that of passages without a rest between them.                          [`elements.belts`, `elements.duty`]
"""

import math

import numpy as np

from ilmek.elements.belts import BELTS, BeltDrive
from ilmek.elements.duty import LoadCycle, ServoDrive, size_motor
from ilmek.elements.motors import SERVO
from ilmek.elements.reducers import DIRECT, PLANETARY
from ilmek.machines.weft.params import WeftParams
from ilmek.machines.weft.passage import WeftPassage
from ilmek.records import computed, record, result
from ilmek.report import Json

STOCK = (("AT5", 24), ("AT10", 20))
"""Belts of the axis with the teeth of their pulleys; assumed by this project."""

SERVICE = 1.4
"""Service factor of the belt [usual practice]."""

REDUCERS = (DIRECT, *PLANETARY[:5])
"""Reducers of the axis: none, or one stage."""

SAMPLES = 181


@record
class BeltAxis:
    """The axis; belt: its drive, and width [m] or nan where none of the table is wide enough."""

    belt: BeltDrive
    width: float
    drive: ServoDrive | None
    mass: float = result("kg", "mass that the axis moves, belt included", name="moving_mass")
    thrust: float = result("N", "largest force of the belt", name="belt_force")
    torque: float = result("Nm", "largest torque on the pulley, belt and guide included", name="pulley_torque")
    turning: float = result("rpm", "largest speed of the pulley", name="pulley_speed")

    pulley_radius = computed("mm", "pitch radius of the pulleys", lambda it: it.belt.radii[0])

    @computed("", "belt of the axis [m]")
    def belt_size(self) -> Json:
        return {
            "profile": self.belt.belt.name,
            "width": self.width,
            "teeth": self.belt.teeth,
            "pulley": self.belt.small,
        }

    @computed("", "servo of the axis", absent="none of the table is enough")
    def servo(self) -> Json:
        return None if self.drive is None else self.drive.as_json()


def belt_axis(params: WeftParams, passage: WeftPassage, moved: float, resisting: float) -> BeltAxis:
    """The axis of a passage.

    moved  mass on the belt [kg]      resisting  force against the motion: friction and tension of the weft [N]
    """
    for name, teeth in STOCK:
        belt, width = _belt(name, teeth, passage, moved, resisting / params.belt_efficiency)
        if not math.isnan(width):
            break
    radius = belt.radii[0]
    widest = belt.belt.widths[-1] if math.isnan(width) else width
    mass = moved + belt.length * widest * belt.belt.mass
    time = np.linspace(0.0, passage.time, SAMPLES)
    _, speed, acceleration, _ = passage.at(time)
    load = resisting / params.belt_efficiency * np.sign(speed) * radius
    cycle = LoadCycle(speed / radius, acceleration / radius, load, mass * radius**2)
    thrust = mass * passage.acceleration + resisting / params.belt_efficiency
    drive = size_motor(cycle, REDUCERS, SERVO)
    return BeltAxis(belt, width, drive, mass, thrust, thrust * radius, passage.speed / radius)


def _belt(name: str, teeth: int, passage: WeftPassage, moved: float, resisting: float) -> tuple[BeltDrive, float]:
    """The belt of a profile round two pulleys, and the width [m] that its force needs; nan where there is none."""
    kind = BELTS[name]
    length = 2 * passage.stroke + 4 * kind.pitch * teeth
    belt = BeltDrive(kind, teeth, teeth, math.ceil(length / kind.pitch) + teeth)
    for width in kind.widths:
        mass = moved + belt.length * width * kind.mass
        needed = belt.width_for((mass * passage.acceleration + resisting) * belt.radii[0], SERVICE)
        if needed is not None and needed <= width:
            return belt, width
    return belt, math.nan
