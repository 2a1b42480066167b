"""A mechanism written is read again to the last bit, as TOML and as JSON, and the places of its keys are right."""

import json
import math
from dataclasses import fields

from effort import examples
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from ilmek.cams.laws import LAWS
from ilmek.dynamics.friction import AngleRange, Friction, WindowedLoad
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.input_loads import Drag, FollowerForce, TabulatedLoad
from ilmek.dynamics.joint_friction import PinFriction
from ilmek.dynamics.loads import PointForce, Torque
from ilmek.dynamics.motor_drive import MotorDrive
from ilmek.dynamics.own_machine import (
    FlatMember,
    ForwardTask,
    GivenMotion,
    NamedLoad,
    OwnMachine,
    PinMember,
    SpeedStudy,
    StopEvent,
)
from ilmek.dynamics.springs import Spring, TorsionSpring
from ilmek.io.line_numbers import json_lines, tokens, toml_lines
from ilmek.io.mechanism.motions import ConstantSpeed, MotionSequence, MotionStep, TableMotion
from ilmek.io.mechanism_file import mechanism_json, mechanism_toml, parse_mechanism
from ilmek.io.toml_text import toml_text
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.model import GROUND, Body, Coupling, Displacement, Mechanism, Pin, Rotation, Slide

REAL = st.floats(-1e30, 1e30)
ANGLE = st.floats(-12.0, 12.0)
POSITIVE = st.floats(0, 1e30)
PLACE = st.builds(complex, REAL, REAL)
NAME = st.text(st.characters(categories=("L", "M", "N", "P", "S")), max_size=8)


@st.composite
def parts(draw):
    """Points, joints, driven bodies, branches, name and pose of a chain from the ground on, any names and numbers."""
    names = [GROUND, *draw(st.lists(NAME.filter(lambda name: name != GROUND), min_size=1, max_size=5, unique=True))]
    joined = draw(st.lists(NAME, min_size=len(names) - 1, max_size=len(names) - 1, unique=True))
    points = {name: draw(st.dictionaries(NAME, PLACE, max_size=2)) for name in names}
    joints = []
    for k, joint in enumerate(joined):
        first, second = names[k], names[k + 1]
        for body in (first, second):
            points[body][joint] = draw(PLACE)
        slide = (draw(ANGLE), draw(ANGLE)) if draw(st.booleans()) else ()
        driven = draw(st.sampled_from([first, second])) if k % 2 == 0 else None
        joints.append((joint, second, first, slide, driven))
    for k, name in enumerate(names[1:-1]):  # a link whose two pins coincide is refused
        for place, joint in enumerate(joined[k : k + 2]):
            points[name][joint] = complex(place, draw(REAL))
    pose = draw(st.dictionaries(st.sampled_from(names), st.tuples(PLACE, REAL), max_size=2))
    branches = draw(st.dictionaries(st.sampled_from(joined), st.sampled_from([1, -1])))
    return points, joints, branches, draw(NAME), pose


def built(points, joints, branches, name, pose) -> Mechanism:
    """The mechanism of the parts; of two inputs of one name the last counts."""
    inputs = {}
    for joint, _, _, slide, driven in joints:
        if driven is not None:
            entry = Displacement(joint) if slide else Rotation(driven, joint)
            inputs[entry.name] = entry
    return Mechanism(
        tuple(Body(body, places) for body, places in points.items()),
        tuple(
            Slide(joint, second, first, *slide) if slide else Pin(joint, first, second)
            for joint, second, first, slide, _ in joints
        ),
        tuple(inputs.values()),
        branches,
        name,
        pose,
    )


WEIGHT = st.tuples(POSITIVE, PLACE, POSITIVE)


@examples(60)
@given(parts(), st.dictionaries(st.integers(0, 4), WEIGHT, max_size=2))
def test_what_is_written_is_read_again(said, weights):
    mechanism = built(*said)
    inertias = {mechanism.moving[k % len(mechanism.moving)]: Inertia(*numbers) for k, numbers in weights.items()}
    for write, toml in ((mechanism_toml, True), (mechanism_json, False)):
        text = write(OwnMachine(mechanism, inertias))
        found = parse_mechanism(text, toml=toml)
        assert found.mechanism == mechanism
        assert [body.name for body in found.mechanism.bodies] == [body.name for body in mechanism.bodies]
        assert found.inertias == inertias
        assert write(found.machine) == text  # the order and the sign of zero too


