"""Tables of a mechanism file beyond the geometry: each key, each mistake with its line, and writing without loss."""

import cmath
import math
from pathlib import Path

import numpy as np
import pytest

from ilmek.dynamics.friction import AngleRange, Friction, ValueRange, WindowedLoad
from ilmek.dynamics.inertia import combined, point_mass
from ilmek.dynamics.input_loads import Drag, FollowerForce, TabulatedLoad, jumps
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.joint_friction import PinFriction, SlideFriction
from ilmek.dynamics.loads import Load, PointForce, Torque
from ilmek.dynamics.own_machine import FlatMember, NamedLoad, OwnMachine
from ilmek.dynamics.shapes import disc, link, plate, ring
from ilmek.dynamics.springs import Spring, TorsionSpring
from ilmek.errors import MechanismError
from ilmek.io.mechanism.points import third_corner
from ilmek.io.mechanism_file import mechanism_json, mechanism_toml, parse_mechanism, read_mechanism
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.model import Mechanism
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.units import turn

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"

PRESS = """\
name = "press"
gravity = "9.81m/s^2"
servo = "O"
paths = ["rod.A"]
transmission = ["B"]
links = { width = "30mm", thickness = "10mm", material = "structural steel" }
[values]
r = "40mm"
[bodies]
ground.points = { O = [0, 0], guide = [0, 0], S = [0, "-100mm"] }
crank = { length = "r", shapes = [
{ disc = "O", radius = "60mm", thickness = "10mm", material = "structural steel" }, { point = "A", mass = "1kg" }] }
rod.length = "3.5 r"
ram = { mass = "8kg" }
[joints]
O.pin = ["ground", "crank"]
A.pin = ["crank", "rod"]
B.pin = ["rod", "ram"]
guide = { slide = ["ram", "ground"], along = "-90deg" }
[inputs]
O = "crank"
[branches]
B = 1
[loads]
pressing = { force = "4kN", direction = "90deg", on = "ram.B", while = { from = "210deg", to = "270deg" } }
table = { force = [0, "1N"], on = "ram.B", table = [["0deg", 0], ["90deg", "100N"], ["180deg", 0]] }
t = { torque = "1N*m", on = "rod" }
f = { friction = "5N", on = "ram.B" }
d = { drag = "5N*s/m", on = "ram.B" }
bf = { force = ["3N", 0], on = "rod.B", frame = "body" }
[springs]
s = { between = ["ground.S", "ram.B"], stiffness = "2N/mm", length = "80mm", damping = "3N*s/m" }
ts = { torsion = ["ground", "rod"], stiffness = "2N*m/deg" }
[dampers]
dd = { torsion = ["crank", "rod"], damping = "0.1N*m*s/rad" }
[pins]
A = { diameter = "16mm", length = "20mm" }
B = { diameter = "16mm", length = "20mm", bearing = "6204", life = "20000h" }
[friction]
A = { coefficient = 0.1 }
guide = { coefficient = "10%", breadth = "60mm", drag = "1N*s/m" }
[motions]
O = "120rpm"
[forward]
duration = "2s"
speed = "1rpm"
motor = { torque = "60N*m", speed = "130rpm", inertia = "0.2kg*m^2" }
events = { fast = { speed = "100rpm", direction = "up" }, end = { position = "720deg" } }
[study]
speeds = ["60rpm", "120rpm"]
"""


def press(*replaced: tuple[str, str]) -> OwnMachine:
    text = PRESS
    for before, after in replaced:
        assert before in text
        text = text.replace(before, after, 1)
    return parse_mechanism(text, name="press.toml").machine


def load(machine: OwnMachine, name: str) -> Load:
    return next(one.load for one in machine.loads if one.name == name)


