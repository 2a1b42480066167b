"""What only the report of the warp tension needs: the three cylinders, the spacer's slots, the warps' tension."""

from typing import Any

from ilmek.machines.warp_tension.cylinders import Cylinder, Slots, cylinders, slots_of, tension_beyond
from ilmek.machines.warp_tension.design import WarpTensionDesign
from ilmek.machines.warp_tension.tension import WarpTension, tension_of
from ilmek.records import computed, group, record


@record
class WarpTensionAnalysis:
    """A design, its upper and lower cylinder and its spacer, the slots, and the tension over a row."""

    design: WarpTensionDesign = group()
    cylinders: tuple[Cylinder, Cylinder, Cylinder]
    slots: Slots = group()
    tension: WarpTension = group()

    cylinder_tube = computed("", "stock tube of each cylinder", lambda it: it.of_each("tube_name"))
    cylinder_load = computed(
        "kN/m", "load with own weight", lambda it: {one.name: abs(one.load) for one in it.cylinders}
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
    bearing_static_safety = computed("1", "C0 / P0 [ISO 76]", lambda it: it.of_each("static_safety"))
    stub_stress = computed("MPa", "stress in the shaft ends [von Mises]", lambda it: it.of_each("stub_stress"))
    mass_cylinders = computed("kg", "mass of the three tubes", lambda it: sum(one.mass for one in it.cylinders))
    spacer_radius = computed("mm", "outer radius of the spacer", lambda it: it.spacer.outer + it.slots.depth)
    tension_spacer = computed("N", "tension beyond the spacer in slip", lambda it: tension_beyond(it.design.params))

    @property
    def spacer(self) -> Cylinder:
        """The spacer."""
        return self.cylinders[2]

    def of_each(self, attribute: str) -> dict[str, Any]:
        """An attribute of the cylinders by their names."""
        return {one.name: getattr(one, attribute) for one in self.cylinders}


def analyse(design: WarpTensionDesign) -> WarpTensionAnalysis:
    """The analysis of a design. Raises ParameterError where the spacer's tube is cut through by its slots."""
    return WarpTensionAnalysis(design, cylinders(design), slots_of(design.params), tension_of(design))
