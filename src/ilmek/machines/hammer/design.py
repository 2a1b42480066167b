"""The hammer's design: fabric, force of the beat, where the row ends up, comb, and what drives it.

The comb is pressed: the force of the drive for each warp, F, equals the resistance of the fell, R(p) = F, so that the
distance p of the row, and with it the knots along the length, are an outcome. Comb: the axes are sized for the force
that the required rows need, or for the given one. Linkage: the force is what the crank-rockers' motion can give at the
beat. There each rocker turns its share of the comb back with m a: the fell can take so much force before the load of
the pins changes sign, and so much is counted on. It grows with the square of the speed; where it is more than the rows
need, the fell takes what they need.
"""

from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.hammer.axis import CombDrive, chosen_axes
from ilmek.machines.hammer.comb import Comb, comb_for, with_depth
from ilmek.machines.hammer.linkage import CombLinkage, chosen_linkage
from ilmek.machines.hammer.params import HammerParams
from ilmek.records import computed, record, result
from ilmek.report import Choice
from ilmek.weaving.fell import Fabric


@record
class Hammer:
    """A hammer, designed.

    params  those in force, with the depth of the comb
    axis    of the comb drive, linkage of the other; None for the drive that is not taken
    """

    params: HammerParams
    fabric: Fabric
    comb: Comb
    axis: CombDrive | None
    linkage: CombLinkage | None
    choices: tuple[Choice, ...]
    spacing: float = result("mm", "distance of the rows that the beat leaves: the outcome", name="row_pitch")
    force: float = result("N", "mean force on the fell for each warp", name="force_warp")
    needed: float = result("N", "force for each warp that the required rows need", name="force_needed")

    rows_along = computed("1/dm", "rows of knots along the carpet", lambda it: 1 / it.spacing, name="knots_along")
    row_pitch_range = computed(
        "mm", "least and largest row pitch over the width", lambda it: _ends(it.spacing_across())
    )
    force_warp_min = computed("N", "least force of a warp over the width", lambda it: float(it.force_across().min()))
    force_warp_max = computed("N", "largest force of a warp over the width", lambda it: float(it.force_across().max()))
    whole_force = computed("N", "force on the whole fell", lambda it: it.force * it.params.cloth.warps, name="force")
    tension = computed("N", "tension of a warp before the beat", lambda it: it.fabric.tension)
    fell = computed(
        "mm", "elastic displacement of the fell", lambda it: float(it.fabric.fell(it.force)), name="fell_movement"
    )

    @computed("mm", "travel of the comb from the laid row to its end", name="comb_way")
    def comb_travel(self) -> float:
        return float(self.fabric.travel(self.force))

    bump_force = computed("N", "force of a warp from which the cloth is slack", lambda it: it.fabric.bump)
    beat_energy = computed("J", "work of a beat on rows, warps and cloth", lambda it: it.energy * it.params.cloth.warps)

    @computed("J", "part of it that packs the row and is not returned")
    def packing_energy(self) -> float:
        return self.fabric.packing_work(self.spacing) * self.params.cloth.warps

    beat_power = computed("W", "mean power, two beats a turn", lambda it: 2 * it.beat_energy / it.params.turn_time)

    @computed("kg", "mass of all that moves: cams and comb, or the comb alone and its crank-rockers")
    def mass(self) -> float:
        if self.axis is not None:
            return self.axis.mass
        linkage = self.linkage
        return linkage.number * sum(body.mass for body in linkage.one.bodies.values()) if linkage else self.comb.mass

    @property
    def energy(self) -> float:
        """Work of a beat, for each warp [J]."""
        return self.fabric.energy(self.force)

    @property
    def speed_max(self) -> float:
        """Largest speed of the comb [m/s]."""
        if self.axis is not None:
            return self.axis.speed_max
        return self.linkage.one.beater_velocity_max if self.linkage else 0.0

    def force_across(self) -> FloatArray:
        """Force of a warp [N] at `comb.line.x`."""
        return self.force * self.comb.line.share

    def spacing_across(self) -> FloatArray:
        """Distance of rows [m] at `comb.line.x`; a row that the comb does not reach stays as it is laid."""
        return np.asarray(self.fabric.spacing(np.maximum(self.force_across(), 0.0)))


def _ends(values: FloatArray) -> list[float]:
    return [float(values.min()), float(values.max())]


@lru_cache(maxsize=16)
def design(params: HammerParams) -> Hammer:
    """The hammer for the parameters. Raises MechanismError where its crank-rockers do not move."""
    fabric = params.fabric
    needed = float(fabric.resistance(params.cloth.row_distance))
    axis = linkage = None
    if params.drive == "linkage":
        params, linkage, choices = chosen_linkage(params, fabric, needed)
        force = min(params.force or needed, linkage.force / params.cloth.warps)
    else:
        force = params.force or needed
        params, axis, choices = chosen_axes(with_depth(params, fabric, force), fabric, force)
    return Hammer(
        params=params,
        fabric=fabric,
        comb=comb_for(params, fabric, force),
        axis=axis,
        linkage=linkage,
        choices=choices,
        spacing=float(fabric.spacing(force)),
        force=force,
        needed=needed,
    )
