"""The hammer's design: fabric, force of the beat, where the row ends up, comb, and what drives it.

The comb is pressed: what the drive gives for each warp, F, is what the fell resists with, R(p) = F, so that the row's
distance p, and with it the knots along the length, are an outcome. Comb: the axes are sized for the force that the
wanted rows ask, or for the one given. Linkage: the force is what the crank-rockers' motion gives at the beat.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.hammer.axis import CombDrive, axis_for
from ilmek.machines.hammer.comb import Comb, comb_for, with_depth
from ilmek.machines.hammer.linkage import Linkage, linkage_for
from ilmek.machines.hammer.params import HammerParams
from ilmek.weaving.fell import Fabric


@dataclass(frozen=True, slots=True)
class Hammer:
    """A hammer, designed.

    params  those in force, with the depth of the comb
    force   for each warp [N]                      needed  the force that the wanted rows ask of each warp [N]
    spacing distance of the rows it leaves [m]     fell    how far the fell gives way [m]
    energy  of a beat, for each warp [J]
    axis    of the comb drive, linkage of the other; None for the drive that is not taken
    """

    params: HammerParams
    fabric: Fabric
    force: float
    needed: float
    spacing: float
    fell: float
    energy: float
    comb: Comb
    axis: CombDrive | None
    linkage: Linkage | None

    @property
    def rows_along(self) -> float:
        """Rows of knots over the length [1/m], the outcome."""
        return 1 / self.spacing

    @property
    def mass(self) -> float:
        """What moves [kg]: cams and comb, or the comb alone and its crank-rockers."""
        if self.axis is not None:
            return self.axis.mass
        return self.comb.mass + (self.linkage.number * sum(self.linkage.one.masses.values()) if self.linkage else 0.0)

    def force_across(self) -> FloatArray:
        """Force of a warp [N] at `comb.line.x`."""
        return self.force * self.comb.line.share

    def spacing_across(self) -> FloatArray:
        """Distance of rows [m] at `comb.line.x`; a row that the comb does not reach stays as it is laid."""
        return np.asarray(self.fabric.spacing(np.maximum(self.force_across(), 0.0)))


def fabric_of(params: HammerParams) -> Fabric:
    """The fell of the parameters, for one warp."""
    return Fabric(
        tension=params.warp_tension,
        laid=params.laid,
        jammed=params.jammed,
        packing=params.packing or params.rows / 4,
        warp_rate=params.stiffness / params.warp_length,
        cloth_rate=params.stiffness / params.cloth_length,
    )


def design(params: HammerParams) -> Hammer:
    """The hammer for the parameters. Raises MechanismError where its crank-rockers do not move."""
    fabric = fabric_of(params)
    needed = float(fabric.resistance(params.rows))
    params = with_depth(params, fabric, params.force or needed)
    linkage = linkage_for(params) if params.drive == "linkage" else None
    force = params.force or (linkage.force / params.warps if linkage else needed)
    spacing = float(fabric.spacing(force))
    return Hammer(
        params=params,
        fabric=fabric,
        force=force,
        needed=needed,
        spacing=spacing,
        fell=float(fabric.fell(force)),
        energy=fabric.energy(force),
        comb=comb_for(params, fabric, force),
        axis=None if linkage else axis_for(params, fabric, force),
        linkage=linkage,
    )
