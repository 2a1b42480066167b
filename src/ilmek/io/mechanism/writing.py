"""A machine as the data of a file: what `ilmek.io.mechanism_file` reads again without loss."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeGuard

from ilmek.dynamics.friction import AngleRange, Friction, ValueRange, WindowedLoad
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.input_loads import Drag, FollowerForce, TabulatedLoad
from ilmek.dynamics.joint_friction import JointFriction, PinFriction
from ilmek.dynamics.loads import Load, PointForce, Torque
from ilmek.dynamics.own_machine import (
    FlatMember,
    ForwardTask,
    GivenMotion,
    MotorDrive,
    OwnMachine,
    PinMember,
    StopEvent,
)
from ilmek.dynamics.springs import Spring, TorsionSpring
from ilmek.errors import MechanismError
from ilmek.io.mechanism.loads import TIME
from ilmek.io.mechanism.motions import ConstantSpeed, MotionSequence, MotionStep, TableMotion
from ilmek.io.mechanism.names import driven_body
from ilmek.io.mechanism.pairs import CamLift, LiftTable
from ilmek.io.mechanism.points import LARGEST_RATIO, extreme_lengths
from ilmek.io.mechanism.tasks import effort_of
from ilmek.io.toml_text import written_quantity
from ilmek.linkage.geneva import Geneva
from ilmek.linkage.model import Body, Coupling, Joint, Mechanism, Pin, Rotation
from ilmek.report import Json

_SI_UNITS = {"mm": "m", "deg": "rad", "mm/rad": "m/rad", "MPa": "Pa", "MPa*m/s": "Pa*m/s", "h": "s"}
"""Unit in which a quantity is written -> the SI unit that is exact for any number."""


def machine_data(machine: OwnMachine, *, si: bool) -> dict[str, Json]:
    """The data of a machine that satisfy the schema; with `si` plain numbers, else texts with units.

    Raises MechanismError for a load or motion that no file can express.
    """
    return _Writer(si).machine(machine)


@dataclass(frozen=True, slots=True)
class _Writer:
    """Writes records as data, numbers in SI or as texts with units."""

    si: bool

    def quantity(self, value: float, unit: str) -> float | str:
        """A quantity that is read as the same number again; 0, and -0, without a unit."""
        if self.si or value == 0 or unit == "1":
            return float(value)
        found = written_quantity(value, unit)
        if isinstance(found, str):
            return found
        return f"{value!r}{_SI_UNITS.get(unit, unit)}"

    def xy(self, point: complex, unit: str = "mm") -> list[float | str]:
        return [self.quantity(float(point.real), unit), self.quantity(float(point.imag), unit)]

    def machine(self, one: OwnMachine) -> dict[str, Json]:
        mechanism = one.mechanism
        data: dict[str, Json] = {"name": mechanism.name}
        if self.si:
            data["units"] = "SI"
        if _needs_confirmation(mechanism):
            data["confirm"] = ["lengths"]
        if one.gravity:
            data["gravity"] = self.xy(one.gravity, "m/s^2")
        turning = {entry.name: isinstance(entry, Rotation) for entry in mechanism.inputs}
        further: dict[str, Json] = {
            "servo": one.servo,
            "actuators": {name: effort_of(mechanism.joint(name)) for name in one.actuators},
            "paths": [list(spot) for spot in one.paths],
            "redundant": list(mechanism.redundant),
            "transmission": list(one.transmission),
        }
        data |= {key: value for key, value in further.items() if value}
        data["bodies"] = {
            body.name: self.body(body, one.inertias.get(body.name), one.members.get(body.name))
            for body in mechanism.bodies
        }
        data["joints"] = {joint.name: self.joint(joint) for joint in mechanism.joints}
        tables: dict[str, Json] = {
            "couplings": {coupling.name: self.coupling(coupling) for coupling in mechanism.couplings},
            "inputs": {entry.joint: driven_body(entry, mechanism) for entry in mechanism.inputs},
            "branches": dict(mechanism.branches),
            "pose": {
                body: {"origin": self.xy(at), "angle": self.quantity(float(angle), "deg")}
                for body, (at, angle) in mechanism.pose.items()
            },
            "loads": {
                load.name: self.load(load.name, load.load, turning) for load in one.loads if not _is_spring(load.load)
            },
            "springs": {load.name: self.spring(load.load) for load in one.loads if _is_spring(load.load)},
            "friction": {friction.joint: self.friction(friction) for friction in one.frictions},
            "pins": {joint: self.pin(pin) for joint, pin in one.pins.items()},
            "motions": {name: self.motion(name, motion, turning[name]) for name, motion in one.motions.items()},
            "forward": self.forward(one.forward, any(turning.values())) if one.forward else {},
            "study": {
                "speeds": [
                    self.quantity(speed, "rad/s" if any(turning.values()) else "m/s") for speed in one.study.speeds
                ]
            }
            if one.study
            else {},
        }
        return data | {key: value for key, value in tables.items() if value or key == "inputs"}

    def body(self, body: Body, inertia: Inertia | None, member: FlatMember | None) -> dict[str, Json]:
        data: dict[str, Json] = {"points": {name: self.xy(point) for name, point in body.points.items()}}
        if inertia is not None:
            data["mass"] = self.quantity(float(inertia.mass), "kg")
            data["centre"] = self.xy(inertia.centre)
            data["moment"] = self.quantity(float(inertia.moment), "kg*m^2")
        if member is not None:
            units = {"width": "mm", "thickness": "mm", "stress": "MPa", "safety": "1"}
            given = {key: getattr(member, key) for key in units if getattr(member, key) is not None}
            section = {key: self.quantity(value, units[key]) for key, value in given.items()}
            data["section"] = {**section, "material": member.material}
            data.setdefault("mass", 0)  # else the section would give the body a mass
        return data

    def joint(self, joint: Joint) -> dict[str, Json]:
        if isinstance(joint, Pin):
            return {"pin": list(joint.bodies)}
        angles = {key: self.quantity(float(getattr(joint, key)), "deg") for key in ("along", "turned")}
        return {"slide": list(joint.bodies), **angles}

    def coupling(self, one: Coupling) -> dict[str, Json]:
        units = {"first_at": "deg", "second_at": "mm" if one.slides else "deg"}
        if one.law is None:
            units["ratio"] = "mm/rad" if one.slides else "1"
        if one.kind in ("gears", "rack"):
            units["pressure_angle"] = "deg"
        numbers = {key: self.quantity(float(getattr(one, key)), unit) for key, unit in units.items()}
        ends: list[Json] = [list(one.first), list(one.second)]
        units = {"radius": "mm", "pretension": "N", "friction": "1"}
        given = {key: getattr(one.spans, key, None) for key in units}
        spans = {key: self.quantity(value, units[key]) for key, value in given.items() if value is not None}
        return {one.kind: ends, "carrier": one.carrier, **numbers, **spans, **self.pair(one)}

    def pair(self, one: Coupling) -> dict[str, Json]:
        """The law and the contact of a higher pair."""
        law, roller = one.law, {"roller": one.roller} if one.roller else {}
        if law is None:
            return {}
        if isinstance(law, Geneva):
            return {"slots": law.slots}
        unit = "mm" if law.slides else "deg"
        if isinstance(law, LiftTable):
            pairs = zip(law.angles, law.lifts, strict=True)
            rows: list[Json] = [[self.quantity(at, "deg"), self.quantity(lift, unit)] for at, lift in pairs]
            return {**roller, "groove": law.groove, "table": rows}
        if isinstance(law, CamLift):
            return {**roller, "groove": law.groove, "lift": [self.step(step, unit, "over") for step in law.steps]}
        raise MechanismError(f"the law of {one.name!r} is a function that no file expresses")

    def load(self, name: str, load: Load, turning: Mapping[str, bool]) -> dict[str, Json]:
        if isinstance(load, WindowedLoad) and _is_default(load.side):
            return {**self.load(name, load.load, turning), "while": self.window(load.window, load.input_name, turning)}
        if isinstance(load, TabulatedLoad) and load.turns == turning.get(load.input_name or "", False):
            inner = self.load(name, load.load, turning)
            unit = "N" if "force" in inner else "N*m"
            at = "s" if load.input_name is None else "deg" if load.turns else "mm"
            rows = [[self.quantity(x, at), self.quantity(y, unit)] for x, y in zip(load.at, load.factors, strict=True)]
            return {**inner, "over": load.input_name or TIME, "table": rows}
        if isinstance(load, PointForce | FollowerForce) and isinstance(load.point, str) and _is_complex(load.force):
            frame = "body" if isinstance(load, FollowerForce) else "ground"
            return {"force": self.xy(complex(load.force), "N"), "on": [load.body, load.point], "frame": frame}
        if isinstance(load, Torque) and _is_real(load.torque):
            return {"torque": self.quantity(float(load.torque), "N*m"), "on": load.body}
        if isinstance(load, Drag):
            return {"drag": self.quantity(load.coefficient, "N*s/m"), "on": [load.body, load.point]}
        if (
            isinstance(load, Friction)
            and isinstance(load.point, str)
            and _is_real(load.magnitude)
            and _is_default(load.side)
        ):
            window = {} if load.window is None else {"while": self.window(load.window, load.input_name, turning)}
            force = self.quantity(float(load.magnitude), "N")
            return {"friction": force, "on": [load.body, load.point], "over": load.input_name, **window}
        raise MechanismError(f"load {name!r} is a function that no file expresses", do="write the others to the file")

    def window(self, window: AngleRange | ValueRange, name: str, turning: Mapping[str, bool]) -> dict[str, Json]:
        unit = "deg" if turning.get(name) else "mm"
        return {"input": name, "from": self.quantity(window.start, unit), "to": self.quantity(window.end, unit)}

    def spring(self, load: Load) -> dict[str, Json]:
        if isinstance(load, Spring):
            ends = [[load.first, load.first_point], [load.second, load.second_point]]
            units = {"stiffness": "N/m", "length": "mm", "damping": "N*s/m"}
            return {"between": ends, **{key: self.quantity(getattr(load, key), unit) for key, unit in units.items()}}
        units = {"stiffness": "N*m/rad", "angle": "deg", "damping": "N*m*s/rad"}
        ends_of = [getattr(load, key) for key in ("first", "second")]
        return {"torsion": ends_of, **{key: self.quantity(getattr(load, key), unit) for key, unit in units.items()}}

    def friction(self, one: JointFriction) -> dict[str, Json]:
        pin = isinstance(one, PinFriction)
        size, unit = ("radius", "N*m*s/rad") if pin else ("breadth", "N*s/m")
        return {
            "coefficient": self.quantity(one.coefficient, "1"),
            size: self.quantity(getattr(one, size), "mm"),
            "drag": self.quantity(one.drag, unit),
        }

    def pin(self, pin: PinMember) -> dict[str, Json]:
        units = {"diameter": "mm", "length": "mm", "life": "h", "wear": "MPa*m/s"}
        units |= dict.fromkeys(("shear", "bending", "pressure"), "MPa")
        data: dict[str, Json] = {key: self.quantity(getattr(pin, key), unit) for key, unit in units.items()}
        data["fork"] = pin.fork
        return data if pin.bearing is None else {**data, "bearing": pin.bearing}

    def motion(self, name: str, motion: GivenMotion, turning: bool) -> dict[str, Json]:
        unit = "deg" if turning else "mm"
        law = motion.law
        if isinstance(law, ConstantSpeed):
            speed = self.quantity(law.speed, "rad/s" if turning else "m/s")
            return {"speed": speed, "start": self.quantity(law.start, unit)}
        if isinstance(law, TableMotion):
            pairs = zip(law.times, law.values, strict=True)
            rows = [[self.quantity(time, "s"), self.quantity(value, unit)] for time, value in pairs]
            return {"table": rows, "repeat": law.repeats}
        if isinstance(law, MotionSequence):
            steps = [self.step(step, unit) for step in law.steps]
            return {"start": self.quantity(law.start, unit), "steps": steps, "repeat": law.repeats}
        raise MechanismError(f"the motion of {name!r} is a function that no file expresses")

    def step(self, step: MotionStep, unit: str, over: str = "time") -> dict[str, Json]:
        parameters = {
            key: list(value) if isinstance(value, tuple) else value for key, value in step.law.parameters.items()
        }
        law = {"name": step.law.name, **parameters} if parameters else step.law.name
        duration = self.quantity(step.time, "s" if over == "time" else "deg")
        return {"to": self.quantity(step.to, unit), over: duration, "law": law}

    def forward(self, task: ForwardTask, turning: bool) -> dict[str, Json]:
        unit, speed = ("deg", "rad/s") if turning else ("mm", "m/s")
        data: dict[str, Json] = {
            "duration": self.quantity(task.duration, "s"),
            "position": self.quantity(task.position, unit),
            "speed": self.quantity(task.speed, speed),
        }
        if task.drive is not None:
            data["motor"] = self.motor(task.drive, turning)
        if task.events:
            units = {"position": unit, "speed": speed, "time": "s"}
            data["events"] = {event.name: self.event(event, units[event.of]) for event in task.events}
        return data

    def motor(self, drive: MotorDrive, turning: bool) -> dict[str, Json]:
        effort, unit, inertia = ("torque", "N*m", "kg*m^2") if turning else ("force", "N", "kg")
        data: dict[str, Json] = {effort: self.quantity(drive.effort, unit)}
        if drive.speed is not None:
            data["speed"] = self.quantity(drive.speed, "rad/s" if turning else "m/s")
        return {**data, "slip": self.quantity(drive.slip, "1"), "inertia": self.quantity(drive.inertia, inertia)}

    def event(self, event: StopEvent, unit: str) -> dict[str, Json]:
        direction = {1: "up", -1: "down", 0: "both"}[event.direction]
        return {event.of: self.quantity(event.value, unit), "direction": direction, "stop": event.terminal}


def _is_real(value: object) -> TypeGuard[float]:
    return isinstance(value, int | float)


def _is_complex(value: object) -> TypeGuard[complex]:
    return isinstance(value, int | float | complex)


def _is_default(side: object) -> bool:
    return isinstance(side, float) and side == 1.0


def _is_spring(load: Load) -> bool:
    return isinstance(load, Spring | TorsionSpring)


def _needs_confirmation(mechanism: Mechanism) -> bool:
    points = {body.name: body.points for body in mechanism.bodies}
    extremes = extreme_lengths(points, {joint.name: joint.bodies for joint in mechanism.joints})
    return extremes is not None and extremes[1].length > LARGEST_RATIO * extremes[0].length
