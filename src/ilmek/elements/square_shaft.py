"""A square shaft on equal spans: load, least sides, chosen bar, bearings.

    w = safety |weight + pull e^(i angle)| / l,   span = l / spans

Weight and transverse pull have different directions. A square bar has equal stiffness in all directions, so that slopes
and deflections add as vectors and do not depend on the angle of the shaft. Supports between the ends are bearings, or
steadies: rollers under round seats of the shaft.
Each span is computed as simply supported, which is conservative for a shaft that is continuous over its supports. A
bearing carries w span, at the ends half of it, without the safety.                  [thesis 3.2, eq. 3.4, 3.5; ISO 281]
"""

import cmath
import math

from ilmek.elements import bearings, shafts
from ilmek.elements.beam import uniform
from ilmek.elements.bearing_table import INSERT, RollingBearing
from ilmek.elements.fatigue import Loading, endurance_limit, goodman
from ilmek.elements.locknuts import locknut_for
from ilmek.elements.materials import GRAVITY
from ilmek.elements.parallel_keys import keyed_end
from ilmek.elements.sections import square_section
from ilmek.elements.shoulders import LEAST_SAFETY, Shoulder
from ilmek.elements.whirl import uniform_speed
from ilmek.records import computed, group, record, result
from ilmek.report import Json
from ilmek.units import mm, turn


@record
class SquareShaftTask:
    """Loads and limits of a square shaft.

    length, spans   of the shaft [m], and its number of equal spans         speed   of the shaft [rad/s]
    mass, pull      on the shaft evenly, its own included [kg]; force across it [N]
    pull_angle      of the pull from the weight [rad]                       torque  greatest on it [N m]
    load            per length [N/m] in place of mass and pull; None: by these
    safety          factor on the load; None: 1 on a given load, 2 on a computed one
    modulus, strength, tensile  Young's modulus, yield and tensile strength [Pa]
    slope, deflection, twist    allowed [rad, m, rad]
    bar             side of the bar [m]; None: the smallest of stock that keeps the limits, else the largest
    bearing         by designation; None: the lightest with the required `bearing_life` [s], else the strongest
    """

    length: float
    spans: int
    speed: float
    mass: float
    pull: float
    pull_angle: float
    torque: float
    load: float | None
    safety: float | None
    modulus: float
    strength: float
    tensile: float
    slope: float
    deflection: float
    twist: float
    bar: float | None
    bearing: str | None
    bearing_life: float


@record
class ShaftLoads:
    """Loads of the shaft by weight and by pull, each in its own direction, with the safety.

    weight, pull  loads [N/m]; the shaft's slope [rad] and deflection [m] are split in their ratio
    angle         of the pull from the weight [rad]
    """

    weight: float
    pull: float
    angle: float

    def shares(self) -> tuple[float, float]:
        """Weight and pull over their resultant; 0 without load."""
        whole = abs(self.resultant)
        return (self.weight / whole, self.pull / whole) if whole > 0 else (0.0, 0.0)

    @property
    def resultant(self) -> complex:
        """Load [N/m], the weight along the real axis."""
        return self.weight + self.pull * cmath.exp(1j * self.angle)


@record
class ShaftBearings:
    """The bearings of the shaft.

    bearing   the one chosen      life  of it [s], 90 % of them reach it
    shoulder  of the driven journal in it, under the load without the safety
    """

    reaction: float = result("N", "load of the most loaded bearing, without the safety", name="bearing_load")
    journal: float = result("mm", "least diameter of the journal, in torsion", least=0.0)
    bearing: RollingBearing
    life: float
    shoulder: Shoulder

    journal_stress = computed(
        "MPa", "stress of the driven journal [von Mises], without the safety", lambda it: it.shoulder.stress
    )
    journal_endurance = computed("1", "safety of its shoulder against fatigue", lambda it: it.shoulder.safety)
    name = computed("", "bearing of the shaft", lambda it: it.bearing.name, name="bearing")
    life_of_bearing = computed("h", "rating life", lambda it: it.life, name="bearing_life")


