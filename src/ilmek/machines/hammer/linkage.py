"""Crank-rockers across the width that are as strong as needed: number, speed, ballast and links at least price.

    F = m a,   a = c W^2   at the beat;   m = max(comb, F / (c W^2)),   ballast = m - comb

c is the acceleration of the beater at the beat for a crank speed of 1 rad/s. For each number of crank-rockers and each
speed the mass follows from the force that the rows need; links and pins of stock from the greatest loads, which go with
m W^2; then the price is estimated. In that order they are designed in full until the checks of one hold. The comb's
weight is taken to be balanced by springs: the paper leaves weight out.

The comb also bears its own inertia: between supports s apart, with s / 2 beyond the last ones, the greatest moment of
q = m a / L is q s^2 / 8, that of the overhang.                                                        [theory of beams]
"""

import heapq
import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from itertools import islice

from ilmek.elements.duty import MARGIN
from ilmek.elements.materials import Material
from ilmek.elements.motors import MOTORS, SERVO
from ilmek.elements.prices import PRICES, piece_price
from ilmek.machines import beat_up
from ilmek.machines.beat_up.beam import BeatBeam, beam_for
from ilmek.machines.beat_up.beater import across, rectangle
from ilmek.machines.beat_up.carriage import shared_checks
from ilmek.machines.beat_up.crank_start import (
    CLUTCH_MASS,
    CLUTCHES,
    FLYWHEEL_RADIUS,
    CrankDuty,
    CrankStart,
    crank_start,
    start_checks,
)
from ilmek.machines.beat_up.links import PART_IDS
from ilmek.machines.beat_up.strength import POINTS, BeatUpStrength, Duty, beat_up_strength_checks, frame_force
from ilmek.machines.beat_up.travel import force_at_beat
from ilmek.machines.beat_up.use_params import TravelParams
from ilmek.machines.hammer.comb import BAR_ID, comb_mass, with_depth
from ilmek.machines.hammer.params import MOST_BALLAST, MOST_BEATERS, HammerParams
from ilmek.machines.link_tree import GAP
from ilmek.machines.linkage_strength import FLAT_BARS, linkage_strength, pins_bear, strength_checks
from ilmek.part.bill import line_of
from ilmek.part.flat_link import flat_link
from ilmek.part.part import Part
from ilmek.records import computed, group, record, result
from ilmek.report import Alternative, Check, Choice, at_least, at_most, choose
from ilmek.units import format_quantity, turn
from ilmek.weaving.fell import Fabric

SPEEDS = (8.0, 10.0, 12.5, 15.5, 20.0, 25.0, 31.5, 40.0)
"""Speeds of the crank to choose from [rad/s]; 15.5 is the paper's."""

MORE_BEATERS = 2
"""Numbers of crank-rockers that are compared, from the least on."""

_DESIGNED = 4
_RESERVE = 1.001


@record
class CombLinkage:
    """Crank-rockers that share the comb, all alike: `one` of them. limit: strength of the comb [Pa]."""

    one: beat_up.BeatUp
    limit: float
    number: int = result("1", "crank-rockers that share the comb", name="beaters", least=0.0)
    ballast: float = result("kg", "mass added to the comb, for the force of the beat")
    force: float = result("N", "force of all at the beat, by the comb's inertia", name="linkage_force")
    energy: float = result("J", "kinetic energy of the comb at its largest speed", name="swing_energy")
    speed_needed: float | None = result(
        "rad/s", "speed of the crank that the required rows need with this comb", absent="no speed is enough"
    )
    inertia_stress: float = result("MPa", "stress of the comb by its own inertia at the beat")
    strength: BeatUpStrength = group()
    start: CrankStart = group()
    beam: BeatBeam = group()

    transmission_angle_min = computed(
        "deg", "least transmission angle of the crank-rockers", lambda it: it.one.transmission_angle_min
    )
    torque = computed(
        "Nm",
        "largest torque on their crank shaft, at constant speed",
        lambda it: it.number * it.one.drive_torque_max,
        name="linkage_torque",
    )
    beat_speed = computed("rad/s", "speed of the crank", lambda it: it.one.params.speed)

    @computed("N", "greatest force of all crank-rockers on the frame, on an empty beat")
    def frame_force(self) -> float:
        return self.number * frame_force(self.one.state)


def linkage_checks(linkage: CombLinkage) -> tuple[Check, ...]:
    """Whether comb, links, pins and motor bear the beat."""
    cure = "set more beaters, or a deeper comb"
    return (
        at_most(
            "stress of the comb by its inertia", linkage.inertia_stress, linkage.limit, "MPa", "strength"
        ).with_cure(cure, BAR_ID),
        at_least(
            "end of the rocker in front of the comb's bar",
            linkage.one.lengths["beater"] - linkage.one.lengths["rocker"] - linkage.one.params.width / 2,
            linkage.one.params.travel.bar_distance,
            "mm",
            "from the warps: leaf_reach and comb_thickness",
        ).with_cure("set a smaller hammer.leaf_reach, or narrower links", PART_IDS["rocker"], BAR_ID),
        *beat_up_strength_checks(linkage.strength),
        *start_checks(linkage.start),
        *shared_checks(linkage.one, linkage.start.start_torque, linkage.number),
        *linkage.beam.checks,
    )


