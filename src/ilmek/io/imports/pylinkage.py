"""JSON of pylinkage: joints in the plane, each by distances from others; lengths without a unit are millimetres.

A Static joint is a point of the ground; a Crank turns about its joint0; a Revolute has two links, from joint0 and from
joint1; a Fixed is a point of the body that has joint0 and joint1. Positions follow from the distances, on the side
where the file has them.
"""

import cmath
from dataclasses import dataclass, field

from ilmek.errors import MechanismError, shortened
from ilmek.io.imports.foreign import Foreign, number
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
    built = _Build({entry["name"]: entry for entry in entries})
    waiting = sorted(entries, key=lambda entry: entry.get("type") != "Static")
    while waiting:
        ready = [entry for entry in waiting if all(name in built.at for name in built.references(entry))]
        if not ready:
            raise MechanismError(f"joint {shortened(waiting[0]['name'])!r} depends on itself, or on an unknown joint")
        for entry in ready:
            built.add(entry)
        waiting = [entry for entry in waiting if entry not in ready]
    joints = {}
    for name in built.at:
        bodies = [body for body, points in built.bodies.items() if name in points]
        if len(bodies) > 1:
            joints[name] = {"pin": bodies}
    points = {
        body: {"points": {name: [built.at[name].real * mm, built.at[name].imag * mm] for name in names}}
        for body, names in built.bodies.items()
    }
    left_out = (*built.left_out, *(["solve_order"] if data.get("solve_order") else []))
    given = data.get("name")
    whole = {"name": given if isinstance(given, str) and given else "linkage", "units": "SI", "confirm": ["lengths"]}
    return Foreign({**whole, "bodies": points, "joints": joints, "inputs": built.inputs}, left_out)


@dataclass(slots=True)
class _Build:
    """Positions of the joints found so far, bodies with their joints, and the cranks."""

    entries: dict[str, Entry]
    at: dict[str, complex] = field(default_factory=dict)
    bodies: dict[str, list[str]] = field(default_factory=lambda: {GROUND: []})
    inputs: dict[str, str] = field(default_factory=dict)
    left_out: list[str] = field(default_factory=list)

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
            if given.get("inline") and name not in self.at:
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
        if len(ends) < needed or (needed == 2 and self.at[ends[0]] == self.at[ends[1]]):
            raise MechanismError(
                f"joint {shortened(name)!r} needs {needed} other joints", allowed="apart from one another"
            )
        if kind == "Static":
            self._static(entry, name)
        elif kind == "Crank":
            centre, length = self.at[ends[0]], self._length(entry, "distance")
            self.at[name] = centre + cmath.rect(length, cmath.phase(self._hint(entry, centre + 1) - centre))
            self.bodies[name] = [ends[0], name]
            self.inputs[ends[0]] = name
            self.left_out.append(f"angle of each step of crank {name}: give the speed")
        elif kind == "Revolute":
            self._revolute(entry, name, *ends[:2])
        else:
            self._fixed(entry, name, *ends[:2])

    def _static(self, entry: Entry, name: str) -> None:
        self.at[name] = complex(number(entry.get("x"), f"x of {name}"), number(entry.get("y"), f"y of {name}"))
        self.bodies[GROUND].append(name)

    def _revolute(self, entry: Entry, name: str, first: str, second: str) -> None:
        start, end = self.at[first], self.at[second]
        sides = self._length(entry, "distance0"), self._length(entry, "distance1")
        hint = self._hint(entry, start + 1j * (end - start))
        left = ((end - start).conjugate() * (hint - start)).imag >= 0
        self.at[name] = third_corner(start, end, *sides, left=left)
        self.bodies |= {f"{first}-{name}": [first, name], f"{second}-{name}": [second, name]}

    def _fixed(self, entry: Entry, name: str, first: str, second: str) -> None:
        arm = cmath.rect(self._length(entry, "distance"), number(entry.get("angle"), f"angle of {name}"))
        base = self.at[second] - self.at[first]
        self.at[name] = self.at[first] + arm * base / abs(base)
        body = next((body for body, names in self.bodies.items() if {first, second} <= set(names)), None)
        if body is None:
            raise MechanismError(
                f"joint {shortened(name)!r} is fixed to {first} and {second}", allowed="joints of one body"
            )
        self.bodies[body].append(name)

    def _length(self, entry: Entry, key: str) -> float:
        length = number(entry.get(key), f"{key} of {entry['name']}")
        if not length > 0:
            raise MechanismError(f"{key} of {shortened(entry['name'])!r} is {length:g}", allowed="above 0")
        return length

    def _hint(self, entry: Entry, default: complex) -> complex:
        if entry.get("x") is None or entry.get("y") is None:
            return default
        return complex(number(entry["x"], "x"), number(entry["y"], "y"))
