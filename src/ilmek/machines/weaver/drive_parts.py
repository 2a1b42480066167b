"""The drive of a head's cam shaft, motor, angle reducer and belt, and the motors of the colours.

The motor stands upright in front of the case, below the bracket, on a plate at the left side plate. The reducer's
output is across, with the belt's small pulley, so that motor and reducer are within the head's width.
"""

from collections.abc import Iterator

from ilmek.elements.belts import belt_length
from ilmek.elements.plates import round_bore
from ilmek.machines.weaver.cam_belt import PROFILE, SMALL
from ilmek.machines.weaver.case import ALUMINIUM
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import AXLE, RAIL_AXIS
from ilmek.machines.weaver.hub_keys import OUTPUT, SMALL_KEY, hub_diameter, small_key
from ilmek.machines.weaver.outlines import hull_of_circles
from ilmek.machines.weaver.parts import MOTOR
from ilmek.machines.weaver.selector import selector_of
from ilmek.machines.weaver.stations import belt_station
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.machines.weaver.widths import case_width
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part
from ilmek.part.placement import ALONG_WIDTH, IN_SIDE_VIEW, UPRIGHT, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, box
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import keyed_bore
from ilmek.units import in_mm, mm

COLOUR_MOTOR, TIER_MOTOR = part_id("colour-motor"), part_id("tier-motor")
CAM_BELT, CAM_PULLEY, SMALL_PULLEY = part_id("cam-belt"), part_id("cam-pulley"), part_id("small-pulley")
"""Ids of the parts."""

MOTOR_PLATE, UNDER_BRACKET = 6 * mm, 3 * mm
"""Thickness of the motor's plate, and room under the bracket [m]; assumed by this project."""

BACK, ON_PULLEY = 1.5 * mm, 0.05 * mm
"""A belt outside of its pitch line, and its room on a pulley's teeth [m]: it is drawn without its own."""

PLAY, SET_SCREW_HUB = 0.5 * mm, 6 * mm
"""From the reducer to the small pulley, and length of the hub beyond its teeth, for its set screw [m]; assumed."""

BEFORE_BELT = PLAY + catalogue.RIM + catalogue.BESIDE
"""From the reducer to the belt [m]."""


def _face(weaver: Weaver) -> float:
    """Side of the larger of motor and reducer [m]."""
    servo = weaver.drive.servo
    return catalogue.reducer_face(servo.reducer, servo.motor) if servo else catalogue.SPECIAL_FACE


def reducer_at(weaver: Weaver) -> complex:
    """The output's axis in the side view [m]: in front of the case, under the bracket."""
    shape, face = weaver.shape, _face(weaver)
    high = max(weaver.belt.radii[1] + BACK, catalogue.REDUCER_LENGTH * face / 2)
    front = (shape.body + shape.size).real + MOTOR_PLATE + face / 2
    return complex(front, shape.rail - RAIL_AXIS / 2 - UNDER_BRACKET - high)


def drive_front(weaver: Weaver) -> float:
    """The foremost x of motor and reducer [m]."""
    return reducer_at(weaver).real + _face(weaver) / 2


def drive_top(weaver: Weaver) -> float:
    """The uppermost y of the reducer [m]."""
    return reducer_at(weaver).imag + catalogue.REDUCER_LENGTH * _face(weaver) / 2


def reducer_left(weaver: Weaver) -> float:
    """The x of the reducer's left side, beside the belt [m]."""
    return belt_station(weaver) - BEFORE_BELT - _face(weaver)


def shaft_pulley(weaver: Weaver) -> Occurrence:
    """The large pulley on the cam shaft, about its axis, z to the weaver's left."""
    belt, (bore,) = weaver.belt, round_bore(weaver.params.shaft).cutouts
    title = "pulley of the cam shaft"
    part = catalogue.toothed_pulley(CAM_PULLEY, title, PROFILE, belt.large, belt.width, bore, flanged=False)
    return Occurrence(part, (placement(z=-belt_station(weaver) - belt.width),))