@record
class SquareShaft:
    """The square shaft; `torque`: the largest, with the safety [N m]; `loads`: None for a given load."""

    load: float = result("kN/m", "load of the shaft, with its safety", name="shaft_load")
    length: float = result(
        "m", "length of the shaft between its first and last support", name="shaft_length", least=0.0
    )
    span: float = result("m", "distance of two supports", name="shaft_span", least=0.0)
    torque: float
    side_slope: float = result("mm", "least side of the shaft for the slope", name="shaft_side_slope")
    side_deflection: float = result("mm", "least side of the shaft for the deflection", name="shaft_side_deflection")
    side_twist: float = result("mm", "least side of the shaft for the twist", name="shaft_side_twist")
    side_strength: float = result("mm", "least side of the shaft for its strength", name="shaft_side_strength")
    bar: float = result("mm", "side of the bar chosen: as given, or from stock", name="shaft_bar", least=0.0)
    slope: float = result("rad", "slope of the shaft at the supports", name="shaft_slope")
    deflection: float = result("mm", "deflection of the shaft between the supports", name="shaft_deflection")
    twist: float = result("deg", "twist from end to end by the largest torque, without the safety", name="shaft_twist")
    stress: float = result("MPa", "stress in bending and torsion [von Mises], with the safety", name="shaft_stress")
    endurance: float = result("1", "safety against fatigue [Goodman], besides that of the load", name="shaft_endurance")
    critical: float = result("rpm", "lowest critical speed of a span with its cams", name="shaft_critical_speed")
    directions: ShaftLoads | None
    seat: ShaftBearings = group()

    side = computed(
        "mm",
        "least side of the shaft for slope and deflection",
        lambda it: max(it.side_slope, it.side_deflection),
        name="shaft_side",
    )

    @computed("", "weight and pull apart, with the safety [N/m, m, rad]", absent="the load is given")
    def shaft_directions(self) -> Json:
        if self.directions is None:
            return None
        weight, pull = self.directions.shares()
        shares = {"weight": (weight, self.directions.weight), "pull": (pull, self.directions.pull)}
        return {
            "angle": cmath.phase(self.directions.resultant),
            **{
                name: {"load": load, "slope": share * self.slope, "deflection": share * self.deflection}
                for name, (share, load) in shares.items()
            },
        }


def square_shaft(task: SquareShaftTask) -> SquareShaft:
    """The shaft for a task. Raises ParameterError for a bearing that is not in the table."""
    length, modulus, torque = task.length, task.modulus, task.torque
    load, safety, directions = task.load, task.safety or 1.0, None
    if load is None:
        safety = task.safety or 2.0
        directions = ShaftLoads(safety * task.mass * GRAVITY / length, safety * task.pull / length, task.pull_angle)
        load = abs(directions.resultant) / safety
    load, span = load * safety, length / task.spans
    moment = float(uniform.moment_max(load, span))
    by_slope = shafts.square_side(shafts.inertia_for_slope(load, span, modulus, task.slope))
    by_deflection = shafts.square_side(shafts.inertia_for_deflection(load, span, modulus, task.deflection))
    by_twist = shafts.side_for_twist(torque, length, modulus, task.twist)
    by_strength = shafts.side_for_strength(moment, safety * torque, task.strength)
    least = max(by_slope, by_deflection, by_twist, by_strength)
    bar = task.bar or _bar(least)
    while task.bar is None and bar < shafts.STOCK_SIDES[-1] and _endurance(task, moment, safety * torque, bar) < 1:
        bar = _bar(bar + _STEP)
    inertia = float(uniform.square_inertia(bar))
    return SquareShaft(
        load=load,
        length=length,
        span=span,
        torque=safety * torque,
        side_slope=by_slope,
        side_deflection=by_deflection,
        side_twist=by_twist,
        side_strength=by_strength,
        bar=bar,
        slope=float(uniform.slope_max(load, span, modulus, inertia)),
        deflection=float(uniform.deflection_max(load, span, modulus, inertia)),
        twist=shafts.square_twist(torque, length, modulus, bar),
        stress=shafts.square_stress(moment, safety * torque, bar),
        endurance=_endurance(task, moment, safety * torque, bar),
        critical=uniform_speed(1, "hinged", span, modulus * inertia, task.mass / length),
        directions=directions,
        seat=seat_for(task, load * span, safety, bar),
    )


