"""The loom's parts: what, how many, of what, how heavy, how dear."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ilmek.elements.motors import Motor, smallest_motor
from ilmek.machines.automated_loom.design import LoomDesign, frame_width
from ilmek.machines.automated_loom.energy import axes
from ilmek.machines.automated_loom.frame import FrameTask, LoomFrame, frame_for
from ilmek.machines.automated_loom.prices import PriceRates, read_prices
from ilmek.machines.warp_tension.cylinders import Cylinder, cylinders
from ilmek.timing.track import peak_acceleration, peak_speed
from ilmek.units import format_quantity, mm

STEEL = "structural steel"

PULLEY = 20 * mm
"""Radius of the pulleys of carriages and shuttle [m]: chosen."""


NOT_WEIGHED = math.nan


@dataclass(frozen=True, slots=True)
class LoomPart:
    """A line of the parts list.

    kind    by which it is priced                  mass    of one [kg]; nan: not weighed
    length  of one [m], power  of one [W]: where its price goes by them
    """

    name: str
    number: int
    what: str
    material: str
    kind: str
    mass: float = NOT_WEIGHED
    length: float = 0.0
    power: float = 0.0

    @property
    def mass_all(self) -> float:
        """Mass of all of them [kg], 0 where they are not weighed."""
        return self.number * self.mass if self.mass == self.mass else 0.0

    def price(self, prices: Mapping[str, PriceRates]) -> float:
        """Price of all of them."""
        weighed = self.mass if self.mass == self.mass else 0.0
        return self.number * prices[self.kind].price(weighed, self.length, self.power)


@dataclass(frozen=True, slots=True)
class PartsList:
    """The parts of a loom, its frame among them, and the prices they are reckoned with."""

    parts: tuple[LoomPart, ...]
    frame: LoomFrame
    prices: Mapping[str, PriceRates]

    @property
    def mass(self) -> float:
        """Mass of all parts that are weighed [kg]."""
        return sum(part.mass_all for part in self.parts)

    @property
    def price(self) -> float:
        """Price of all parts."""
        return sum(part.price(self.prices) for part in self.parts)


def parts_of_loom(loom: LoomDesign) -> PartsList:
    """The parts list. Raises LoomError where no section carries the frame, ParameterError for prices not to be read."""
    prices = read_prices(loom.params.prices)
    carried = (*_shedding(loom), *_cylinders(loom), *_beating(loom), *_heads(loom), *_shuttle(loom))
    frame = frame_for(frame_task(loom, sum(part.mass_all for part in carried)))
    lines = (
        *carried,
        LoomPart("frame", 1, f"columns {frame.column.name}, rail {frame.rail.name}", STEEL, "welded frame", frame.mass),
        LoomPart("control", 1, f"{axes(loom)} axes", "", "control"),
        LoomPart("axis of the control", axes(loom), "amplifier place, cable, switch", "", "axis of the control"),
    )
    return PartsList(lines, frame, prices)


def frame_task(loom: LoomDesign, carried: float) -> FrameTask:
    """What the frame of this loom bears, with the mass of the parts that it carries [kg]."""
    params, cylinder = loom.params, loom.warp_tension
    return FrameTask(
        width=frame_width(params),
        height=params.frame_height,
        depth=_DEPTH * params.frame_height,
        pull=cylinder.params.warps * cylinder.params.tension,
        lever=loom.tube[0] / 2,
        carried=carried,
        heads=loom.heads,
        head_mass=loom.head_mass,
        head_width=params.head_width,
        rail_spans=math.ceil(frame_width(params) / params.rail_span - 1e-9),
        sag_limit=params.rail_sag,
    )


_DEPTH = 0.3
"""Feet of the frame to the front and to the back, over its height."""


def _shedding(loom: LoomDesign) -> tuple[LoomPart, ...]:
    stack, shaft, cams = loom.shedding.stack, loom.shedding.shaft, loom.shedding
    prime, bar = (format_quantity(size, "mm") for size in (cams.cam.prime_radius, shaft.bar))
    guide = format_quantity(stack.guide_radius, "mm")
    steel = cams.params.density
    ends, steadied = shaft.seat.bearing, cams.params.spans > 1
    seat = "none of the table bears it" if ends is None else ends.name
    return (
        LoomPart("shedding cam", loom.warps, f"prime radius {prime}", STEEL, "laser-cut part", stack.cam_mass),
        LoomPart("guide cam", loom.warps, f"radius {guide}", STEEL, "laser-cut part", stack.guide_mass),
        LoomPart(
            "cam shaft", 1, f"square {bar}", STEEL, "steel bar", shaft.bar**2 * shaft.length * steel, shaft.length
        ),
        LoomPart("bearing of the cam shaft", 2, seat, "", "bearing", NOT_WEIGHED if ends is None else ends.mass),
        *((LoomPart("steady of the cam shaft", cams.params.spans - 1, "rollers", "", "bearing"),) if steadied else ()),
        *_motor("motor of the cam shaft", 1, cams.drive.motor, cams.drive.motor_torque, cams.drive.motor_speed),
        _reducer("reducer of the cam shaft", 1, cams.drive.reducer.ratio, cams.drive.motor),
    )


def _cylinders(loom: LoomDesign) -> tuple[LoomPart, ...]:
    """Upper and lower cylinder are alike, the spacer is of its own tube; a motor for each of the three [thesis 3.1]."""
    cylinder = loom.warp_tension
    upper, lower, spacer = cylinders(cylinder)
    return (
        LoomPart("cylinder", 2, _tube(upper), STEEL, "steel tube", upper.mass),
        LoomPart("spacer cylinder", 1, _tube(spacer), STEEL, "steel tube", spacer.mass),
        *(
            LoomPart(f"bearing of the {one.name}", 2, one.bearing.name, "", "bearing", one.bearing.mass)
            for one in (upper, lower, spacer)
        ),
        *_motor("motor of a cylinder", 3, cylinder.motor, cylinder.motor_torque, cylinder.motor_speed),
        _reducer("reducer of a cylinder", 3, cylinder.reducer.ratio, cylinder.motor),
    )


def _tube(one: Cylinder) -> str:
    """A cylinder's tube in words: the stock's name, or of the loom's own sizes."""
    outer, wall = (2 * one.outer, one.outer - one.inner) if one.tube is None else (one.tube.outer, one.tube.wall)
    return f"tube {format_quantity(outer, 'mm')} x {format_quantity(wall, 'mm')}"


