"""The warps' tension on the three cylinders [`ilmek.weaving.tension`], and its change by a step of the motor.

With w the carpet woven between two take-ups and c the crimp, the upper cylinder of radius R releases w c beyond what
the lower one winds: the correction, w c / R of its angle. A full step of the stepper rotates the cylinder by 1.8
degrees over the ratio: the smallest change that the motor can set.
"""

from ilmek.arrays import FloatArray
from ilmek.elements.motors import FULL_STEPS
from ilmek.elements.yarns import COTTON, warp_density, warp_stiffness
from ilmek.machines.warp_tension.design import WarpTensionDesign
from ilmek.records import computed, record, result
from ilmek.units import turn
from ilmek.weaving.shed import shed_lengthening
from ilmek.weaving.tension import TakeUpTension, take_up_tension, tension_history


@record
class WarpTension:
    """Tensions of a warp on the cylinders; `over`: the rows between two take-ups."""

    over: TakeUpTension
    rows_between: int
    stiffness: float = result("kN", "force over strain of a warp", name="warp_stiffness")
    breaking: float = result("N", "breaking force of a cotton warp", name="tension_breaking")
    correction: float = result("deg", "release of the upper cylinder beyond the lower one", name="correction_angle")
    step: float = result("N", "change of tension for a full step of the motor", name="tension_step")

    tension_woven = computed("N", "tension before the take-up: crimp tightens the warps", lambda it: it.over.woven)
    tension_row = computed("N", "change of it over a row", lambda it: (it.over.woven - it.over.rest) / it.rows_between)
    tension_shed = computed("N", "tension with the shed open, the cylinders at rest", lambda it: it.over.shed)
    tension_locked = computed("N", "tension if only the lower cylinder took up", lambda it: it.over.locked)


def tension_of(design: WarpTensionDesign) -> WarpTension:
    """The warps' tensions over the rows between two take-ups."""
    params = design.params
    stiffness = params.warp_stiffness or warp_stiffness(params.pitch)
    rate, woven = stiffness / params.free_length, params.rows_between * params.row_pitch
    lengthening = float(shed_lengthening(params.shed_lift, params.shed_span, params.shed_span))
    return WarpTension(
        take_up_tension(params.tension, rate, woven, params.crimp, lengthening),
        params.rows_between,
        stiffness,
        COTTON.breaking_force(warp_density(params.pitch)),
        woven * params.crimp / design.outer_radius,
        rate * design.outer_radius * turn / FULL_STEPS / design.reducer.ratio,
    )


def history(design: WarpTensionDesign, rows: int) -> tuple[FloatArray, FloatArray]:
    """Rows woven and the tension of an even warp [N] over some rows."""
    return tension_history(tension_of(design).over, design.params.rows_between, rows)
