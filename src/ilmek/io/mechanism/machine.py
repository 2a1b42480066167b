"""A machine in a file: all its tables, and the records that they become."""

from dataclasses import replace

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.own_machine import FlatMember, OwnMachine
from ilmek.dynamics.springs import Spring, TorsionSpring
from ilmek.errors import MechanismError
from ilmek.io.declared import ChoiceEntry, ListEntry, QuantityEntry, TableEntry, TextEntry, keys, names
from ilmek.io.mechanism import masses, tasks
from ilmek.io.mechanism.couplings import COUPLING, coupling_data
from ilmek.io.mechanism.cylinders import CYLINDER
from ilmek.io.mechanism.frictions import FRICTION, friction_data, frictions_of
from ilmek.io.mechanism.joints import JOINT, joint_data, members_of
from ilmek.io.mechanism.loads import GRAVITY, LOAD, gravity_of, load_data, loads_of
from ilmek.io.mechanism.mechanism import mechanism_of
from ilmek.io.mechanism.motions import MOTION, motion_data, motions_of
from ilmek.io.mechanism.names import ANGLE, MOST_ENTRIES, SPOT, XY, driven_body, parts_of, unit_of, xy_of
from ilmek.io.mechanism.points import LARGEST_RATIO, extreme_lengths
from ilmek.io.mechanism.springs import DAMPER, SPRING, spring_data
from ilmek.io.schema import Measured, SourceText, Table
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.records import JsonObject

_POSE = keys({"origin": XY, "angle": ANGLE}, name="pose")

FILE = TableEntry(
    'A quantity is text with its unit, like "60mm" or "170deg", or an expression of named values, like "2*r + 5mm"; 0 '
    'needs no unit. With units = "SI" plain numbers are SI and radians. At most 100 bodies, joints and couplings; a '
    "name has at most 100 characters, all printable.",
    {
        "bodies": names(
            masses.BODY,
            "name -> body; the body named ground is fixed and its frame is the world frame",
            refers="body",
            most=MOST_ENTRIES,
        ),
        "joints": names(
            JOINT, "name -> joint; each of its bodies carries a point of its name", refers="joint", most=MOST_ENTRIES
        ),
        "inputs": names(
            TextEntry("", "body"),
            "driven joint -> the body that it turns; for a slide, the sliding body",
            refers="joint",
        ),
    },
    {
        "$schema": TextEntry("where this schema lies; for editors"),
        "name": TextEntry("name of the mechanism in messages"),
        "units": ChoiceEntry("plain numbers are in SI and radians; default: every quantity needs its unit", ("SI",)),
        "confirm": ListEntry(
            "unusual data that are meant: lengths, a ratio of lengths above 200", ChoiceEntry("", ("lengths",)), 0, 1
        ),
        "values": names(QuantityEntry("", ()), "named values: quantities and expressions"),
        "gravity": GRAVITY,
        "links": replace(masses.SECTION, doc="section of every link without a section, a mass or shapes of its own"),
        "couplings": names(
            COUPLING, "name -> fixed ratio between two motions on one carrier", refers="coupling", most=MOST_ENTRIES
        ),
        "cylinders": names(
            CYLINDER,
            'name -> hydraulic or pneumatic cylinder; driven as inputs.NAME = "NAME.rod", by its length',
            most=MOST_ENTRIES,
        ),
        "branches": names(
            ChoiceEntry("", (1, -1)),
            "a group's free pin or slide -> the side on which it is assembled; not needed where the coordinates as "
            "drawn show it",
            refers="joint",
        ),
        "pose": names(
            _POSE, "body -> approximate pose when assembled; for groups without a closed form", refers="body"
        ),
        "redundant": ListEntry(
            "joints that stand still by constraints elsewhere, as written by --as; found in a drawing without this key",
            TextEntry("", "joint"),
            0,
            50,
        ),
        "loads": names(LOAD, "name -> force, torque, friction or drag", most=MOST_ENTRIES),
        "springs": names(SPRING, "name -> spring between two bodies", most=MOST_ENTRIES),
        "dampers": names(DAMPER, "name -> damper between two bodies", most=MOST_ENTRIES),
        "friction": names(FRICTION, "joint -> friction in it", refers="joint"),
        "pins": names(masses.PIN, "joint -> its pin as a machine element", refers="joint"),
        "motions": names(MOTION, "driven joint or body -> its motion over time", refers="input"),
        "forward": tasks.FORWARD,
        "study": tasks.STUDY,
        "servo": TextEntry("driven joint or body, or actuator, for which a servo motor is chosen", "input"),
        "actuators": names(
            ChoiceEntry("", ("torque", "force")),
            "joint with a motor -> its effort; as many as inputs, in whose place they drive the motion",
            refers="joint",
        ),
        "paths": ListEntry(
            "points whose paths are drawn and listed; default: all points that are no joints",
            SPOT,
            0,
            50,
        ),
        "transmission": ListEntry(
            "pins at which the transmission angle is listed; default: every free pin of a dyad",
            TextEntry("", "joint"),
            0,
            50,
        ),
    },
)


