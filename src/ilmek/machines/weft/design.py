"""The weft's design: what a row needs of each weft, the carrier, its passage, its axis, the stops for new bobbins.

Both carriers are designed where it is left open. The cheaper one whose checks hold is chosen, or the one that takes the
least time for the carpet: passages, stretched to the window of the shed, and stops.
"""

import math
from dataclasses import replace
from typing import TypeAlias

from ilmek.carpet.ground import WeftLengths, weft_lengths
from ilmek.elements.carpet_yarns import CarpetYarnParams
from ilmek.elements.linear_guides import LINEAR_GUIDES
from ilmek.elements.materials import GRAVITY
from ilmek.elements.prices import price_of, read_prices
from ilmek.loom.bobbins import Bobbin, stop_count, stop_time
from ilmek.machines import WEFT_CARRIERS
from ilmek.machines.weft.axis import BeltAxis, belt_axis
from ilmek.machines.weft.bobbin import windings
from ilmek.machines.weft.carriers import AXIS, BOBBIN, BOX, CARRIAGE, GRIPPER, MOTOR
from ilmek.machines.weft.guide import carriage_mass, guide_for
from ilmek.machines.weft.params import AUTO, RAPIER, SHUTTLE, WeftParams
from ilmek.machines.weft.passage import WeftPassage
from ilmek.machines.weft.rapier import DRIVE, Rapier, rapier_checks, rapier_for, reach
from ilmek.machines.weft.shuttle import BOX_END, Shuttle, friction, shuttle_checks, shuttle_for
from ilmek.machines.weft.tension import braked, draw_off_tension
from ilmek.machines.weft.tree import WeftBodies
from ilmek.part.bill import bill
from ilmek.records import computed, record, result
from ilmek.report import Alternative, BillLine, Check, Choice, at_least, at_most, choose, must
from ilmek.timing.s_curve import s_curve
from ilmek.units import turn
from ilmek.weaving.selvedge import in_front, warps_let_go

Carrier: TypeAlias = Shuttle | Rapier


