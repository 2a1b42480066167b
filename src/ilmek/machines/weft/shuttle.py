"""The shuttles: one for each weft, with its bobbin, dragged through the shed by a carriage on a belt axis.

The carriage runs behind the warps and drags a shuttle by magnets; the warps at rest glide between the two, the lifted
ones are before the shuttle. A guideway on the tips of the cams [thesis, Fig 3.18] would move with the cams while they
turn, so that the carriage's axis is the guide. At each edge a box with two cells, one above the other, holds the
shuttles: one arrives, the box shifts, the other leaves. The straight weft is laid one way, the sinuous weft back; in
every second row both start at the other edge, to which the carriage runs empty while the knots are tied.

    force on the magnets   sqrt( (m a + T)² + (m g)² )

m full shuttle, a its acceleration, T tension of the weft; the weight acts along the warps, which are upright. What the
magnets hold beside the friction of their pull on the warps: `coupling`.                                       [derived]
"""

import math
from dataclasses import replace

from ilmek.carpet.ground import WeftLengths
from ilmek.elements.materials import GRAVITY
from ilmek.machines.weft.bobbin import BobbinSize, Winding, bobbin_sizes, windings
from ilmek.machines.weft.carriers import BOBBIN, CARRIAGE, MAGNET, SHUTTLE_WOOD, bobbin, magnet, shuttle_wood
from ilmek.machines.weft.coupling import PAIRS, MagneticCoupling, coupling
from ilmek.machines.weft.params import WeftParams
from ilmek.machines.weft.shed import needed_opening, shed_check
from ilmek.machines.weft.tension import braked, draw_off_tension
from ilmek.records import computed, group, record, result
from ilmek.report import Alternative, Check, Choice, Json, at_least, at_most, choose

SUPPORTS = 3
"""Lifted warps on which a shuttle bears at every instant: with two it would tilt at each change; assumed here."""

BOX_END = 0.02
"""End of a shuttle's box beyond the shuttle [m]."""


@record
class Shuttle:
    """A shuttle with a full bobbin of the straight weft; that of the sinuous weft is of the same size."""

    bobbin: BobbinSize
    windings: tuple[Winding, Winding]
    depth: float = result("mm", "depth of the carrier across the shed", name="carrier_depth")
    length: float = result("mm", "length of the carrier", name="carrier_length")
    opening: float = result("mm", "opening of the shed that the carrier needs where it runs", name="shed_needed")
    empty: float = result("kg", "mass of a shuttle without its bobbin", name="mass_empty")
    full: float = result("kg", "mass of a shuttle with its full bobbin, the heavier of both", name="mass_full")
    supports: int = result("1", "lifted warps on which a shuttle bears, at least", least=0.0)
    coupling: MagneticCoupling = group()

    @computed("", "diameter, core and length of a bobbin's winding [m]", name="bobbin")
    def bobbin_size(self) -> Json:
        return {"diameter": self.bobbin.diameter, "core": self.bobbin.core, "length": self.bobbin.length}

    @computed("m", "length of each weft on a full bobbin")
    def capacity(self) -> dict[str, float]:
        return {winding.name: winding.capacity for winding in self.windings}

    @computed("1", "rows that a bobbin of each weft lasts")
    def rows_of_a_bobbin(self) -> dict[str, int]:
        return {winding.name: winding.rows for winding in self.windings}

    @property
    def width(self) -> float:
        """Size along the warps [m]: as its depth."""
        return self.depth


def shuttle_for(params: WeftParams, lengths: WeftLengths) -> tuple[Shuttle, tuple[Choice, ...]]:
    """The shuttle with the smallest bobbin whose checks hold, or the largest for the least time, and that choice.

    Its magnets, which grow with the bobbin, are to bear the allowed acceleration.
    """
    tried = [_unweighed(params, size, lengths) for size in bobbin_sizes(params)]
    if params.aim == "time":
        tried.reverse()
    tension = most_tension(params)
    named: list[Alternative] = []
    enough = False
    for number, one in enumerate(tried):
        checks = size_checks(params, one)
        if not enough and all(check.ok for check in checks):
            tried[number] = _weighed(params, one)
            checks = (*checks, magnet_check(params, tried[number], params.acceleration, tension))
            enough = checks[-1].ok
        named.append(Alternative(one.bobbin.name, checks))
    index, choice = choose("bobbin", named, params.aim)
    return _weighed(params, tried[index]), (choice,) if len(tried) > 1 else ()