def machine_of(data: Table, source: SourceText) -> OwnMachine:
    """The records from data that satisfy the schema."""
    mechanism = mechanism_of(data, source)
    if len(mechanism.joints) > MOST_ENTRIES:
        given = f"{mechanism.name} has {len(mechanism.joints)} joints of two bodies"
        source.refuse(("joints",), MechanismError(given, allowed=f"at most {MOST_ENTRIES}"))
    parts, bodies = parts_of(data["joints"], mechanism), data["bodies"]
    members, inertias = _masses(data, mechanism, source)
    pins = masses.pin_members(data.get("pins", {}), parts, source)
    loads = loads_of(data, mechanism, source)
    actuators = tasks.actuators_of(data.get("actuators", {}), parts, mechanism, source)
    return OwnMachine(
        mechanism,
        inertias,
        gravity_of(data.get("gravity")),
        loads,
        frictions_of(data.get("friction", {}), parts, pins, source),
        members,
        pins,
        motions_of(data.get("motions", {}), mechanism, source),
        tasks.forward_of(data.get("forward"), mechanism, loads, source),
        tasks.study_of(data.get("study"), mechanism, source),
        tasks.servo_of(data.get("servo"), mechanism, actuators, source),
        tasks.paths_of(data.get("paths", ()), mechanism, source),
        tasks.transmission_of(data.get("transmission", ()), parts, source),
        {name: masses.shapes_of(table, mechanism.body(name)) for name, table in bodies.items() if "shapes" in table},
        frozenset(name for name, table in bodies.items() if name != GROUND and not table.keys() & masses.STATED),
        actuators,
    )


def _masses(data: Table, mechanism: Mechanism, source: SourceText) -> tuple[dict[str, FlatMember], dict[str, Inertia]]:
    """Sections and inertias of the bodies."""
    bodies = members_of(data["joints"])
    joints = {name: [joint for joint, own in bodies.items() if name in own] for name in data["bodies"]}
    sections = masses.sections_of(data["bodies"], data.get("links"), mechanism, joints)
    members, inertias = {}, {}
    for name, table in data["bodies"].items():
        with source.located(*(("links",) if "section" not in table and name in sections else ("bodies", name))):
            if name in sections:
                members[name] = masses.flat_member(sections[name])
                masses.check_link(mechanism.body(name), joints[name])
        with source.located("bodies", name):
            inertia = masses.inertia_of(table, mechanism.body(name), members.get(name))
            if inertia is not None:
                inertias[name] = inertia
    return members, inertias


def machine_data(machine: OwnMachine) -> JsonObject:
    """The data of a machine, as `FILE` reads them and writes them.

    Raises MechanismError for a load or motion that no file can express.
    """
    mechanism = machine.mechanism
    units = {entry.name: unit_of(entry) for entry in mechanism.inputs}
    driving = "rad" if "rad" in units.values() else "m"
    loads = {named.name: named.load for named in machine.loads}
    springs = {name: load for name, load in loads.items() if isinstance(load, Spring | TorsionSpring)}
    data: JsonObject = {
        "name": mechanism.name,
        "confirm": ["lengths"] if _needs_confirmation(mechanism) else [],
        "gravity": xy_of(machine.gravity) if machine.gravity else None,
        "servo": machine.servo,
        "actuators": {name: tasks.effort_of(mechanism.joint(name)) for name in machine.actuators},
        "paths": machine.paths,
        "redundant": list(mechanism.redundant),
        "transmission": list(machine.transmission),
        "bodies": {
            body.name: masses.body_data(body, machine.inertias.get(body.name), machine.members.get(body.name))
            for body in mechanism.bodies
        },
        "joints": {joint.name: joint_data(joint) for joint in mechanism.joints},
        "couplings": {coupling.name: coupling_data(coupling) for coupling in mechanism.couplings},
        "inputs": {entry.joint: driven_body(entry, mechanism) for entry in mechanism.inputs},
        "branches": dict(mechanism.branches),
        "pose": {body: {"origin": xy_of(origin), "angle": angle} for body, (origin, angle) in mechanism.pose.items()},
        "loads": {name: load_data(name, load, mechanism) for name, load in loads.items() if name not in springs},
        "springs": {name: spring_data(spring) for name, spring in springs.items()},
        "friction": {friction.joint: friction_data(friction) for friction in machine.frictions},
        "pins": {joint: masses.PIN.given(pin) for joint, pin in machine.pins.items()},
        "motions": {name: motion_data(name, motion, units[name]) for name, motion in machine.motions.items()},
        "forward": tasks.forward_data(machine.forward, driving) if machine.forward else {},
        "study": {"speeds": [Measured(speed, f"{driving}/s") for speed in machine.study.speeds]}
        if machine.study
        else {},
    }
    return {key: value for key, value in data.items() if value or key in {"name", *FILE.required}}


def _needs_confirmation(mechanism: Mechanism) -> bool:
    points = {body.name: body.points for body in mechanism.bodies}
    extremes = extreme_lengths(points, {joint.name: joint.bodies for joint in mechanism.joints})
    return extremes is not None and extremes[1].length > LARGEST_RATIO * extremes[0].length
