"""What energy weaving takes: the work of each act at its drive, no work coming back, and what stands by.

    energy = sum of (work of an act) * (how often) / efficiency + standby power * time
    work of a turn of a cam shaft or crank   integral of max(M, 0) dq         of a move from rest to rest   m v^2 / 2

The drives' efficiency and the standby power are parameters, ours: 70 % from the mains to the shaft, and 10 W for each
axis' electronics. Friction in the mechanisms is within the efficiency.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.materials import GRAVITY
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.production_time import estimated_time
from ilmek.machines.weaver.cams import torque_at
from ilmek.machines.weaver.moves import carriage, selector
from ilmek.timing.s_curve import s_curve
from ilmek.timing.track import peak_speed
from ilmek.units import turn

_GRID = 1440


@dataclass(frozen=True, slots=True)
class Energy:
    """Energy of the whole carpet [J] by what takes it, the time it takes [s] and its area [m^2]."""

    shares: dict[str, float]
    time: float
    area: float

    @property
    def total(self) -> float:
        """Energy of the carpet [J]."""
        return sum(self.shares.values())

    @property
    def power(self) -> float:
        """Mean power over the weaving time [W]."""
        return self.total / self.time

    @property
    def per_area(self) -> float:
        """Energy for each square metre of carpet [J/m^2]."""
        return self.total / self.area


def energy_of(loom: LoomDesign) -> Energy:
    """The energy of weaving the loom's carpet, at the estimated weaving time."""
    params, knots = loom.params, loom.rows * loom.columns
    works = {
        "knotting": knots * knot_work(loom),
        "carriages": knots * carriage_work(loom),
        "colours": knots * params.changes_per_knot * selector_work(loom),
        "shedding": loom.rows * shed_work(loom),
        "shuttle": 2 * loom.rows * shuttle_work(loom),
        "beating": 2 * loom.rows * beat_work(loom),
        "take-up": take_up_work(loom),
    }
    time = estimated_time(loom)
    shares = {name: work / params.drive_efficiency for name, work in works.items()}
    shares["standing by"] = params.standby_power * axes(loom) * time
    return Energy(shares, time, params.width * params.length)


def axes(loom: LoomDesign) -> int:
    """Driven axes: cam shaft, colours and carriage of each head; shedding, shuttle, three cylinders; what beats."""
    beating = 1 if loom.hammer is None else loom.hammer.params.shared
    return 3 * loom.heads + 5 + beating


def knot_work(loom: LoomDesign) -> float:
    """Work of a head's cam shaft for a knot [J]."""
    return positive_work(lambda angle: torque_at(loom.weaver.cams, angle))


def carriage_work(loom: LoomDesign) -> float:
    """Work of a head's carriage for a step to the next knot [J]: what its mass has at the step's greatest speed."""
    head = loom.weaver.params
    move = s_curve(head.knot_pitch, carriage(head))
    return 0.5 * loom.head_mass * move.speed**2


def selector_work(loom: LoomDesign) -> float:
    """Work of a colour change [J]: the tubes at the greatest speed of a move over a third of them, the mean of all."""
    head = loom.weaver.params
    move = s_curve(head.tubes * head.tube_pitch / 3, selector(head))
    return 0.5 * head.tubes * head.tube_mass * move.speed**2


def shed_work(loom: LoomDesign) -> float:
    """Work of the shedding cams for a row [J]: a turn."""
    return positive_work(loom.shedding.shed.torque)


def shuttle_work(loom: LoomDesign) -> float:
    """Work of a passage of the shuttle [J]."""
    row = loom.row_cyclogram
    return 0.5 * loom.params.shuttle_mass * peak_speed(row.track("shuttle"), row.period) ** 2


def beat_work(loom: LoomDesign) -> float:
    """Work for a beat [J]: of all crank-rockers over a turn; or of the comb on its rows, and to lift all that moves."""
    if loom.hammer is not None:
        comb = loom.hammer.params
        lifted = (1 - comb.counterbalance) * loom.hammer.mass * GRAVITY * comb.stroke
        return loom.warps * loom.hammer.energy + lifted
    if loom.beat_up is None:
        return 0.0
    state = loom.beat_up.state
    step = turn / (state.angle.size - 1)
    return loom.beaters * float(np.sum(np.maximum(state.torque[:-1], 0.0)) * step)


def take_up_work(loom: LoomDesign) -> float:
    """Work of drawing the carpet's length through against the warps' pull, behind the reducer [J]."""
    cylinder = loom.warp_tension
    pull = cylinder.params.warps * cylinder.params.tension
    return pull * loom.params.length / cylinder.reducer.efficiency


def positive_work(torque: Callable[[FloatArray], FloatArray]) -> float:
    """Work of a torque [N m] over the angles at which it drives, of one turn [J]; midpoints of a quarter degree."""
    angle = (np.arange(_GRID) + 0.5) * turn / _GRID
    return float(np.sum(np.maximum(torque(angle), 0.0)) * turn / _GRID)