def _beating(loom: LoomDesign) -> tuple[LoomPart, ...]:
    return (*_comb(loom), *_crank_rockers(loom))


def _comb(loom: LoomDesign) -> tuple[LoomPart, ...]:
    """The comb on the guide cams and its vertical axes."""
    if loom.hammer is None or loom.hammer.axis is None:
        return ()
    hammer, number = loom.hammer, loom.hammer.params.shared
    found, load = loom.hammer.axis.drive, loom.hammer.axis.cycle
    torque, speed = float(np.max(np.abs(load.torque))), float(np.max(np.abs(load.speed)))
    motor = found.motor if found else None
    what = f"bar {format_quantity(hammer.params.depth, 'mm')} high, a leaf between two warps"
    return (
        LoomPart("comb of the hammer", 1, what, STEEL, "laser-cut part", hammer.comb.mass),
        LoomPart("vertical axis", number, hammer.params.axis, "", "linear axis", length=hammer.params.stroke),
        *_motor("motor of a vertical axis", number, motor, torque, speed),
        *((_reducer("reducer of a vertical axis", number, found.reducer.ratio, motor),) if found else ()),
    )


def _crank_rockers(loom: LoomDesign) -> tuple[LoomPart, ...]:
    beat, number = loom.beat_up, loom.beaters
    if beat is None:
        return ()
    torque = number * beat.peaks["drive_torque"].value
    beater = number * beat.params.beater_mass
    return (
        LoomPart("comb of the beater", 1, "a leaf between two warps", STEEL, "laser-cut part", beater),
        *(
            LoomPart(
                f"{name} of the beat-up", number, format_quantity(beat.lengths[name], "mm"), STEEL, "machined link", m
            )
            for name, m in beat.masses.items()
        ),
        *_motor("motor of the beat-up", 1, smallest_motor(torque, beat.params.speed), torque, beat.params.speed),
    )


def _heads(loom: LoomDesign) -> tuple[LoomPart, ...]:
    head, wide = loom.weaver, frame_width(loom.params)
    limits, servo, torque = head.params, head.drive.servo, head.drive.torque_max
    motor = servo.motor if servo else None
    thrust = loom.head_mass * limits.carriage_acceleration
    selected = limits.tubes * limits.tube_mass * limits.selector_acceleration
    return (
        LoomPart("knotting head", loom.heads, "cams, tools, tubes, motors", "", "head mechanism", loom.head_mass),
        LoomPart("yarn tube", loom.heads * limits.tubes, "one for each colour, weighed with the head", "", "yarn tube"),
        *_with_the_head(_motor("motor of a head", loom.heads, motor, torque, head.cyclogram.speed)),
        *((_reducer("reducer of a head", loom.heads, servo.reducer.ratio, motor),) if servo else ()),
        LoomPart("rail of the heads", 1, "with a belt for each head", "", "linear axis", length=wide),
        *_axis("motor of a carriage", loom.heads, thrust, limits.carriage_speed),
        *_with_the_head(_axis("motor of the colours", loom.heads, selected, limits.selector_speed)),
    )


def _with_the_head(parts: tuple[LoomPart, ...]) -> tuple[LoomPart, ...]:
    """The same, weighed with the head that they are in."""
    return tuple(replace(part, mass=NOT_WEIGHED) for part in parts)


def _shuttle(loom: LoomDesign) -> tuple[LoomPart, ...]:
    params, row = loom.params, loom.row_cyclogram
    track = row.track("shuttle")
    thrust = params.shuttle_mass * peak_acceleration(track, row.period)
    return (
        LoomPart("shuttle", 1, "with its bobbin", "", "machined link", params.shuttle_mass),
        LoomPart("axis of the shuttle", 1, "belt drive", "", "linear axis", length=track.stroke),
        *_axis("motor of the shuttle", 1, thrust, peak_speed(track, row.period)),
    )


def _axis(name: str, number: int, thrust: float, speed: float) -> tuple[LoomPart, ...]:
    """The motor of a belt axis for a thrust [N] at a speed [m/s], on a pulley without a gear."""
    torque, turns = thrust * PULLEY, speed / PULLEY
    return _motor(name, number, smallest_motor(torque, turns), torque, turns)


def _motor(name: str, number: int, motor: Motor | None, torque: float, speed: float) -> tuple[LoomPart, ...]:
    """A motor of the catalogue; where none is enough, one made to measure, priced as a servo by its power."""
    if motor is not None:
        return (LoomPart(name, number, motor.name, "", motor.kind, motor.mass, power=motor.power),)
    said = f"to measure: {format_quantity(torque, 'Nm', 3)} at {format_quantity(speed, 'rpm', 3)}"
    return (LoomPart(name, number, said, "", "servo", power=torque * speed),)


def _reducer(name: str, number: int, ratio: float, motor: Motor | None) -> LoomPart:
    return LoomPart(name, number, f"{ratio:g}:1", "", "reducer", power=motor.power if motor else 0.0)
