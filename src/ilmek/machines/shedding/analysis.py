"""What only the report of shedding cams needs: other phases of the cams, and the warps as yarns draped over them."""

import numpy as np

from ilmek.machines.shedding.design import SheddingDesign
from ilmek.machines.shedding.params import SheddingParams
from ilmek.machines.shedding.phases import Shed, flattest, shed_of
from ilmek.machines.shedding.warp import bridged, draped, nose_radius, shed_warp, warp_force
from ilmek.records import computed, record
from ilmek.report import Json
from ilmek.weaving.draping import Bridges, DrapedWarp
from ilmek.weaving.shed import ShedWarp
from ilmek.weaving.tension import capstan


@record
class SheddingAnalysis:
    """A design, other phases of the cams of its first shaft, and the warps on them.

    together, flattest  the cams all at once, and in the phases of least torque
    warp                that the cams lift; None where only its force is given
    yarn                the warp draped over the cam; None without `warp`, or where a hold is too near
    bridges             hollows of the cam that a taut yarn bridges; None where there is none
    """

    design: SheddingDesign
    together: Shed
    flattest: Shed
    warp: ShedWarp | None
    yarn: DrapedWarp | None
    bridges: Bridges | None

    @computed("mm", "elongation of a lifted warp", absent="no spans are given")
    def warp_lengthening(self) -> float | None:
        return lengthening_of(self.design.first.params)

    @computed(
        "%",
        "strain of a lifted warp, without the share that its cylinder takes up",
        absent="no spans or no length of the warp are given",
    )
    def warp_strain(self) -> float | None:
        return strain_of(self.design.first.params, self.warp_lengthening)

    @computed("N", "tension of a lifted warp", absent="no spans are given")
    def warp_tension_max(self) -> float | None:
        return float(self.warp.tension_at(self.design.first.params.lift)) if self.warp else None

    @computed("N", "force of a lifted warp across the shaft")
    def warp_force_max(self) -> float:
        return float(warp_force(self.design.first.params, np.array(self.design.first.params.lift)))

    @computed("", "hollows of the cam that a taut yarn bridges [rad, m]", absent="there is none")
    def bridged(self) -> Json:
        found = self.bridges
        if found is None:
            return None
        return {"arcs": [list(arc) for arc in found.arcs], "excess": found.excess, "at": found.at}

    @computed("", "the warp as a yarn draped over the cam [N m, m, rad, N/m]", absent="no spans, or a hold is too near")
    def draped(self) -> Json:
        yarn, shed = self.yarn, self.design.shed
        if yarn is None:
            return None
        wrap, radius, tension = float(np.max(yarn.wrap)), nose_radius(self.design.cam), float(np.max(yarn.tension))
        return {
            "torque_max": float(np.max(np.abs(shed.draped_torque(yarn)))),
            "lengthening_max": float(np.max(yarn.lengthening)),
            "tension_max": tension,
            "lifted_angle": yarn.lifted,
            "wrap_max": wrap,
            "pressure_max": tension / radius if radius > 0 else None,
            "capstan_ratio": capstan(self.design.params.cloth.yarns.friction, wrap),
        }


def analyse(design: SheddingDesign) -> SheddingAnalysis:
    """The analysis of a design."""
    first = design.first
    params, even, cam, numbers = first.params, first.even, first.cam, first.numbers
    flat = first.shed if params.phase == "flattest" else flattest(params, even, numbers)
    together = shed_of(params, even, numbers=numbers)
    return SheddingAnalysis(design, together, flat, shed_warp(params), draped(params, cam), bridged(cam))


def lengthening_of(params: SheddingParams) -> float | None:
    """Elongation of a lifted warp of a shaft [m]; None where only its force is given."""
    warp = shed_warp(params)
    return float(warp.lengthening(params.lift)) if warp else None


def strain_of(params: SheddingParams, longer: float | None) -> float | None:
    """Strain of a warp of a shaft by an elongation [m], less its cylinder's share; None where it is not stretched."""
    if longer is None or params.warp_length is None:
        return None
    return (1 - params.compensation) * longer / params.warp_length


def results(analysis: SheddingAnalysis) -> tuple[object, ...]:
    """The records whose results are reported: cams and shed, guideway, stack, shaft, drive, warps."""
    design = analysis.design
    return design, design.guideway, design.stack, design.shaft, design.drive, analysis