def _endurance(task: SquareShaftTask, moment: float, torque: float, bar: float) -> float:
    """Safety of the hot rolled bar against fatigue: the load is fixed, the bar rotates; the torque alternates."""
    section = square_section(bar)
    limit = endurance_limit(task.tensile, section.size, "hot-rolled")
    return goodman(Loading(moment, 0.0, torque_amplitude=torque), section, endurance=limit, tensile=task.tensile)


def seat_for(task: SquareShaftTask, span_load: float, safety: float, bar: float) -> ShaftBearings:
    """Bearings for the load of a span [N], its safety included, on journals turned from the bar [m].

    A journal in torsion alone: d = (16 sqrt(3) T / (pi sigma))^(1/3), von Mises; its shoulder at the bearing's side
    bears half of a span's load too, and must have the safety of DIN 743 against fatigue; beyond the bearing its key
    must bear the torque. A support between the ends carries a whole span, an end half of one; the bearings of the
    steadies are taken no larger than those of the ends.
    Where no insert bearing that fits the bar has the life and the bore, the strongest that fits the bar is taken.
    """
    torque, loaded = safety * task.torque, span_load / safety
    reaction = loaded if task.spans > 1 else loaded / 2
    journal = float((16 * math.sqrt(3) * torque / (math.pi * task.strength)) ** (1 / 3))

    def shoulder(row: RollingBearing) -> Shoulder:
        return Shoulder(bar, row.bore, task.tensile, loaded / 2 * row.width / 2, task.torque)

    def bears(row: RollingBearing) -> bool:
        key = keyed_end(row.bore, torque, task.strength)
        return row.bore >= journal and shoulder(row).safety >= LEAST_SAFETY and key.pressure <= key.allowed

    revolutions = task.bearing_life * task.speed / turn
    if task.bearing is None:
        bore = min((row.bore for row in _inserts() if bears(row)), default=journal)
        found = bearings.smallest_bearing(reaction, revolutions, kind=INSERT, bore=bore)
        bearing = found if found is not None and found.bore <= _passing(bar) else _strongest(bar)
    else:
        bearing = bearings.find_bearing(task.bearing)
    lives = bearings.life(bearing.dynamic, bearings.equivalent_load(bearing, reaction), bearing.kind)
    return ShaftBearings(reaction, journal, bearing, lives * turn / task.speed, shoulder(bearing))


LEAST_BAR = 28 * mm
"""The smallest bar with a thread whose nut passes over the journal of the smallest insert bearing [m]."""


def _passing(bar: float) -> float:
    """Largest journal over which the nut on a bar's end passes [m]."""
    return locknut_for(bar, math.inf).core


_STEP = 1e-3
"""Smaller than the step between two stock bars [m]."""


def _bar(least: float) -> float:
    """The smallest stock bar that is not below a side; the largest of stock beyond it [m]."""
    return shafts.stock_side(max(least, LEAST_BAR)) or shafts.STOCK_SIDES[-1]


def _strongest(bar: float) -> RollingBearing:
    """The insert bearing of greatest load rating that fits a bar [m]; the smallest bore where none fits."""
    fitting = [insert for insert in _inserts() if insert.bore <= _passing(bar)]
    return max(fitting, key=lambda one: one.dynamic) if fitting else min(_inserts(), key=lambda one: one.bore)


def _inserts() -> list[RollingBearing]:
    return [bearing for bearing in bearings.ROLLING_BEARINGS.values() if bearing.kind == INSERT]