@lru_cache(maxsize=16)
def chosen_linkage(
    params: HammerParams, fabric: Fabric, needed: float
) -> tuple[HammerParams, CombLinkage, tuple[Choice, ...]]:
    """The crank-rockers for a force of a warp [N], the parameters with what was chosen, and the choice.

    Raises MechanismError where the crank-rockers do not move.
    """
    options = tuple(_options(params, fabric, needed))
    made: list[tuple[HammerParams, CombLinkage]] = []
    candidates: list[Alternative] = []
    for option in islice(_ranked(options, fabric, needed), _DESIGNED):
        made.append((option, linkage_for(option, fabric, needed)))
        candidates.append(Alternative(_named(option), linkage_checks(made[-1][1])))
        if not candidates[-1].failed:
            break
    index, choice = choose("crank-rockers", candidates)
    option, linkage = made[index]
    found = (choice,) if len(options) > 1 else ()
    return option, linkage, (*found, *linkage.strength.choices, *linkage.start.choices)


def _named(params: HammerParams) -> str:
    speed = format_quantity(params.beat_speed or 0.0, "rad/s", 3)
    return f"{params.rockers} at {speed}, ballast {format_quantity(params.ballast or 0.0, 'kg', 3)}"


def _ranked(options: tuple[tuple[HammerParams, float], ...], fabric: Fabric, needed: float) -> Iterator[HammerParams]:
    """The options with their links: those strong enough first, in ascending order of their estimated price.

    The price with the lightest links offered is a lower bound: stronger links are looked for in ascending order of it,
    so that options that are not reached need none.
    """
    queue: list[tuple[bool, float, int, float | None, HammerParams]] = []
    for index, (option, load) in enumerate(options):
        width, thickness = min(_offered(option), key=math.prod)
        lightest = replace(option, link_width=width, link_thickness=thickness)
        queue.append((False, _estimated(lightest, fabric, needed), index, load, option))
    heapq.heapify(queue)
    while queue:
        _, _, index, unsettled, option = heapq.heappop(queue)
        if unsettled is None:
            yield option
            continue
        option, enough = _with_links(option, unsettled)
        heapq.heappush(queue, (not enough, _estimated(option, fabric, needed), index, None, option))


def _options(params: HammerParams, fabric: Fabric, needed: float) -> Iterator[tuple[HammerParams, float]]:
    """Each number of crank-rockers and speed, with ballast, and the share of the comb of each crank-rocker [kg]."""
    acceleration = force_at_beat(_unit(params.ground, params.swing))
    most = params.rockers if params.beaters else min(params.rockers + MORE_BEATERS - 1, MOST_BEATERS)
    for number in range(params.rockers, most + 1):
        shared = with_depth(replace(params, beaters=number), fabric, params.force or needed)
        comb = comb_mass(shared)
        for speed in (params.beat_speed,) if params.beat_speed else SPEEDS:
            mass = _RESERVE * (params.force or needed) * params.cloth.warps / (acceleration * speed**2)
            ballast = min(max(mass - comb, 0.0), MOST_BALLAST) if params.ballast is None else params.ballast
            yield replace(shared, beat_speed=speed, ballast=ballast), (comb + ballast) / number


def _with_links(params: HammerParams, share: float) -> tuple[HammerParams, bool]:
    """The parameters with the first section whose links and pins bear a share of the comb [kg], and whether one does.

    Where none does, the largest.
    """
    speed = params.beat_speed or 1.0
    unit, enough = _unit(params.ground, params.swing), False
    of_unit, lengths = unit.loads, unit.lengths
    for width, thickness in _offered(params):
        links = width * thickness * params.links.of_links.density
        # The links' own inertia counts as that of their whole mass at the beater.
        own = links * (lengths["coupler"] + lengths["beater"])
        loads = of_unit.scaled(share + own, speed, turn / speed / (params.turn_time / 2))
        sections = dict.fromkeys(POINTS, (width, thickness))
        if not pins_bear(loads, params.links, sections):
            continue
        enough = all(check.ok for check in strength_checks(linkage_strength(loads, params.links, sections)))
        if enough:
            break
    return replace(params, link_width=width, link_thickness=thickness), enough


def _offered(params: HammerParams) -> tuple[tuple[float, float], ...]:
    """Widths and thicknesses of the links to choose from [m]: of stock, or the given one."""
    if not params.link_width and not params.link_thickness:
        return FLAT_BARS
    width = params.link_width or (params.link_thickness or 0.0) * 3
    return ((width, params.link_thickness or width / 3),)


