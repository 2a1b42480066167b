"""The tensions of a warp over the rows between two take-ups, and the loads of all warps in the three cases."""

from dataclasses import replace

from ilmek.elements.carpet_yarns import usual_warp
from ilmek.machines.warp_loads import WarpLoads, beat_tension
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.weaving.fell import assumed_fabric
from ilmek.weaving.shed import shed_lengthening
from ilmek.weaving.tension import TakeUpTension, take_up_tension


def stiffness_of(params: WarpTensionParams) -> float:
    """Force over strain of a warp [N]."""
    return params.warp_stiffness or usual_warp(params.pitch).stiffness


def tensions_of(params: WarpTensionParams) -> TakeUpTension:
    """The tensions of a warp between two take-ups; that in the open shed as given, or by its lengthening.

    Weaving adds to it what it adds to the tension at rest.
    """
    rate, woven = stiffness_of(params) / params.free_length, params.rows_between * params.row_pitch
    lengthening = float(shed_lengthening(params.shed_lift, params.shed_span, params.shed_span))
    found = take_up_tension(params.tension, rate, woven, params.crimp, lengthening)
    given = params.tension_shed
    return found if given is None else replace(found, shed=given + found.woven - found.rest)


def loads_of(params: WarpTensionParams) -> WarpLoads:
    """The loads of all warps, standing, with the shed open, and at the beat."""
    low, beat = params.tension_shed_low, params.tension_beat
    if beat is None:
        fabric = assumed_fabric(params.row_pitch, params.tension, stiffness_of(params), params.free_length)
        beat = beat_tension(fabric, params.row_pitch)
    shed, beaten = tensions_of(params).shed, min(params.warps_beaten or params.warps, params.warps)
    return WarpLoads(params.warps, beaten, params.tension, shed, params.tension if low is None else low, beat)