def test_every_table_is_read() -> None:
    machine = press()
    assert machine.gravity == -9.81j
    assert [one.name for one in machine.loads] == ["pressing", "table", "t", "f", "d", "bf", "s", "ts", "dd"]
    pressing = load(machine, "pressing")
    assert isinstance(pressing, WindowedLoad)
    assert isinstance(pressing.window, AngleRange)
    assert (pressing.input_name, pressing.window.end) == ("crank", pytest.approx(turn * 0.75))
    assert sorted(jumps(pressing, "crank")) == pytest.approx((7 * turn / 12, turn * 0.75))
    assert jumps(pressing, "another") == set()
    table = load(machine, "table")
    assert isinstance(table, TabulatedLoad)
    assert table.factor(np.radians([0, 45, 135, 270, 405])) == pytest.approx([0, 50, 50, 0, 50])
    assert isinstance(load(machine, "t"), Torque)
    assert isinstance(load(machine, "f"), Friction)
    assert load(machine, "d") == Drag("ram.B", 5.0)
    assert load(machine, "bf") == FollowerForce("rod.B", 3 + 0j)
    assert load(machine, "s") == Spring("ground.S", "ram.B", 2000.0, 0.08, 3.0)
    assert load(machine, "ts") == TorsionSpring("ground", "rod", 2 / (math.pi / 180))
    assert load(machine, "dd") == TorsionSpring("crank", "rod", 0.0, 0.0, 0.1)
    assert machine.frictions == (PinFriction("A", 0.008, 0.1), SlideFriction("guide", 0.06, 0.1, 1.0))
    assert machine.members == {"rod": FlatMember(0.03, 0.01, "structural steel")}
    assert (machine.pins["B"].bearing, machine.pins["B"].life) == ("6204", 72e6)
    assert machine.motions["crank"].speed == pytest.approx(2 * turn)
    assert machine.forward is not None
    assert [event.name for event in machine.forward.events] == ["fast", "end"]
    assert machine.study is not None
    assert machine.study.speeds == pytest.approx((turn, 2 * turn))
    assert (machine.servo, machine.paths, machine.transmission) == ("crank", (("rod", "A"),), ("B",))


def test_masses_are_of_shapes_of_sections_or_given() -> None:
    machine = press()
    steel = 7850.0
    assert machine.inertias["crank"] == combined(disc(0.06, 0.01, steel), point_mass(1.0, 0.04))
    assert machine.inertias["rod"] == link(0, 0.14, 0.03, 0.01, steel)
    assert machine.inertias["ram"].mass == 8
    assert "ground" not in machine.inertias