@lru_cache(maxsize=32)
def _unit(ground: float, swing: float | None) -> beat_up.BeatUp:
    """The crank-rocker with a beater of 1 kg at 1 rad/s, its links almost without mass."""
    light = beat_up.BeatUpParams(ground=ground, swing=swing, speed=1.0, beater_mass=1.0, link_mass="bars", density=1e-3)
    return beat_up.design(light)


def _estimated(params: HammerParams, fabric: Fabric, needed: float) -> float:
    """Price of what differs between the options, roughly: comb, ballast, links, and the cheaper of both starts."""
    speed, number = params.beat_speed or 1.0, params.rockers
    unit, steel = _unit(params.ground, params.swing), PRICES["structural steel"]
    comb, ballast = comb_mass(params), params.ballast or 0.0
    section = params.link_width or 0.0, params.link_thickness or 0.0, params.links.of_links
    links = sum(_of_link(unit.lengths[name], *section) for name in ("crank", "coupler", "beater"))
    swing = (comb + ballast) * (unit.beater_velocity_max * speed) ** 2 / 2
    work = 2.5 * swing + fabric.energy(params.force or needed) * params.cloth.warps
    torque = unit.drive_torque_max * (comb + ballast) * speed**2 / params.start.efficiency
    wheel = work / (params.start.speed_drop * speed**2 * FLYWHEEL_RADIUS**2)
    clutch = PRICES["clutch and brake"].price(CLUTCH_MASS * torque) + steel.price(wheel) + 200.0
    powers = [
        motor.power for motor in MOTORS if motor.kind == SERVO and motor.peak * motor.speed / speed >= MARGIN * torque
    ]
    servo = PRICES["servo"].price(power=min(powers)) + 300.0 if powers else math.inf
    if torque > CLUTCHES[-1]:
        clutch = math.inf
    return steel.price(comb + ballast) + number * links + min(clutch, servo)


@lru_cache(maxsize=64)
def _of_link(length: float, width: float, thickness: float, material: Material) -> float:
    """Price of a link of a length, width and thickness [m] as one of a batch, without bores."""
    link = Part("link", "link", "machined link", shape=flat_link(length, width, thickness), material=material)
    return piece_price(line_of(link), PRICES)


def linkage_for(params: HammerParams, fabric: Fabric, needed: float) -> CombLinkage:
    """The crank-rockers of given speed, ballast and links; needed: force of a warp that the required rows need [N]."""
    number, speed, ballast = params.rockers, params.beat_speed or 1.0, params.ballast or 0.0
    links = beat_up.BeatUpParams(
        ground=params.ground,
        swing=params.swing,
        speed=speed,
        beat_force=0.0,
        width=params.link_width or FLAT_BARS[0][0],
        thickness=params.link_thickness or FLAT_BARS[0][1],
        strength=params.links,
        travel=TravelParams(bar_distance=params.reach + params.comb_thickness),
    )
    mass = comb_mass(params) + ballast + number * bracket(links, params).mass
    one = beat_up.design(replace(links, beater_mass=mass / number), Duty(params.turn_time / 2, "links"))
    force = number * force_at_beat(one)
    asked = min(params.force or needed, force / params.cloth.warps)
    duty = CrankDuty(one, number, fabric, params.cloth.warps, asked, every=params.turn_time / 2)
    moment = force / params.cloth.width * (params.cloth.width / number) ** 2 / 8
    return CombLinkage(
        one=one,
        limit=params.strength,
        number=number,
        ballast=ballast,
        force=force,
        energy=mass * one.beater_velocity_max**2 / 2,
        # Without weight every force grows with the square of the speed.
        speed_needed=speed * math.sqrt(needed * params.cloth.warps / force) if force else None,
        inertia_stress=6 * moment / (params.comb_thickness * params.depth**2),
        strength=one.strength,
        start=crank_start(duty, params.start),
        beam=beam_for(params.beam_reach, mass + number * _links_mass(one), number * frame_force(one.state)),
    )


def _links_mass(one: beat_up.BeatUp) -> float:
    """Mass of the links and pins of a crank-rocker, without the comb [kg]."""
    return math.fsum(body.mass for body in one.bodies.values()) - one.params.beater_mass


def bracket(links: beat_up.BeatUpParams, params: HammerParams) -> Part:
    """A plate beside a rocker, in the side view from the comb's bar along the rocker, from z = 0."""
    front, half = params.reach + params.comb_thickness, links.width / 2
    corners = rectangle(front, front + 2 * links.width, -half, half)
    plate = across("hammer/bracket", "bracket of the comb", "laser-cut part", corners, GAP * links.thickness)
    return replace(plate, fixing="welded to the bar of the comb by fillets a3, screwed to its rocker")