@record
class Weft:
    """The weft side, designed.

    params    those in force, with the carrier        lengths   of each weft for a row
    carried   the carrier                             passage   through the shed      axis  that moves it
    bodies    of all of these
    """

    params: WeftParams
    lengths: WeftLengths
    carried: Carrier
    passage: WeftPassage
    axis: BeltAxis
    bodies: WeftBodies
    tension: dict[str, float] = result("N", "largest tension of each weft while it is drawn off", name="weft_tension")
    choices: tuple[Choice, ...] = ()
    alternatives: tuple["Weft", ...] = ()

    carrier = computed("", "what carries the weft", lambda it: it.params.carrier)

    @computed("m", "length of each weft for a row, with its turn")
    def weft_length(self) -> dict[str, float]:
        return {"straight weft": self.lengths.straight, "sinuous weft": self.lengths.sinuous}

    @computed("m", "length of each weft for the carpet")
    def weft_need(self) -> dict[str, float]:
        return {name: self.params.rows * length for name, length in self.weft_length.items()}

    stops = computed("1", "stops of the loom for new bobbins", lambda it: stop_count(it.bobbins, it.params.rows))
    stop_time = computed("min", "time of all stops", lambda it: stop_time(it.bobbins, it.params.rows))

    @computed("m", "room beside the cloth, at the edge that needs more")
    def side_room(self) -> float:
        made = self.carried
        if isinstance(made, Shuttle):
            return self.params.edge + made.length + BOX_END
        return self.params.edge + made.length + DRIVE

    @computed("J", "energy of a passage: what moves, from rest to its largest speed, friction and weft")
    def passage_energy(self) -> float:
        resisting = self.resisting / self.params.belt_efficiency
        once: float = 0.5 * self.axis.mass * self.passage.speed**2 + resisting * self.passage.stroke
        return (2 if self.passage.back else 1) * once

    @property
    def carrier_depth(self) -> float:
        """Size of the carrier across the shed [m]."""
        return self.carried.depth

    @property
    def carrier_width(self) -> float:
        """Size of the carrier along the warps [m]."""
        return self.carried.width

    @property
    def resisting(self) -> float:
        """Friction of the carrier and tension of its weft [N]."""
        return _friction(self.params, self.carried) + max(self.tension.values())

    @property
    def bobbins(self) -> tuple[Bobbin, ...]:
        """The bobbins in the shuttles; none where the weft comes from packages at rest."""
        return self.bobbins_for(self.params.cloth.warps, self.params.cloth.yarns)

    def bobbins_for(self, warps: int, yarns: CarpetYarnParams) -> tuple[Bobbin, ...]:
        """The bobbins in the same shuttles for a cloth of another number of warps, or of other yarns."""
        if not isinstance(self.carried, Shuttle):
            return ()
        params = replace(self.params, cloth=replace(self.params.cloth, warps=warps, yarns=yarns))
        lengths = weft_lengths(params.cloth.width, params.cloth.warp_pitch, params.cloth.carpet_yarns, params.turn)
        wound = windings(params, self.carried.bobbin, lengths)
        return tuple(Bobbin(winding.name, max(1, winding.rows), params.change_time) for winding in wound)

    @property
    def parts(self) -> tuple[BillLine, ...]:
        """Lines of the parts list."""
        return bill(self.bodies.tree)

    @property
    def price(self) -> float:
        """Price of all parts, with their axes of the control."""
        prices = read_prices(self.params.prices)
        control = prices["axis of the control"].price()
        return sum(price_of(part, prices) + (part.number * control if part.drives else 0.0) for part in self.parts)

    @property
    def time(self) -> float:
        """Time of wefts and stops for the carpet [s], in a harmonic shed that opens and closes within half a turn."""
        window = turn / 2 - 2 * math.asin(math.sqrt(self.params.open_share))
        needed = self.passage.time * turn / window if window > 0 else math.inf
        return self.params.rows * max(self.params.turn_time, needed) + self.stop_time

    @property
    def checks(self) -> tuple[Check, ...]:
        """Whether the weft can be laid."""
        made, passage, tight = self.carried, self.passage, max(self.tension.values())
        own = (
            shuttle_checks(self.params, made, passage.acceleration, tight)
            if isinstance(made, Shuttle)
            else rapier_checks(self.params, made, passage.acceleration, tight)
        )
        return (*own, _room_check(self), *_tension_checks(self), *_axis_checks(self), *_edge_checks(self.params))


def design(params: WeftParams) -> Weft:
    """The weft side for a cloth, with the carrier that the parameters name, or the best of both."""
    kinds = WEFT_CARRIERS if params.carrier == AUTO else (params.carrier,)
    made = [_with(replace(params, carrier=kind)) for kind in kinds]
    by_time = params.aim == "time"
    made.sort(key=lambda one: (one.time, one.price) if by_time else (one.price, one.time))
    index, choice = choose("carrier", [Alternative(one.params.carrier, one.checks) for one in made], params.aim)
    chosen = made[index]
    others = tuple(one for one in made if one is not chosen)
    return replace(chosen, choices=(*((choice,) if others else ()), *chosen.choices), alternatives=others)


def _with(params: WeftParams) -> Weft:
    """The weft side with the carrier of the parameters."""
    yarns = params.cloth.carpet_yarns
    lengths = weft_lengths(params.cloth.width, params.cloth.warp_pitch, yarns, params.turn)
    carried, choices = shuttle_for(params, lengths) if params.carrier == SHUTTLE else rapier_for(params)
    passage = _passage(params, carried)
    drawn = (params.cloth.width, passage.acceleration) if params.carrier == RAPIER else (0.0, 0.0)
    tension = {
        name: draw_off_tension(yarn, braked(params, yarn), passage.speed, params.wrap, *drawn)
        for name, yarn in (("straight weft", yarns.straight_weft), ("sinuous weft", yarns.sinuous_weft))
    }
    axis = _axis(params, passage, carried, _friction(params, carried) + max(tension.values()))
    bodies = WeftBodies(params, carried, passage, axis)
    return Weft(params, lengths, carried, passage, axis, bodies, tension, choices)