TREE = st.recursive(
    st.one_of(st.text(max_size=6), st.integers(-9, 9), REAL, st.lists(REAL, max_size=2)),
    lambda inner: st.dictionaries(NAME, inner, max_size=3),
    max_leaves=12,
)


@examples(60)
@given(st.lists(NAME, min_size=1, max_size=6, unique=True))
def test_json_keys_are_found_in_their_lines(names):
    data = {names[0]: {name: [0, {"x": "]}"}] for name in names[1:]}}
    text = json.dumps(data, indent=1)
    found = json_lines(tokens(text))
    lines = text.split("\n")
    for place, name in enumerate(names[1:]):
        line = found[(names[0], name)]
        assert line == 3 + 6 * place
        assert lines[line - 1].strip().startswith(json.dumps(name))
        assert found[(names[0], name, 1, "x")] == line + 3


@examples(60)
@given(st.dictionaries(NAME, TREE, max_size=4))
def test_every_key_of_a_toml_text_has_a_place(data):
    text = toml_text(data)
    found, count = toml_lines(tokens(text)), len(text.split("\n"))

    def look(value, path):
        assert 1 <= found[path] <= count
        for name, inner in value.items() if isinstance(value, dict) else ():
            look(inner, (*path, name))

    look(data, ())
    assert len(found) >= 1


def test_couplings_round_trip():
    wheels = {name: Body(name, {name: 0}) for name in ("a", "b", "c")}
    slide = Slide("s", "c", "b", 0.1, 0.2)
    bodies = (Body(GROUND, {"a": 0, "b": 1}), wheels["a"], Body("b", {"b": 0, "s": 0}), Body("c", {"s": 1, "c": 0}))
    couplings = (
        Coupling("one", "gears", ("a", "a"), ("b", "b"), -1 / 3, 0.1 + 0.2, 1e-300),
        Coupling("two", "belt", (GROUND, "a"), ("b", "b"), 2 / 3, -0.0, 1.0, "a"),
        Coupling("three", "rack", ("a", "a"), ("c", "s"), -0.1, 0.7, 5e-324, "b"),
    )
    joints = (Pin("a", GROUND, "a"), Pin("b", GROUND, "b"), slide)
    mechanism = Mechanism(bodies, joints, (Rotation("a", "a"),), couplings=couplings)
    for write, toml in ((mechanism_toml, True), (mechanism_json, False)):
        assert parse_mechanism(write(OwnMachine(mechanism)), toml=toml).mechanism == mechanism


def test_smallest_and_greatest_numbers_survive():
    numbers = [5e-324, -0.0, 9.999999999999999e29, 0.1 + 0.2, 1e22, 1e-7]
    ground = Body(GROUND, {"A": 0, **{str(n): complex(x, -x) for n, x in enumerate(numbers)}})
    mechanism = Mechanism((ground, Body("arm", {"A": 0})), (Pin("A", GROUND, "arm"),), (Rotation("arm", "A"),))
    for write, toml in ((mechanism_toml, True), (mechanism_json, False)):
        points = parse_mechanism(write(OwnMachine(mechanism)), toml=toml).mechanism.body(GROUND).points
        for n, x in enumerate(numbers):
            assert points[str(n)] == complex(x, -x)
            assert math.copysign(1, points[str(n)].real) == math.copysign(1, x)


AMOUNT = st.floats(-1e6, 1e6)
LEAST = st.floats(0, 1e6)
RISING = st.lists(st.floats(0, 6.28), min_size=2, max_size=5, unique=True).map(sorted).map(tuple)


