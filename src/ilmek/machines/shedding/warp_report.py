"""What a design of shedding cams says of the warps: tension, strain, and how they lie on the cams."""

import math

import numpy as np

from ilmek.cams.limits import concave_radius_min
from ilmek.machines.shedding.alternatives import SheddingAlternatives
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.machines.shedding.draped import nose_radius, stack_torque
from ilmek.machines.shedding.warp import shed_warp
from ilmek.report import Check, Json, Result, at_most
from ilmek.units import format_quantity
from ilmek.weaving.shed import ShedWarp
from ilmek.weaving.tension import capstan


def warp_results(studied: SheddingAlternatives) -> tuple[Result, ...]:
    """Tension and strain over the turn, bridging, and the yarn draped over the cam; null where there is no tension."""
    design, params = studied.design, studied.design.params
    warp = shed_warp(params)
    top = np.array(params.lift)
    longer = float(warp.lengthening(top)) if warp else None
    most = float(warp.tension_at(top)) if warp else None
    across = float(most * warp.slope(top)) if warp and most else params.warp_force
    return (
        Result("warp_lengthening", longer, "mm", "what a lifted warp is longer by"),
        Result("warp_strain", _strain(design, warp), "%", "what of it the warp itself takes, over its length"),
        Result("warp_tension_max", most, "N", "tension of a warp, lifted"),
        Result("warp_force_max", across, "N", "force of a lifted warp across the shaft"),
        Result("bridged", _bridged(studied), "", "hollows of the cam that a taut yarn bridges [rad, m]"),
        Result("draped", _draped(studied), "", "the warp as a yarn draped over the cam [N m, m, rad, N/m]"),
    )


def warp_checks(design: SheddingDesign) -> tuple[Check, ...]:
    """The strain of a warp that stretches."""
    strain = _strain(design, shed_warp(design.params))
    if strain is None:
        return ()
    return (at_most("strain of a lifted warp", strain, design.params.strain_limit, "%", "strain_limit"),)


def warp_warnings(studied: SheddingAlternatives) -> tuple[str, ...]:
    """That a yarn does not follow a hollow cam; that the holds stand in the way of the nose."""
    design, found = studied.design, studied.bridged
    hollow, params = concave_radius_min(design.cam), design.params
    said = []
    if hollow is not None and params.roller_radius == 0:
        shown, where = format_quantity(hollow.value, "mm"), format_quantity(hollow.at, "deg")
        by = f", by {format_quantity(found.excess, 'mm')} at most" if found else ""
        said.append(
            f"the cam is hollow (radius {shown} at {where}): a taut warp bridges the hollow and is lifted a little "
            f"earlier and let down a little later than the law says{by}"
        )
    if shed_warp(params) is not None and studied.yarn is None:
        reach = format_quantity(design.cam.prime_radius + params.lift, "mm")
        said.append(f"a hold of the warps stands within the {reach} that the cams reach: set longer spans")
    return tuple(said)


def _strain(design: SheddingDesign, warp: ShedWarp | None) -> float | None:
    """Strain of a lifted warp; None where its stiffness is not given."""
    params = design.params
    if warp is None or params.warp_stiffness is None:
        return None
    longer = float(warp.lengthening(np.array(params.lift)))
    return (1 - params.compensation) * longer / (params.warp_length or warp.front + warp.back)


def _bridged(studied: SheddingAlternatives) -> Json:
    found = studied.bridged
    if found is None:
        return None
    return {"arcs": [list(arc) for arc in found.arcs], "excess": found.excess, "at": found.at}


def _draped(studied: SheddingAlternatives) -> Json:
    design, yarn = studied.design, studied.yarn
    if yarn is None:
        return None
    wrap, radius = float(np.max(yarn.wrap)), nose_radius(design.cam)
    return {
        "torque_max": float(np.max(np.abs(stack_torque(design.shed, yarn)))),
        "lengthening_max": float(np.max(yarn.lengthening)),
        "tension_max": float(np.max(yarn.tension)),
        "lifted_angle": yarn.lifted,
        "wrap_max": wrap,
        "pressure_max": float(np.max(yarn.tension)) / radius if radius > 0 else math.inf,
        "capstan_ratio": capstan(design.params.friction, wrap),
    }
