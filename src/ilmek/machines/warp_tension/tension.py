"""The warps' tension on the three cylinders [`ilmek.weaving.tension`], and what the motor's steps change of it.

With w the carpet woven between two take-ups and c the crimp, the upper cylinder of radius R releases w c beyond what
the lower one winds: the correction, w c / R of its angle. A full step of the stepper turns the cylinder by 1.8 degrees
over the ratio: the smallest change that the motor can set.
"""

from dataclasses import dataclass

from ilmek.arrays import FloatArray
from ilmek.elements.motors import FULL_STEPS
from ilmek.elements.yarns import COTTON, warp_density, warp_stiffness
from ilmek.machines.warp_tension.design import WarpTensionDesign
from ilmek.units import turn
from ilmek.weaving.shed import shed_lengthening
from ilmek.weaving.tension import TakeUpTension, take_up_tension, tension_history


@dataclass(frozen=True, slots=True)
class WarpTension:
    """Tensions of a warp on the cylinders.

    over        the rows between two take-ups           stiffness   EA of a warp [N]
    breaking    force of a warp [N]                     correction  of the upper cylinder's angle at a take-up [rad]
    step        change of tension for a full step of the motor [N]
    """

    over: TakeUpTension
    stiffness: float
    breaking: float
    correction: float
    step: float


def tension_of(design: WarpTensionDesign) -> WarpTension:
    """The warps' tensions over the rows between two take-ups."""
    params = design.params
    stiffness = params.warp_stiffness or warp_stiffness(params.pitch)
    rate, woven = stiffness / params.free_length, params.rows_between * params.row_pitch
    lengthening = float(shed_lengthening(params.shed_lift, params.shed_span, params.shed_span))
    return WarpTension(
        take_up_tension(params.tension, rate, woven, params.crimp, lengthening),
        stiffness,
        COTTON.breaking_force(warp_density(params.pitch)),
        woven * params.crimp / design.outer_radius,
        rate * design.outer_radius * turn / FULL_STEPS / design.reducer.ratio,
    )


def history(design: WarpTensionDesign, rows: int) -> tuple[FloatArray, FloatArray]:
    """Rows woven and the tension of an even warp [N] over some rows."""
    return tension_history(tension_of(design).over, design.params.rows_between, rows)
