"""What the design of shedding cams chose of what was left open, which check decided, and what the next cheaper failed.

Of several shafts the choices are those of the one with the largest torque.
"""

from dataclasses import replace

from ilmek.elements import bearings, shafts
from ilmek.elements.bearing_table import INSERT, RollingBearing
from ilmek.elements.motors import MOTORS
from ilmek.elements.shoulders import LEAST_SAFETY
from ilmek.machines.shedding.cam_shaft import CamShaft
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.report import Check, Choice, at_least, at_most, failing
from ilmek.units import format_quantity, turn

CHEAPEST = "price"


def choices(design: SheddingDesign) -> tuple[Choice, ...]:
    """Shafts and guides, prime radius, bar, bearing and motor, where they were left open."""
    params, index = design.params, max(range(len(design.shafts)), key=lambda at: _torque(design.shafts[at]))
    one = design.shafts[index]
    of_one = (
        *((_bar(one),) if params.shaft_bar is None else ()),
        *((_bearing(one),) if params.bearing is None else ()),
        *((_motor(one),) if one.drive.motor else ()),
    )
    named = tuple(replace(each, name=f"{each.name} of shaft {index + 1}") for each in of_one)
    return (
        *((design.choice,) if design.choice else ()),
        *((_prime(design.first),) if params.prime_radius is None else ()),
        *(named if len(design.shafts) > 1 else of_one),
    )


def _torque(shaft: CamShaft) -> float:
    return shaft.drive.torque_max.value


def _prime(shaft: CamShaft) -> Choice:
    """The prime radius: by the pressure angle, or by the bore; smaller ones fail it."""
    prime, bore = shaft.cam.prime_radius, shaft.prime_radius_for_bore
    chosen, least = format_quantity(prime, "mm"), shaft.smallest_prime.value
    if prime > least:
        below = at_least("prime radius round the bore", least, bore, "mm", "bore_wall")
        return Choice("prime_radius", chosen, below.name, format_quantity(least, "mm"), failing(below))
    return Choice("prime_radius", chosen, "pressure angle", "any smaller", "")


def _bar(one: CamShaft) -> Choice:
    shaft = one.shaft
    sides = {
        "slope of the shaft": shaft.side_slope,
        "deflection of the shaft": shaft.side_deflection,
        "twist of the shaft": shaft.side_twist,
        "stress of the shaft": shaft.side_strength,
    }
    name, chosen = "shaft_bar", format_quantity(shaft.bar, "mm")
    smaller = [side for side in shafts.STOCK_SIDES if side < shaft.bar]
    if not smaller:
        return Choice(name, chosen, CHEAPEST)
    decided, least = max(sides.items(), key=lambda item: item[1])
    if least <= smaller[-1]:
        return Choice(name, chosen, "fatigue of the shaft", format_quantity(smaller[-1], "mm"), "safety below 1")
    failed = at_least(decided, smaller[-1], least, "mm", "side of the bar")
    return Choice(name, chosen, decided, format_quantity(smaller[-1], "mm"), failing(failed))


def _bearing(shaft: CamShaft) -> Choice:
    """The lightest insert bearing with life and bore; the next lighter one fails one of them."""
    seat = shaft.shaft.seat
    lighter = [
        each
        for each in bearings.ROLLING_BEARINGS.values()
        if each.kind == INSERT and (each.mass, each.bore) < (seat.bearing.mass, seat.bearing.bore)
    ]
    if not lighter:
        return Choice("bearing", seat.bearing.name, CHEAPEST)
    cheaper = max(lighter, key=lambda each: (each.mass, each.bore))
    check = next((check for check in _bearing_checks(shaft, cheaper) if not check.ok), None)
    if check is None:
        return Choice("bearing", seat.bearing.name, "no bearing of the table keeps every limit", cheaper.name)
    return Choice("bearing", seat.bearing.name, check.name, cheaper.name, failing(check))


def _bearing_checks(shaft: CamShaft, bearing: RollingBearing) -> tuple[Check, ...]:
    seat, params = shaft.shaft.seat, shaft.params
    load = bearings.equivalent_load(bearing, seat.reaction)
    life = bearings.life(bearing.dynamic, load, bearing.kind) * turn / params.speed
    static = bearings.static_load(bearing, seat.reaction)
    return (
        at_least("life of the bearings", life, params.bearing_life, "h", "ISO 281"),
        at_least("bore of the bearing for the torque", bearing.bore, seat.journal, "mm", "torsion"),
        at_least(
            "fatigue of the driven journal at its shoulder",
            replace(seat.shoulder, journal=bearing.bore).safety,
            LEAST_SAFETY,
            "1",
            "DIN 743-2",
        ),
        at_least("static load of the bearings", bearing.static, static, "N", "ISO 76"),
        at_most("bore of the bearing in the bar", bearing.bore, shaft.shaft.bar, "mm", "journal"),
    )


def _motor(shaft: CamShaft) -> Choice:
    """The motor of least power; the next smaller one fails by its torque or its speed."""
    drive = shaft.drive
    assert drive.motor is not None
    smaller = [motor for motor in MOTORS if motor.power < drive.motor.power]
    if not smaller:
        return Choice("motor", drive.motor.name, CHEAPEST)
    cheaper = max(smaller, key=lambda motor: motor.power)
    judged = (
        at_least("motor torque", cheaper.torque, drive.motor_torque, "Nm", "continuous torque"),
        at_least("motor speed", cheaper.speed, drive.motor_speed, "rpm", "rated speed"),
    )
    check = next((check for check in judged if not check.ok), None)
    if check is None:
        return Choice("motor", drive.motor.name, "no motor of the table is enough", cheaper.name)
    return Choice("motor", drive.motor.name, check.name, cheaper.name, failing(check))