def _unweighed(params: WeftParams, size: BobbinSize, lengths: WeftLengths) -> Shuttle:
    """The shuttle for a bobbin, without its masses."""
    depth, bay = size.diameter + 2 * params.wall, size.length + 2 * params.wall
    return Shuttle(
        bobbin=size,
        windings=windings(params, size, lengths),
        depth=depth,
        length=bay + 2 * params.nose,
        opening=needed_opening(params, depth),
        empty=math.nan,
        full=math.nan,
        supports=math.floor(bay / (2 * params.cloth.warp_pitch) * (1 + 1e-12)),
        coupling=coupling(params, size.diameter),
    )


def _weighed(params: WeftParams, shuttle: Shuttle) -> Shuttle:
    """The shuttle with the masses of its parts."""
    magnets = PAIRS * magnet(params, shuttle.bobbin).mass if params.nose > 0 else 0.0
    empty = shuttle_wood(params, shuttle.bobbin).mass + magnets + params.fittings
    full = empty + bobbin(params, shuttle.bobbin).mass + max(winding.mass for winding in shuttle.windings)
    return replace(shuttle, empty=empty, full=full)


def size_checks(params: WeftParams, shuttle: Shuttle) -> tuple[Check, ...]:
    """The checks that the size of the bobbin decides."""
    lasts = min(*(winding.rows for winding in shuttle.windings), params.rows)
    least = min(params.least_rows, params.rows)
    where = "assumed by this project: parameters least_rows, packing, reserve"
    cure = "set a higher lift, weft=rapier, or a smaller weft.least_rows"
    supports = "every second warp is lifted; three supports, assumed by this project"
    return (
        at_least("rows between two changes of a bobbin", lasts, least, "1", where).with_cure(cure, BOBBIN),
        shed_check(params, shuttle.opening, "a smaller weft.bobbin_diameter", SHUTTLE_WOOD),
        at_least("lifted warps under the shuttle", shuttle.supports, SUPPORTS, "1", supports).with_cure(
            "set a longer weft.bobbin_length", SHUTTLE_WOOD
        ),
        at_most(
            "gap that the shuttle bridges at the edge",
            params.edge + 2 * params.cloth.warp_pitch,
            shuttle.length / 2,
            "mm",
            "its middle is supported until its tip bears on the first lifted warp",
        ).with_cure("set a smaller weft.edge or a longer bobbin", SHUTTLE_WOOD),
    )


def shuttle_checks(params: WeftParams, shuttle: Shuttle, acceleration: float, tension: float) -> tuple[Check, ...]:
    """All checks of the shuttle at an acceleration [m/s²] and a tension of its weft [N]."""
    return (*size_checks(params, shuttle), magnet_check(params, shuttle, acceleration, tension))


def magnet_check(params: WeftParams, shuttle: Shuttle, acceleration: float, tension: float) -> Check:
    """Whether the magnets drag the full shuttle at an acceleration [m/s²] and a tension of its weft [N]."""
    return at_most(
        "force on the shuttle's magnets",
        params.safety * coupling_force(shuttle, acceleration, tension),
        shuttle.coupling.hold,
        "N",
        "m a, tension and weight, by parameter safety; block magnets of the noses [Akoun and Yonnet, 1984]",
    ).with_cure(
        "set a lower weft.acceleration, a longer weft.nose, a smaller weft.play, or weft=rapier",
        *((MAGNET, CARRIAGE) if params.nose > 0 else (CARRIAGE,)),
    )


def friction(params: WeftParams, shuttle: Shuttle) -> float:
    """Friction of the shuttle on the warps [N]."""
    return params.cloth.yarns.friction * shuttle.coupling.pull


def most_tension(params: WeftParams) -> float:
    """Largest tension of both wefts at the allowed speed [N]."""
    yarns = params.cloth.carpet_yarns
    return max(
        draw_off_tension(yarn, braked(params, yarn), params.speed, params.wrap)
        for yarn in (yarns.straight_weft, yarns.sinuous_weft)
    )


def coupling_force(shuttle: Shuttle, acceleration: float, tension: float) -> float:
    """Force on the magnets of the full shuttle, beside the friction of their own pull [N]."""
    return math.hypot(shuttle.full * acceleration + tension, shuttle.full * GRAVITY)