def cam_drive(weaver: Weaver) -> Iterator[Occurrence]:
    """Motor, reducer, its plate, the small pulley on the output, and the belt."""
    shape, at, face, begin = weaver.shape, reducer_at(weaver), _face(weaver), belt_station(weaver)
    servo, drive = weaver.drive.servo, weaver.drive
    motor = servo.motor if servo else None
    long, middle = catalogue.REDUCER_LENGTH * face, reducer_left(weaver) + face / 2
    low = at.imag - long / 2
    key = small_key(weaver)
    if servo is not None:
        across = placement(0.0, face / 2, long / 2).after(UPRIGHT)
        output = OUTPUT, Sum((Placed(_output(weaver), (across,)),))
        title = "angle reducer of a head"
        geared = catalogue.reducer(part_id("reducer"), title, servo.reducer, motor, output=output)
        yield Occurrence(geared, (placement(middle, low, at.real).after(UPRIGHT),))
    part = catalogue.motor(MOTOR, "motor of a head", motor, drive.torque_max, weaver.cyclogram.speed, rear=True)
    yield Occurrence(part, (placement(middle, low if servo else low + long, at.real).after(UPRIGHT),))
    on_output = placement(begin - catalogue.BESIDE, at.imag, at.real).after(ALONG_WIDTH)
    bore, hub = keyed_bore(OUTPUT / 2, key.keyway.width, key.keyway.in_hub, key.number), hub_diameter(OUTPUT)
    title, width = "small pulley of the cam belt", weaver.belt.width
    own = catalogue.toothed_pulley(SMALL_PULLEY, title, PROFILE, SMALL, width, bore, (hub, SET_SCREW_HUB))
    yield Occurrence(own, (on_output,))
    yield catalogue.keys(SMALL_KEY, "key of the small pulley", key, on_output.after(placement(z=-catalogue.RIM)))
    yield _belt(weaver, at, begin)
    left = -case_width(weaver.params) / 2
    plate = box(middle + face / 2 - left, long, MOTOR_PLATE)
    carrier = Part(part_id("motor-plate"), "plate of the motor", "machined link", plate, ALUMINIUM)
    yield Occurrence(carrier, (placement((left + middle + face / 2) / 2, at.imag, (shape.body + shape.size).real),))


def _output(weaver: Weaver) -> Sum:
    """The reducer's output about z, from its face at z = 0 through the small pulley, with a groove for the key."""
    key = small_key(weaver)
    end = BEFORE_BELT + weaver.belt.width + catalogue.BESIDE + catalogue.RIM + SET_SCREW_HUB
    pieces = (bar(OUTPUT, PLAY), 0.0), (catalogue.keyed_journal(key), PLAY)
    last = bar(OUTPUT, end - PLAY - key.length), PLAY + key.length
    return Sum(tuple(Placed(piece, (placement(z=z),)) for piece, z in (*pieces, last)))


def _belt(weaver: Weaver, at: complex, begin: float) -> Occurrence:
    """The belt about both pulleys, in the side view."""
    large, small = weaver.belt.radii
    axis = weaver.shape.axis
    outer = hull_of_circles(large + BACK, small + BACK, at - axis)
    tips, small_tips = (PROFILE.tip_radius(teeth) + ON_PULLEY for teeth in (weaver.belt.large, SMALL))
    inner = hull_of_circles(tips, small_tips, at - axis)
    length = belt_length(PROFILE, SMALL, weaver.belt.large, max(abs(at - axis), large + small))
    size = f"{PROFILE.name}, {in_mm(weaver.belt.width)} wide"
    shape = Prism(Profile(outer, (inner,)), weaver.belt.width)
    teeth = f"{round(length / PROFILE.pitch)} teeth"
    bought = Bought(PROFILE.name, PROFILE.mass * weaver.belt.width * length, length=length, data=f"{size}, {teeth}")
    part = Part(CAM_BELT, "belt of the cam shaft", "belt and pulleys", shape, purchase=bought, size=size)
    return Occurrence(part, (placement(begin + weaver.belt.width, axis.imag, axis.real).after(IN_SIDE_VIEW),))


def colour_motors(weaver: Weaver) -> Iterator[Occurrence]:
    """The motors of the tubes, upright on the bracket."""
    shape = weaver.shape
    chosen, under = selector_of(weaver.params, weaver.magazine), shape.magazine + shape.magazine_size.real / 2
    flange = shape.rail + RAIL_AXIS / 2 + chosen.length
    colours = [(COLOUR_MOTOR, "motor of the colours"), (TIER_MOTOR, "motor of the tiers")]
    two = weaver.magazine.tiers > 1
    for number, (name, title) in enumerate(colours[: 2 if two else 1]):
        shaft = None if two else (catalogue.motor_shaft(chosen.stepper), AXLE)
        part = catalogue.motor(name, title, chosen.stepper, chosen.torque, chosen.speed, shaft=shaft, standing=True)
        x = (2 * number - 1) * chosen.face / 2 if two else 0.0
        yield Occurrence(part, (_upright(x, flange, under.real),))


def _upright(x: float, height: float, front: float) -> Placement:
    return placement(x, height, front).after(UPRIGHT)