SHAPES = {
    '{ ring = "A", outer = "3cm", inner = "2cm", thickness = "1cm", density = "1g/cm^3" }': ring(
        0.03, 0.02, 0.01, 1e3, at=0.04
    ),
    '{ bar = ["O", ["4cm", 0]], width = "1cm", thickness = "1cm", density = "1g/cm^3" }': link(
        0, 0.04, 0.01, 0.01, 1e3
    ),
    '{ plate = [[0, 0], "A", ["4cm", "3cm"]], thickness = "1cm", density = "1g/cm^3" }': plate(
        [0, 0.04, 0.04 + 0.03j], 0.01, 1e3
    ),
    '{ disc = "O", radius = "1cm", mass = "2kg" }': disc(0.01, 1.0, 2 / (math.pi * 1e-4)),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_each_shape_has_its_mass(shape: str) -> None:
    crank = PRESS[PRESS.index("crank = {") : PRESS.index("rod.length")]
    found = press((crank.rstrip(), f'crank = {{ length = "r", shapes = [{shape}] }}')).inertias["crank"]
    expected = SHAPES[shape]
    assert (found.mass, found.moment) == pytest.approx((expected.mass, expected.moment), rel=1e-12)
    assert abs(found.centre - expected.centre) < 1e-15


GRAVITIES = {
    '"9.81m/s^2"': -9.81j,
    '["3m/s^2", "-4m/s^2"]': 3 - 4j,
    '{ value = "2m/s^2", direction = "90deg" }': 2j,
}


@pytest.mark.parametrize("given", GRAVITIES)
def test_gravity_is_downward_or_has_a_direction(given: str) -> None:
    assert press(('"9.81m/s^2"', given)).gravity == GRAVITIES[given]
    assert press(('gravity = "9.81m/s^2"\n', "")).gravity == 0


MISTAKES = {
    "no direction": (', direction = "90deg"', "", "line 25, loads.pressing: force has no direction; give one"),
    "unknown kind": (
        "pressing = { force",
        "pressing = { forse",
        "loads.pressing: has none of force, torque, friction, drag",
    ),
    "unknown body": ('"ram.B", while', '"rum.B", while', "loads.pressing: press has no body 'rum'"),
    "unknown point": (
        '"ram.B", while',
        '"ram.Z", while',
        "loads.pressing: body 'ram' of press has no point 'Z'",
    ),
    "pair of names": (
        '"ram.B", while',
        '["ram", "B"], while',
        "loads.pressing.on: ['ram', 'B'] is not a body and its point; a text like \"rocker.E\"; write \"ram.B\"",
    ),
    "window in mm": ('from = "210deg"', 'from = "210mm"', "loads.pressing: from is a quantity in m; a quantity in rad"),
    "unknown input": (
        "while = { from",
        'while = { input = "P", from',
        "there is no driven joint or body 'P'; known: O, crank",
    ),
    "table descends": ('["90deg", "100N"]', '["-90deg", "100N"]', "loads.table: the values of a table do not ascend"),
    "table too long": (
        '["180deg", 0]',
        '["400deg", 0]',
        "loads.table: a table over a turning input is 6.98132 rad long",
    ),
    "table of lengths": ('"100N"]', '"100mm"]', "loads.table: the second of a row is a quantity in m"),
    "negative friction": ('"5N"', '"-5N"', "loads.f.friction: is -5 N; 0 or more"),
    "negative stiffness": ('"2N/mm"', '"-2N/mm"', "springs.s: stiffness of a spring is -2000"),
    "spring on one body": ('["ground", "rod"], stiff', '["rod", "rod"], stiff', "springs.ts: both ends are on 'rod'"),
    "name twice": ("dd = {", "s = {", "dampers.s: the name 's' is used twice"),
    "unknown pin": ("A = { diameter", "Z = { diameter", "pins.Z: there is no pin 'Z'; known: O, A, B"),
    "pin of a slide": ("A = { diameter", "guide = { diameter", "pins.guide: there is no pin 'guide'"),
    "unknown bearing": ('"6204"', '"62044"', "pins.B: no bearing '62044' in the table"),
    "no radius": ("A = { coefficient", "O = { coefficient", "friction.O: pin 'O' has no radius"),
    "breadth of a pin": (
        "coefficient = 0.1 }",
        'coefficient = 0.1, breadth = "1cm" }',
        "breadth is given for 'A', a pin",
    ),
    "no breadth": (', breadth = "60mm"', "", "friction.guide: slide 'guide' has no breadth"),
    "drag of a pin": (
        "coefficient = 0.1 }",
        'coefficient = 0.1, drag = "1N*s/m" }',
        "friction.A: drag is a quantity in N*s/m",
    ),
    "unknown material": (
        'links = { width = "30mm", thickness = "10mm", material = "structural',
        'links = { width = "30mm", thickness = "10mm", material = "structral',
        "line 6, links: no material 'structral steel'",
    ),
    "no width": (
        'links = { width = "30mm"',
        'links = { width = "-30mm"',
        "line 6, links.width: is -0.03 m; 1e-09 to 1e+15; check its unit",
    ),
    "no diameter": ('diameter = "16mm"', "diameter = 0", "pins.A.diameter: is 0 m; 1e-09 to 1e+15; check its unit"),
    "mass and shapes": (
        'length = "r", shapes',
        'length = "r", mass = "1kg", shapes',
        "bodies.crank: mass and shapes are both given",
    ),
    "no density": (
        ', material = "structural steel" }, { point',
        " }, { point",
        "bodies.crank: a shape has no mass; one of material",
    ),
    "no speed": ('O = "120rpm"', 'O = "0rpm"', "motions.O: speed is 0: the input does not move"),
    "speed in deg": ('O = "120rpm"', 'O = "120deg"', "motions.O: '120deg' has the wrong unit; a quantity in rad/s"),
    "motion of nothing": ('O = "120rpm"', 'A = "120rpm"', "motions.A: there is no driven joint or body 'A'"),
    "two events in one": (
        '{ position = "720deg" }',
        '{ position = "720deg", time = "1s" }',
        "event 'end' has position and time",
    ),
    "no duration": ('duration = "2s"', 'duration = "0s"', "forward.duration: is 0 s; above 0"),
    "run from rest": ('speed = "1rpm"\n', "", "forward: the run starts at rest, where friction 'f' has no direction"),
    "motor of a slide": (
        '{ torque = "60N*m", speed = "130rpm", inertia = "0.2kg*m^2" }',
        '{ force = "60N" }',
        "forward.motor: the motor of a turning input has a force; give its torque",
    ),
    "no speeds": ('speeds = ["60rpm", "120rpm"]', "speeds = []", "study.speeds: has 0 entries; 1 to 50"),
    "speed backward": ('["60rpm", "120rpm"]', '["-60rpm"]', "study: speeds of a study cannot be used; above 0"),
    "many speeds": (
        'speeds = ["60rpm", "120rpm"]',
        'from = "1rpm"\nto = "2rpm"\ncount = 60',
        "study.count: 60 is not a whole number from 2",
    ),
    "servo of nothing": ('servo = "O"', 'servo = "A"', "line 3, servo: there is no driven joint or body 'A'"),
    "path of nothing": ('"rod.A"', '"rod.Z"', "line 4, paths.0: body 'rod' of press has no point 'Z'"),
    "angle of a slide": (
        'transmission = ["B"]',
        'transmission = ["guide"]',
        "line 5, transmission.0: 'guide' is a slide",
    ),
    "other units": ('servo = "O"', 'units = "mm"', "line 3, units: is 'mm'; allowed: SI"),
    "length of a crank": ('length = "r"', 'length = "-r"', "bodies.crank.length: is -0.04 m; above 0"),
    "no slide's branch": ("B = 1\n", "", "has no branch for the free pin 'B' of rod and ram"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_reported_with_its_line_and_key(name: str) -> None:
    before, after, said = MISTAKES[name]
    assert before in PRESS
    with pytest.raises(MechanismError) as caught:
        parse_mechanism(PRESS.replace(before, after, 1), name="press.toml").plan()
    assert str(caught.value).startswith("press.toml, line ")
    assert said in str(caught.value)


def test_a_link_with_a_section_has_a_length() -> None:
    tiny = ('rod.length = "3.5 r"', 'rod.length = "1e-12m"')
    with pytest.raises(MechanismError, match="A and B of 'rod' are 1e-12 m apart; 0, or 1e-09 m or more for a link"):
        press(('name = "press"', 'name = "press"\nconfirm = ["lengths"]'), tiny)


def test_a_missing_branch_of_a_slide_names_the_slide() -> None:
    text = (EXAMPLES / "quick_return.toml").read_text(encoding="utf-8").replace("slot = 1, ", "")
    with pytest.raises(MechanismError, match="joints.slot: quick return has no branch for the slide 'slot' of"):
        parse_mechanism(text).plan()


@pytest.mark.parametrize("name", ["press", *sorted(path.stem for path in EXAMPLES.glob("*.toml"))])
def test_a_machine_is_written_and_read_again(name: str) -> None:
    path = EXAMPLES / f"{name}.toml"
    text = PRESS if name == "press" else path.read_text(encoding="utf-8")
    if "[bodies" not in text:
        return
    machine = parse_mechanism(text).machine
    toml, json = mechanism_toml(machine), mechanism_json(machine)
    assert mechanism_json(parse_mechanism(toml).machine) == json
    assert mechanism_toml(parse_mechanism(json, toml=False).machine) == toml
    assert parse_mechanism(toml).machine.inertias == machine.inertias


def test_a_load_that_is_a_function_cannot_be_written() -> None:
    def force(motion: Motion) -> float:
        return float(len(motion))

    mechanism = four_bar(0.3, 0.06, 0.2, 0.23, branch=1)
    machine = OwnMachine(mechanism, loads=(NamedLoad("wind", PointForce("rocker.B", force)),))
    with pytest.raises(MechanismError, match="load 'wind' is a function that no file expresses"):
        mechanism_toml(machine)


def test_jansens_leg_needs_no_computed_coordinate() -> None:
    text = (EXAMPLES / "jansen_leg.toml").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    assert len(lines) <= 25
    machine = read_mechanism(EXAMPLES / "jansen_leg.toml").machine
    rocker, leg = (machine.mechanism.body(name).points for name in ("rocker", "leg"))
    assert abs(rocker["R"] - (2.60987951807 + 40.0149788067j) / 1e3) < 1e-13
    assert abs(leg["F"] - (-7.74659400545 + 48.3837811804j) / 1e3) < 1e-13


def test_pins_of_several_bodies_keep_the_dyads() -> None:
    steps = [step.description for step in read_mechanism(EXAMPLES / "peaucellier.toml").plan().steps]
    assert len(steps) == 4
    assert all("RRR" in step for step in steps[1:])


def star(order: list[str]) -> Mechanism:
    """Two dyads on one pin C of three bodies in a given order: a and b make a dyad, c belongs to a later one."""
    listed = ", ".join(f'"{body}"' for body in order)
    text = f"""
    branches = {{ C = 1, E = 1 }}
    [bodies]
    ground.points = {{ O = [0, 0], B = ["60mm", 0], F = ["90mm", "50mm"] }}
    crank.length = "20mm"
    a.length = "50mm"
    b.length = "55mm"
    c.length = "45mm"
    d.length = "60mm"
    [joints]
    C.pin = [{listed}]
    O.pin = ["ground", "crank"]
    A.pin = ["crank", "a"]
    B.pin = ["ground", "b"]
    E.pin = ["c", "d"]
    F.pin = ["ground", "d"]
    [inputs]
    O = "crank"
    """
    return parse_mechanism(text).mechanism


def test_the_order_of_bodies_at_a_pin_does_not_change_the_groups() -> None:
    found = [solve(read_plan(star(order)), np.linspace(0, turn, 9)) for order in (["a", "b", "c"], ["c", "a", "b"])]
    assert found[0].ok
    for body, point in (("c", "E"), ("a", "C")):
        first, second = (np.abs(motion.point(body, point).position) for motion in found)
        assert np.abs(first - second).max() < 1e-15


def read_plan(mechanism: Mechanism):  # type: ignore[no-untyped-def]
    return parse_mechanism(mechanism_toml(OwnMachine(mechanism))).plan()


POINTS = {
    'P = { radius = "5mm", angle = "90deg" }': 5j,
    'P = { radius = "5mm", angle = "90deg", from = "A" }': 60 + 5j,
    'P = { offset = ["1mm", "2mm"], from = "A" }': 61 + 2j,
    'P = { sides = ["36mm", "48mm"], side = "left" }': 21.6 + 28.8j,
    'P = { sides = ["36mm", "48mm"], side = "right" }': 21.6 - 28.8j,
    'P = { sides = ["36mm", "48mm"], from = ["A", "A0"], side = "right" }': 38.4 + 28.8j,
    'P = { offset = [0, "1mm"], from = "Q" }, Q = ["1mm", 0]': 1 + 1j,
}


@pytest.mark.parametrize("points", POINTS)
def test_points_are_polar_offset_or_corners_of_a_triangle(points: str) -> None:
    assert abs(crank_of(points)["P"] * 1e3 - POINTS[points]) < 1e-12


def crank_of(points: str) -> dict[str, complex]:
    text = f"""
    [bodies]
    ground.points = {{ A0 = [0, 0] }}
    crank = {{ length = "60mm", points = {{ {points} }} }}
    arm = {{ points = {{ A = [0, 0] }} }}
    [joints]
    A0.pin = ["ground", "crank"]
    A.pin = ["crank", "arm"]
    [inputs]
    A0 = "crank"
    A = "arm"
    """
    return dict(parse_mechanism(text, name="c.toml").mechanism.body("crank").points)


NO_POINTS = {
    'P = { sides = ["6mm", "8mm"], side = "left" }': "points.P: sides of 6 mm, 8 mm and 60 mm form no triangle",
    'P = { sides = ["36mm", "48mm"], side = "up" }': "points.P.side: is 'up'; allowed: left, right",
    'P = { sides = ["36mm", "48mm"] }': "points.P: has no 'side'",
    'P = { radius = "6mm", angle = 1 }': 'points.P.angle: 1 has no unit; write "1deg", or "1rad"',
    'P = { radius = "6mm", angle = 0, from = "Z" }': "points.P: body 'crank' has no point 'Z'; it has A0, A, P",
    'P.offset = [0, 0], P.from = "Q", Q = { offset = [0, 0], from = "P" }': "points.Q: the points P -> Q -> P of crank",
    "P = { at = [0, 0] }": "points.P: has none of radius, sides, offset",
    "P = 3": "points.P: 3 is not allowed here; position in the body's own frame",
}


@pytest.mark.parametrize("points", NO_POINTS)
def test_a_point_that_cannot_be_is_reported(points: str) -> None:
    with pytest.raises(MechanismError) as caught:
        crank_of(points)
    assert f"c.toml, line 4, bodies.crank.{NO_POINTS[points]}" in str(caught.value)


def test_a_triangle_closes_on_either_side() -> None:
    for left in (True, False):
        corner = third_corner(1 + 1j, 4 + 5j, 3.0, 4.0, left=left)
        assert (abs(corner - 1 - 1j), abs(corner - 4 - 5j)) == pytest.approx((3, 4))
        assert (cmath.phase((corner - 1 - 1j) / (3 + 4j)) > 0) == left


MOTIONS = {
    'O = { speed = "60rpm", start = "90deg" }': (None, [(0.0, turn / 4, turn), (1.0, 5 * turn / 4, turn)]),
    'O.steps = [{ to = "180deg", time = "1s", law = "cycloidal" }, { dwell = "1s" }, { to = "1turn", time = "2s" }]': (
        4.0,
        [(0.5, turn / 4, turn), (1.5, turn / 2, 0.0), (4.5, turn * 1.25, turn)],
    ),
    'O = { steps = [{ to = "90deg", time = "2s" }] }': (
        None,
        [(-1.0, 0.0, 0.0), (1.0, turn / 8, 1.875 * turn / 8), (3.0, turn / 4, 0.0)],
    ),
    'O = { table = [["0s", "0deg"], ["1s", "180deg"], ["2s", "360deg"]] }': (
        2.0,
        [(0.5, turn / 4, turn / 2), (2.5, turn * 1.25, turn / 2)],
    ),
    'O = { table = [["0s", "0deg"], ["1s", "45deg"], ["2s", "90deg"]] }': (
        None,
        [(0.0, 0.0, 0.0), (1.0, turn / 8, 1.5 * turn / 8), (9.0, turn / 4, 0.0)],
    ),
}


@pytest.mark.parametrize("text", MOTIONS)
def test_an_input_follows_its_motion(text: str) -> None:
    period, expected = MOTIONS[text]
    motion = press(('O = "120rpm"', text)).motions["crank"]
    assert motion.period == period
    times = np.array([time for time, _, _ in expected])
    value, speed, acceleration = motion.law(times)
    assert value == pytest.approx([one for _, one, _ in expected], abs=1e-12)
    assert speed == pytest.approx([one for _, _, one in expected], abs=1e-12)
    step = 1e-6
    later, earlier = motion.law(times + 0.01 + step)[1], motion.law(times + 0.01 - step)[1]
    assert motion.law(times + 0.01)[2] == pytest.approx((later - earlier) / (2 * step), abs=1e-5)
    assert acceleration.shape == times.shape


NO_MOTIONS = {
    '{ steps = [{ to = "1deg", time = "1s", law = "uniform" }] }': "the velocity of law uniform of step 1 jumps",
    '{ steps = [{ to = "1deg", time = "1s", law = "cycloid" }] }': "there is no law 'cycloid'",
    '{ steps = [{ to = "1deg", time = "0s" }] }': "motions.O.steps.0.time: is 0 s; above 0",
    '{ steps = [{ dwell = "1s" }] }': "all steps are at one value: the input does not move",
    '{ steps = [{ to = "1mm", time = "1s" }] }': "to is a quantity in m; a quantity in rad is required here",
    '{ steps = [{ to = "1deg", time = "1s" }], repeat = true }': "a motion that repeats ends elsewhere",
    '{ table = [["0s", 0], ["2s", "1deg"], ["1s", 0]] }': "the times of a table do not ascend from 0 s",
    '{ table = [["0s", 0], ["1s", 0]] }': "motions.O.table: has 2 entries; 3 to 1000",
    "{ start = 0 }": "has none of speed, steps, table",
}


@pytest.mark.parametrize("given", NO_MOTIONS)
def test_a_motion_that_cannot_be_is_reported(given: str) -> None:
    with pytest.raises(MechanismError) as caught:
        press(('O = "120rpm"', f"O = {given}"))
    assert "press.toml, line 43, motions.O" in str(caught.value)
    assert NO_MOTIONS[given] in str(caught.value)


def test_loads_of_the_file_act_on_the_machine() -> None:
    """Drive torque by virtual work: the load's power over the input's speed, at rest without masses."""
    keep = PRESS[PRESS.index("pressing = {") : PRESS.index("table = {")]
    bare = PRESS[: PRESS.index("[loads]")] + f"[loads]\n{keep}\n"
    file = parse_mechanism(bare)
    motion = solve(file.plan(), np.radians([200.0, 240.0, 280.0]), 1.0)
    effort = inverse(motion, {}, [one.load for one in file.machine.loads]).effort("crank")
    power = 4000 * motion.point("ram", "B").velocity.imag
    assert effort == pytest.approx([0, -power[1], 0], abs=1e-9)


def test_a_load_over_a_slide_is_within_its_values() -> None:
    text = """
    [bodies]
    ground.points = { s = [0, 0] }
    block = {}
    [joints]
    s = { slide = ["block", "ground"] }
    [inputs]
    s = "block"
    [loads]
    stop = { force = ["-5N", 0], on = "block.s", while = { from = "10mm", to = "20mm" } }
    rise = { force = ["1N", 0], on = "block.s", table = [[0, 0], ["10mm", "2N"]] }
    """
    machine = parse_mechanism(text).machine
    stop, rise = (one.load for one in machine.loads)
    assert isinstance(stop, WindowedLoad)
    assert stop.window == ValueRange(0.01, 0.02)
    assert isinstance(rise, TabulatedLoad)
    assert list(rise.factor(np.array([-1.0, 0.005, 1.0]))) == [0, 1, 2]
    with pytest.raises(MechanismError, match="the range from 0.02 m to 0.01 m is empty"):
        parse_mechanism(text.replace('from = "10mm", to = "20mm"', 'from = "20mm", to = "10mm"'))
