"""JSON of pylinkage: joints in the plane, each by distances from others; lengths without a unit are millimetres.

A Static joint is a point of the ground; a Crank turns about its joint0; a Revolute has two links, from joint0 and from
joint1; a Fixed is a point of the body that has joint0 and joint1. Positions follow from the distances, on the side
where the file has them.
"""

import cmath
from dataclasses import dataclass

from ilmek.errors import MechanismError, shortened
from ilmek.io.imports.foreign import Foreign, number
from ilmek.io.imports.sketch import Drive, Sketch
from ilmek.io.mechanism.points import third_corner
from ilmek.linkage.model import GROUND
from ilmek.records import JsonObject
from ilmek.units import mm

Entry = JsonObject


def pylinkage_data(data: Entry) -> Foreign:
    """A mechanism file's data. Raises MechanismError for joints that are unknown, or hang on one another."""
    entries = data["joints"]
    if not all(isinstance(entry, dict) and isinstance(entry.get("name"), str) for entry in entries):
        raise MechanismError("has a joint without a name", allowed="joints with type and name")
    given = data.get("name")
    built = _Build(Sketch(given if isinstance(given, str) and given else "linkage"))
    waiting = sorted(entries, key=lambda entry: entry.get("type") != "Static")
    while waiting:
        ready = [entry for entry in waiting if all(name in built.sketch.points for name in built.references(entry))]
        if not ready:
            raise MechanismError(f"joint {shortened(waiting[0]['name'])!r} depends on itself, or on an unknown joint")
        for entry in ready:
            built.add(entry)
        waiting = [entry for entry in waiting if entry not in ready]
    built.sketch.left_out += ["solve_order"] if data.get("solve_order") else []
    return built.sketch.foreign()


@dataclass(slots=True)
class _Build:
    """The joints whose positions are known so far."""

    sketch: Sketch

    def references(self, entry: Entry) -> list[str]:
        """Names of the joints on which one hangs; a point given in place is added to the ground."""
        names = []
        for key in ("joint0", "joint1", "joint2"):
            given = entry.get(key)
            if not isinstance(given, dict):
                continue
            name = given.get("ref") or given.get("name")
            if not isinstance(name, str):
                raise MechanismError(f"{key} of {shortened(entry['name'])!r} has no name")
            if given.get("inline") and name not in self.sketch.points:
                self._static(given, name)
            names.append(name)
        return names

    def add(self, entry: Entry) -> None:
        """A joint whose references are known."""
        kind, name, ends = entry.get("type"), entry["name"], self.references(entry)
        needed = {"Static": 0, "Crank": 1, "Revolute": 2, "Fixed": 2}.get(str(kind))
        if needed is None:
            allowed = "Static, Crank, Revolute and Fixed"
            raise MechanismError(f"joint {shortened(name)!r} is of type {shortened(repr(kind))}", allowed=allowed)
        at = [self.sketch.points[end] for end in ends]
        if len(ends) < needed or (needed == 2 and at[0] == at[1]):
            raise MechanismError(
                f"joint {shortened(name)!r} needs {needed} other joints", allowed="apart from one another"
            )
        if kind == "Static":
            self._static(entry, name)
        elif kind == "Crank":
            angle = cmath.phase(self._hint(entry, at[0] + 1) - at[0])
            self.sketch.points[name] = at[0] + cmath.rect(self._length(entry, "distance"), angle)
            self.sketch.inputs[ends[0]] = Drive(self.sketch.body(name, [ends[0], name]))
            self.sketch.left_out.append(f"angle of each step of crank {name}: give the speed")
        elif kind == "Revolute":
            hint = self._hint(entry, at[0] + 1j * (at[1] - at[0]))
            left = ((at[1] - at[0]).conjugate() * (hint - at[0])).imag >= 0
            sides = self._length(entry, "distance0"), self._length(entry, "distance1")
            self.sketch.points[name] = third_corner(at[0], at[1], *sides, left=left)
            for end in ends[:2]:
                self.sketch.body(f"{end}-{name}", [end, name])
        else:
            self._fixed(entry, name, *ends[:2])

    def _static(self, entry: Entry, name: str) -> None:
        at = complex(number(entry.get("x"), f"x of {name}"), number(entry.get("y"), f"y of {name}"))
        self.sketch.points[name] = at * mm
        self.sketch.bodies[GROUND].append(name)

    def _fixed(self, entry: Entry, name: str, first: str, second: str) -> None:
        arm = cmath.rect(self._length(entry, "distance"), number(entry.get("angle"), f"angle of {name}"))
        base = self.sketch.points[second] - self.sketch.points[first]
        bodies = self.sketch.carriers(first, second)
        if not bodies:
            raise MechanismError(
                f"joint {shortened(name)!r} is fixed to {first} and {second}", allowed="joints of one body"
            )
        self.sketch.points[name] = self.sketch.points[first] + arm * base / abs(base)
        self.sketch.bodies[bodies[0]].append(name)

    def _length(self, entry: Entry, key: str) -> float:
        length = number(entry.get(key), f"{key} of {entry['name']}")
        if not length > 0:
            raise MechanismError(f"{key} of {shortened(entry['name'])!r} is {length:g}", allowed="above 0")
        return length * mm

    def _hint(self, entry: Entry, default: complex) -> complex:
        if entry.get("x") is None or entry.get("y") is None:
            return default
        return complex(number(entry["x"], "x"), number(entry["y"], "y")) * mm
