"""What only the report of the warp tension needs: the three cylinders, the spacer's slots, the warps' tension.

With w the carpet woven between two take-ups and c the crimp, the upper cylinder of radius R releases w c beyond what
the lower one winds: the correction, w c / R of its angle. A full step of the stepper rotates the cylinder by 1.8
degrees over the ratio: the smallest change that the motor can set; a hand sets its crank to 15 degrees, assumed here.
"""

from ilmek.arrays import FloatArray
from ilmek.elements.motors import FULL_STEPS
from ilmek.machines.warp_tension.cylinders import Cylinder, Slots, cylinders, slots_of, tension_beyond
from ilmek.machines.warp_tension.design import WarpTensionDesign
from ilmek.machines.warp_tension.loads import tensions_of
from ilmek.records import computed, group, record, result
from ilmek.report.json import Json
from ilmek.units import turn
from ilmek.weaving.tension import TakeUpTension, tension_history

HAND_STEPS = 24
"""Positions in a turn to which a hand sets its crank; assumed by this project."""


@record
class WarpTension:
    """Tensions of a warp on the cylinders; `over`: the rows between two take-ups."""

    over: TakeUpTension
    rows_between: int
    stiffness: float = result("kN", "force over strain of a warp", name="warp_stiffness")
    breaking: float = result("N", "breaking force of a warp", name="tension_breaking")
    correction: float = result("deg", "release of the upper cylinder beyond the lower one", name="correction_angle")
    step: float = result(
        "N", "change of tension for a full step of the motor, or 15 deg of the crank", name="tension_step"
    )

    tension_woven = computed("N", "tension before the take-up: crimp tightens the warps", lambda it: it.over.woven)
    tension_row = computed("N", "change of it over a row", lambda it: (it.over.woven - it.over.rest) / it.rows_between)
    tension_shed = computed("N", "tension with the shed open, the cylinders at rest", lambda it: it.over.shed)
    tension_locked = computed("N", "tension if only the lower cylinder took up", lambda it: it.over.locked)


def tension_of(design: WarpTensionDesign) -> WarpTension:
    """The warps' tensions over the rows between two take-ups."""
    params, over = design.params, tensions_of(design.params)
    warp, steps = params.cloth.carpet_yarns.warp, HAND_STEPS if params.by_hand else FULL_STEPS
    return WarpTension(
        over,
        params.rows_between,
        warp.stiffness,
        warp.breaking_force,
        params.rows_between * params.cloth.row_distance * params.crimp / design.outer_radius,
        over.rate * design.outer_radius * turn / steps / design.reducer.ratio,
    )


def history(design: WarpTensionDesign, rows: int) -> tuple[FloatArray, FloatArray]:
    """Rows woven and the tension of an even warp [N] over some rows."""
    return tension_history(tension_of(design).over, design.params.rows_between, rows)


@record
class WarpTensionAnalysis:
    """A design, its upper and lower cylinder and its spacer, the slots, and the tension over a row."""

    design: WarpTensionDesign = group()
    cylinders: tuple[Cylinder, Cylinder, Cylinder]
    slots: Slots = group()
    tension: WarpTension = group()

    cylinder_tube = computed("", "stock tube of each cylinder", lambda it: it.of_each("tube_name"))
    cylinder_load = computed(
        "kN/m", "load with own weight", lambda it: {cylinder.name: abs(cylinder.load) for cylinder in it.cylinders}
    )
    cylinder_slope = computed("mrad", "slope in the bearings", lambda it: it.of_each("slope"))
    cylinder_slope_bare = computed("mrad", "the same without own weight", lambda it: it.of_each("slope_bare"))
    cylinder_deflection = computed("mm", "deflection at mid-width", lambda it: it.of_each("deflection"))
    cylinder_deflection_bare = computed("mm", "the same without own weight", lambda it: it.of_each("deflection_bare"))
    cylinder_reaction = computed("N", "force on each bearing", lambda it: it.of_each("reaction"))
    cylinder_mass = computed("kg", "mass of each tube", lambda it: it.of_each("mass"))
    bearing = computed("", "bearings of each cylinder", lambda it: {one.name: one.bearing.name for one in it.cylinders})
    bearing_life = computed("1", "their life in turns [ISO 281]", lambda it: it.of_each("life"))
    bearing_time = computed("h", "the same at the take-up's mean speed", lambda it: it.of_each("time"))
    bearing_static_safety = computed("1", "C0 / P0 [ISO 76]", lambda it: it.of_each("static_safety"), least=0.0)
    stub_stress = computed("MPa", "stress in the shaft ends [von Mises]", lambda it: it.of_each("stub_stress"))
    mass_cylinders = computed("kg", "mass of the three tubes", lambda it: sum(one.mass for one in it.cylinders))
    spacer_radius = computed("mm", "outer radius of the spacer", lambda it: it.spacer.outer + it.slots.depth, least=0.0)
    tension_spacer = computed("N", "tension beyond the spacer in slip", lambda it: tension_beyond(it.design.params))

    @property
    def spacer_wall(self) -> float:
        """Wall of the spacer's tube [m], its slots not cut."""
        return self.spacer.tube.wall if self.spacer.tube else self.spacer.outer - self.spacer.inner

    @property
    def spacer(self) -> Cylinder:
        """The spacer."""
        return self.cylinders[2]

    def of_each(self, attribute: str) -> dict[str, Json]:
        """An attribute of the cylinders by their names."""
        return {cylinder.name: getattr(cylinder, attribute) for cylinder in self.cylinders}


def analyse(design: WarpTensionDesign) -> WarpTensionAnalysis:
    """The analysis of a design."""
    return WarpTensionAnalysis(design, cylinders(design), slots_of(design.params), tension_of(design))
