"""The tensions of a warp over the rows between two take-ups, and the loads of all warps in the three cases."""

from dataclasses import replace

from ilmek.machines.warp_loads import WarpLoads, beat_tension
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.weaving.fell import assumed_fabric
from ilmek.weaving.shed import shed_lengthening
from ilmek.weaving.tension import TakeUpTension, take_up_tension


def tensions_of(params: WarpTensionParams) -> TakeUpTension:
    """The tensions of a warp between two take-ups; that in the open shed as given, or by its lengthening.

    Weaving adds to it what it adds to the tension at rest.
    """
    cloth = params.cloth
    rate = cloth.carpet_yarns.warp.stiffness / params.free_length
    woven = params.rows_between * cloth.row_distance
    lengthening = float(shed_lengthening(params.shed_lift, params.shed_span, params.shed_span))
    tension = take_up_tension(cloth.warp_tension, rate, woven, params.crimp, lengthening)
    given = params.tension_shed
    return tension if given is None else replace(tension, shed=given + tension.woven - tension.rest)


def loads_of(params: WarpTensionParams) -> WarpLoads:
    """The loads of all warps, standing, with the shed open, and at the beat."""
    cloth, low, beat = params.cloth, params.tension_shed_low, params.tension_beat
    rest, stiffness = cloth.warp_tension, cloth.carpet_yarns.warp.stiffness
    if beat is None:
        fabric = assumed_fabric(cloth.row_distance, rest, stiffness, params.free_length)
        beat = beat_tension(fabric, cloth.row_distance)
    shed, beaten = tensions_of(params).shed, min(params.warps_beaten or cloth.warps, cloth.warps)
    return WarpLoads(cloth.warps, beaten, rest, shed, rest if low is None else low, beat)