@st.composite
def loads(draw):
    """A load of any kind on a four-bar."""
    spot = draw(st.sampled_from([("crank", "A"), ("coupler", "B"), ("rocker", "B")]))
    force = complex(draw(AMOUNT), draw(AMOUNT))
    at = draw(RISING)
    plain = (
        PointForce(spot, force),
        FollowerForce(spot, force),
        Torque(spot[0], draw(AMOUNT)),
        Drag(spot, draw(LEAST)),
        TabulatedLoad(PointForce(spot, 1j), "crank", at, tuple(draw(AMOUNT) for _ in at)),
        TabulatedLoad(Torque(spot[0], 1.0), None, at, tuple(draw(AMOUNT) for _ in at), turns=False),
    )
    window = AngleRange(draw(AMOUNT), draw(AMOUNT))
    springs = (
        Spring("ground.B0", spot, draw(LEAST), draw(LEAST), draw(LEAST)),
        TorsionSpring("ground", spot[0], draw(LEAST), draw(AMOUNT), draw(LEAST)),
        Friction(spot, draw(LEAST), "crank", draw(st.sampled_from([None, window]))),
    )
    one = draw(st.sampled_from([*plain, *springs]))
    return WindowedLoad(one, "crank", window) if one in plain and draw(st.booleans()) else one


@st.composite
def motions(draw):
    """A constant speed, motion laws in sequence, or a table of values."""
    steps = tuple(
        MotionStep(
            draw(AMOUNT), draw(st.floats(1e-6, 1e6)), LAWS[draw(st.sampled_from(["3-4-5", "modified-sine", "scca"]))]
        )
        for _ in range(draw(st.integers(1, 3)))
    )
    times = (0.0, *draw(RISING.filter(lambda times: times[0] > 0)))
    law = draw(
        st.sampled_from(
            [
                ConstantSpeed(draw(AMOUNT), draw(st.floats(1e-3, 1e3))),
                MotionSequence(draw(st.just(1e7)), steps, repeats=False),
                TableMotion(times, tuple(draw(AMOUNT) for _ in times), repeats=False),
            ]
        )
    )
    return GivenMotion(law, None, (), law.speed if isinstance(law, ConstantSpeed) else None)


@settings(max_examples=25, phases=[Phase.generate])
@given(st.dictionaries(NAME, loads(), max_size=4), motions(), PLACE, st.floats(1e-6, 1e3))
def test_a_machine_with_its_loads_is_read_again(named, motion, gravity, size):
    machine = OwnMachine(
        four_bar(0.3, 0.06, 0.2, 0.23, branch=1),
        {"rocker": Inertia(size, size * 1j, size)},
        gravity=gravity,
        loads=tuple(NamedLoad(name, load) for name, load in named.items()),
        frictions=(PinFriction("A", size, size, size),),
        members={"rocker": FlatMember(size, size, "structural steel", draw_stress(size), size)},
        pins={"A": PinMember(size, size, size > 1, size, size, size, "6204", size)},
        motions={"crank": motion},
        forward=ForwardTask(
            size, size, size, MotorDrive(size, -size, size, size), (StopEvent("x", "speed", -size, terminal=False),)
        ),
        study=SpeedStudy((size, 2 * size)),
        servo="B0",
        actuators=("B0",),
        paths=(("rocker", "B"),),
        transmission=("B",),
    )
    for write, toml in ((mechanism_toml, True), (mechanism_json, False)):
        text = write(machine)
        found = parse_mechanism(text, toml=toml).machine
        springs = {one.name: one.load for one in found.loads}
        assert springs.keys() == named.keys()
        assert all(same(springs[name], load) for name, load in named.items())
        assert (found.gravity, found.frictions, found.members) == (gravity, machine.frictions, machine.members)
        assert (found.pins, found.motions["crank"].law) == (machine.pins, motion.law)
        assert (found.actuators, found.servo) == (machine.actuators, machine.servo)
        assert write(found) == text


def same(first, second) -> bool:
    """Whether two loads have equal fields; records do not compare by value."""
    if type(first) is not type(second):
        return False
    if isinstance(first, WindowedLoad | TabulatedLoad) and not same(first.load, second.load):
        return False
    keys = [one.name for one in fields(first) if one.name != "load"]
    return all(getattr(first, key) == getattr(second, key) for key in keys)


def draw_stress(size: float) -> float | None:
    """An allowed stress for every second machine."""
    return size if size > 1 else None