def _axis(params: WeftParams, passage: WeftPassage, carried: Carrier, resisting: float) -> BeltAxis:
    """The belt axis with the carriage on it; the guide of a shuttle's is as high as its belt is wide."""
    if not isinstance(carried, Shuttle):
        return belt_axis(params, passage, params.carriage_mass + carried.mass, resisting)
    row = LINEAR_GUIDES[0]
    while True:
        axis = belt_axis(params, passage, carriage_mass(params, carried, row) + carried.full, resisting)
        guide = guide_for(axis)
        if guide.height <= row.height:
            return axis
        row = guide


def _passage(params: WeftParams, carried: Carrier) -> WeftPassage:
    if isinstance(carried, Shuttle):
        stroke = params.cloth.width + 2 * params.edge + carried.length
        return WeftPassage(s_curve(stroke, params.limits), False, 0.0, params.edge + carried.length / 2)
    return WeftPassage(s_curve(reach(params), params.limits), True, params.grip_time, params.edge)


def _friction(params: WeftParams, carried: Carrier) -> float:
    """Friction of the carrier on warps or guide [N]."""
    if isinstance(carried, Shuttle):
        return friction(params, carried)
    return params.cloth.yarns.friction * carried.mass * GRAVITY


def _room_check(weft: Weft) -> Check:
    title = f"room of the {weft.params.carrier} beside the cloth"
    return at_most(title, weft.side_room, weft.params.room, "m", "assumed by this project: parameter room").with_cure(
        "set more weft.room, or weft=shuttle", CARRIAGE, AXIS
    )


def _tension_checks(weft: Weft) -> tuple[Check, ...]:
    yarns = weft.params.cloth.carpet_yarns
    source = "share of the breaking force, assumed by this project: parameter tension_share"
    breaks = {"straight weft": yarns.straight_weft.breaking_force, "sinuous weft": yarns.sinuous_weft.breaking_force}
    cure = "set a lower weft.speed, weft.acceleration or weft.brake, or a heavier weft"
    pulled = (BOBBIN,) if weft.params.carrier == SHUTTLE else (GRIPPER,)
    return tuple(
        at_most(f"tension of the {name}", tension, weft.params.tension_share * breaks[name], "N", source).with_cure(
            cure, *pulled
        )
        for name, tension in weft.tension.items()
    )


def _axis_checks(weft: Weft) -> tuple[Check, ...]:
    axis, passage, params = weft.axis, weft.passage, weft.params
    reserve = axis.drive.duty.reserve if axis.drive else 0.0
    cure, moved = "set a lower weft.acceleration or weft.speed", (CARRIAGE,)
    return (
        at_most("speed of the passage", passage.speed, params.speed, "m/s", "speed").with_cure(cure, *moved),
        at_most(
            "acceleration of the passage", passage.acceleration, params.acceleration, "m/s^2", "acceleration"
        ).with_cure(cure, *moved),
        must("belt of the axis", not math.isnan(axis.width), "pull of the teeth in mesh, widths of stock").with_cure(
            cure, AXIS
        ),
        at_least("torque of the axis' servo", reserve, 1.0, "1", "motor table, margin 1.25").with_cure(cure, MOTOR),
    )


def _edge_checks(params: WeftParams) -> tuple[Check, ...]:
    """Whether the outermost warps hold the turns of shuttles; the ends of a rapier are checked with it."""
    if params.carrier == RAPIER:
        return ()
    why = "each weft turns in the same shed: the other holds its turn, where they cross so (weaving.selvedge)"
    cure = "set weft.crossed=yes: exchange the cells of the shuttles' boxes"
    return (at_most("outermost warps that a turn releases", let_go(params), 0, "1", why).with_cure(cure, BOX),)


def let_go(params: WeftParams) -> int:
    """Outermost warps, of both wefts at both edges, that a turn lets go.

    Where the wefts cross rightly, each passes the other at its turn on the side away from that of the outermost warp.
    """
    fronts = [in_front(warp, shed) for warp in (0, params.cloth.warps - 1) for shed in (0, 1)]
    return sum(warps_let_go(front, front != params.crossed) for front in fronts)
