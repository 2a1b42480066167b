"""Six machines of mechanism files, against Lagrange's multipliers (`tests.support.multipliers`).

Dimensions, masses and loads are written here a second time, by hand, from the tables of the reference.
"""

import cmath
import dataclasses
from collections.abc import Sequence
from itertools import pairwise
from math import pi, radians, tan
from pathlib import Path

import numpy as np
import pytest
from tests.support.multipliers import TORQUE, Case, Force, Part, dot

import ilmek

FILES = Path(__file__).with_name("own_mechanisms")
STEEL = 7850.0
"""Density of structural steel [kg/m³]."""


def bar(start: complex, end: complex, width: float, thickness: float) -> Part:
    """A bar with round ends: a rectangle between the two points, and half a disc about each of them."""
    length, radius = abs(end - start), width / 2
    flat, disc = STEEL * thickness * length * width, STEEL * thickness * pi * radius**2
    ends = disc * (radius**2 / 2 + length**2 / 4 + length * 4 * radius / (3 * pi))
    return Part(flat + disc, (start + end) / 2, flat * (length**2 + width**2) / 12 + ends)


def triangle(a: complex, b: complex, c: complex, areal: float) -> Part:
    """A plate of `areal` [kg/m²]; its second moment is that of half-mass points at the middles of the sides, thirds."""
    mass = areal * abs(((b - a).conjugate() * (c - a)).imag) / 2
    centre = (a + b + c) / 3
    middles = ((a + b) / 2, (b + c) / 2, (c + a) / 2)
    return Part(mass, centre, mass / 3 * sum(abs(one - centre) ** 2 for one in middles))


def polar(radius: float, angle: float) -> complex:
    return cmath.rect(radius, radians(angle))


def corner(a: float, b: float, c: float, side: int) -> complex:
    """The third corner of a triangle on (0, 0) and (a, 0), at distances b and c from them."""
    x = (a * a + b * b - c * c) / (2 * a)
    return complex(x, side * np.sqrt(b * b - x * x))


def within(q: np.ndarray, start: float, end: float) -> bool:
    """Whether the first body's angle is in a window [deg], which may go through 0."""
    at = np.degrees(q[2])
    return (at - start) % 360 <= (end - start) % 360


def pump_loads(case: Case, q: np.ndarray, v: np.ndarray) -> list[Force]:
    piston, speed = case.rate(q, v, "piston", 0), abs(case.rate(q, v, "piston", 0))
    to = 0.19 + 0.0111j - case.spot(q, "piston", 0.015)[0]
    along = to / abs(to)
    pull = 2400 * (abs(to) - 0.06) + 3 * dot(along, -piston)
    forces: list[Force] = [("piston", 0.015, pull * along), ("piston", 0, -14 * piston)]
    if speed > 1e-9:
        forces.append(("piston", 0, -22 * piston / speed))
    if within(q, 200, 350):
        forces.append(("piston", 0.015, -850 + 0j))
    return forces


def pump() -> Case:
    r, rod = 0.037, 3.1 * 0.037
    disc = 7200 * 0.012 * pi * 0.016**2
    crank = bar(0, r, 0.018, 0.009) + Part(disc, -0.012, disc * 0.016**2 / 2)
    return Case(
        {"crank": crank, "rod": bar(0, rod, 0.014, 0.006), "piston": Part(0.62)},
        [("O", "ground", 0, "crank", 0), ("A", "crank", r, "rod", 0), ("B", "rod", rod, "piston", 0)],
        {"crank": (0j, 0.0), "rod": (0.037 + 0j, 0.1), "piston": (0.15 + 0.011j, 0.0)},
        slides=[("way", "piston", 0, "ground", 0.0111j, 0.0)],
        gravity=polar(9.81, -60),
        loads=pump_loads,
    )


def closed(points: Sequence[complex], width: float, thickness: float) -> Part:
    total = bar(points[-1], points[0], width, thickness)
    for start, end in pairwise(points):
        total = total + bar(start, end, width, thickness)
    return total


def six_bar() -> Case:
    k, wide, thick = 0.05, 0.022, 0.008
    a0, b0, d0 = 0j, complex(3.9, -0.6) * k, complex(5.2, 1.7) * k
    top, tip = corner(3.3 * k, 2.1 * k, 1.9 * k, 1), polar(3.5 * k, -20)
    parts = {
        "crank": bar(0, k, wide, thick),
        "coupler": closed((0, 3.3 * k, top), wide, thick),
        "rocker": bar(0, 2.4 * k, wide, thick),
        "rod": bar(0, 3 * k, wide, thick),
        "comb": closed((0, 2.2 * k, tip), wide, thick),
    }

    def fell(case: Case, q: np.ndarray, v: np.ndarray) -> list[Force]:
        turned = cmath.exp(1j * case.angle(q, "comb"))
        return [("comb", tip, 120j * turned)] if within(q, 300, 20) else []

    return Case(
        parts,
        [
            ("A0", "ground", a0, "crank", 0),
            ("A", "crank", k, "coupler", 0),
            ("B", "coupler", 3.3 * k, "rocker", 0),
            ("B0", "ground", b0, "rocker", 2.4 * k),
            ("C", "coupler", top, "rod", 0),
            ("D", "rod", 3 * k, "comb", 0),
            ("D0", "ground", d0, "comb", 2.2 * k),
        ],
        {
            "crank": (0j, 0.26),
            "coupler": (0.05 + 0j, 0.4),
            "rocker": (0.19 + 0.09j, -1.5),
            "rod": (0.1 + 0.12j, -0.8),
            "comb": (0.18 + 0.01j, 0.8),
        },
        loads=fell,
    )


def klann() -> Case:
    r, wide, thick = 0.025, 0.016, 0.005
    foot, c = corner(1.77 * r, 5.6 * r, 4 * r, -1), polar(3.5 * r, 9)
    parts = {
        "crank": Part(0.11, 0.4 * r, 2.4e-5),
        "connector": closed((0, 3 * r, c), wide, thick),
        "low": bar(0, 1.62 * r, wide, thick),
        "high": bar(0, 2.2 * r, wide, thick),
        "leg": triangle(0, 1.77 * r, foot, 2700 * 0.005),
    }

    def step(case: Case, q: np.ndarray, v: np.ndarray) -> list[Force]:
        return [("leg", foot, 70j)] if within(q, 120, 260) else []

    return Case(
        parts,
        [
            ("M", "ground", 0, "crank", 0),
            ("A", "crank", r, "connector", 0),
            ("B", "connector", 3 * r, "low", 0),
            ("Ob", "ground", complex(-2.7, -1.65) * r, "low", 1.62 * r),
            ("C", "connector", c, "leg", 1.77 * r),
            ("D", "leg", 0, "high", 0),
            ("Oc", "ground", complex(-2.5, 1.65) * r, "high", 2.2 * r),
        ],
        {
            "crank": (0j, 0.0),
            "connector": (0.025 + 0j, 3.1),
            "low": (-0.05 + 0j, -2.0),
            "high": (-0.1 + 0.02j, 0.8),
            "leg": (-0.1 + 0.02j, -0.7),
        },
        loads=step,
    )


def shaper() -> Case:
    parts = {
        "crank": Part(3.0, 0.02, 0.02),
        "block": Part(0.5, 0, 2e-4),
        "arm": bar(0, 0.45, 0.05, 0.016),
        "rod": bar(0, 0.14, 0.03, 0.01),
        "ram": Part(18.0),
    }

    def cut(case: Case, q: np.ndarray, v: np.ndarray) -> list[Force]:
        return [("ram", 0, 900 + 0j)] if within(q, 10, 150) else []

    return Case(
        parts,
        [
            ("O", "ground", 0.21j, "crank", 0),
            ("A", "crank", 0.095, "block", 0),
            ("Q", "ground", 0, "arm", 0),
            ("P", "arm", 0.45, "rod", 0),
            ("B", "rod", 0.14, "ram", 0),
        ],
        {
            "crank": (0.21j, 0.0),
            "block": (0.095 + 0.21j, 1.15),
            "arm": (0j, 1.15),
            "rod": (0.2 + 0.4j, 0.4),
            "ram": (0.33 + 0.47j, 0.0),
        },
        slides=[("slot", "block", 0, "arm", 0, 0.0), ("way", "ram", 0, "ground", 0.47j, 0.0)],
        loads=cut,
    )


def geared() -> Case:
    a, wide, thick = 0.042, 0.02, 0.006
    tip = 0.105 + 0.03 + 0.02j
    lengths = {"left": a, "right": 0.8 * a, "u": 0.115}
    parts = {name: bar(0, length, wide, thick) for name, length in lengths.items()}

    def loads(case: Case, q: np.ndarray, v: np.ndarray) -> list[Force]:
        u, second = (3 * case.names.index(name) + 2 for name in ("u", "v"))
        twist = 1.5 * (q[second] - q[u] - radians(30)) + 0.01 * (v[second] - v[u])
        brush = float(np.interp(np.degrees(q[2]) % 360, [0, 90, 200, 360], [0.5, 2, -1, 0.5]))
        turning: list[Force] = [("u", TORQUE, twist + 0j), ("v", TORQUE, -twist + 0j), ("right", TORQUE, brush + 0j)]
        return [*turning, ("v", tip, polar(60, 250))]

    return Case(
        {**parts, "v": closed((0, 0.105, tip), wide, thick)},
        [
            ("A0", "ground", 0, "left", 0),
            ("B0", "ground", 0.1, "right", 0),
            ("A", "left", a, "u", 0),
            ("B", "right", 0.8 * a, "v", 0),
            ("C", "u", 0.115, "v", 0.105),
        ],
        {
            "left": (0j, 0.5),
            "right": (0.1 + 0j, -0.35),
            "u": (0.04 + 0.02j, 1.2),
            "v": (0.13 - 0.01j, 2.0),
        },
        gear=("left", "right", -2.0, radians(40), 0.1),
        loads=loads,
    )


def three_arms() -> Case:
    points = {"A": 0.045, "D": 0.21 + 0.06j, "S": 0.313 + 0.04j, "E": 0.23 + 0.152j, "T": 0.128 + 0.274j}
    points["F"], tip = 0.125 + 0.122j, 0.19 + 0.11j
    corners = [points[name] for name in "DEF"]
    arms = {f"arm{k + 1}": bar(points[a], points[b], 0.02, 0.008) for k, (a, b) in enumerate(("AD", "SE", "TF"))}

    def loads(case: Case, q: np.ndarray, v: np.ndarray) -> list[Force]:
        to = points["T"] - case.spot(q, "plate", tip)[0]
        along = to / abs(to)
        damped = -8 * dot(along, case.rate(q, v, "plate", tip)) * along
        return [("plate", tip, polar(45, 30) * cmath.exp(1j * case.angle(q, "plate"))), ("plate", tip, damped)]

    bodies = {"O": ("ground", "crank"), "A": ("crank", "arm1"), "D": ("arm1", "plate"), "S": ("ground", "arm2")}
    bodies |= {"E": ("arm2", "plate"), "T": ("ground", "arm3"), "F": ("arm3", "plate")}
    points["O"] = 0
    return Case(
        {"crank": Part(0.4, 0.01, 3e-4), **arms, "plate": triangle(*corners, STEEL * 0.008)},
        [(pin, first, points[pin], second, points[pin]) for pin, (first, second) in bodies.items()],
        dict.fromkeys(("crank", *arms, "plate"), (0j, 0.0)),
        loads=loads,
    )


CASES = {
    "offset_pump": pump,
    "six_bar": six_bar,
    "klann_leg": klann,
    "shaper": shaper,
    "geared_five_bar": geared,
    "triad": three_arms,
}


def with_friction(case: Case, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
    """The multipliers of the pump with friction: pins of 17, 10 and 10 mm, a guide of 50 mm; by substitution."""
    found, plain = case.solved(q, v, a), case.loads
    for _ in range(200):
        turns = []
        for number, (name, first, _, second, _) in enumerate(case.pins):
            speed = v[3 * case.names.index(second) + 2]
            speed -= 0.0 if first == "ground" else v[3 * case.names.index(first) + 2]
            limit = {"O": 0.08 * 0.0085}.get(name, 0.1 * 0.005) * float(np.hypot(*found[2 * number : 2 * number + 2]))
            turns += [(second, TORQUE, -limit * np.sign(speed)), (first, TORQUE, limit * np.sign(speed))]
        speed = case.rate(q, v, "piston", 0).real
        across, couple = found[6], found[7]
        slip = ("piston", 0j, -0.12 * max(abs(across), 2 * abs(couple) / 0.05) * np.sign(speed) + 0j)
        more = dataclasses.replace(case, loads=lambda *state, turns=turns, slip=slip: [*plain(*state), *turns, slip])
        last, found = found, more.solved(q, v, a)
        if np.abs(found - last).max() < 1e-13 * np.abs(found).max():
            break
    return found


@pytest.mark.parametrize("name", CASES)
def test_a_machine_of_a_file_has_the_forces_of_lagranges_multipliers(name: str) -> None:
    case = CASES[name]()
    machine = dataclasses.replace(ilmek.read_mechanism(str(FILES / f"{name}.toml")).machine, study=None, forward=None)
    found = ilmek.run_machine(machine, steps=37)
    table = {heading.split(" [")[0]: np.asarray(values) for heading, values in found.table().items()}
    first = case.names[0]
    q = np.array([part for at, angle in case.guess.values() for part in (at.real, at.imag, angle)])
    worst: dict[str, float] = {}

    def compare(quantity: str, found: float, expected: float, scale: float) -> None:
        worst[quantity] = max(worst.get(quantity, 0.0), abs(found - expected) / scale)

    for k, drive in enumerate(table[first]):
        q = case.located(q, drive)
        v, a = case.moved(q, table[f"{first} omega"][k], table[f"{first} alpha"][k])
        force = (with_friction if name == "offset_pump" else Case.solved)(case, q, v, a)
        for number, body in enumerate(case.names):
            turned = (table[f"{body} angle"][k] - q[3 * number + 2] + pi) % (2 * pi) - pi
            compare("angle", turned, 0.0, 1.0)
            compare("omega", table[f"{body} omega"][k], v[3 * number + 2], np.abs(table[f"{body} omega"]).max() + 1)
            compare("alpha", table[f"{body} alpha"][k], a[3 * number + 2], np.abs(table[f"{body} alpha"]).max() + 1)
        if case.gear:
            _, _, ratio, _, apart = case.gear
            tooth = -force[-2] / (apart / (1 - ratio))  # at the pitch point; the bearings take what the teeth apply
            outward = abs(tooth) * tan(radians(20))  # teeth separate their wheels, along the line of centres
            compare("tooth", table["mesh Fy"][k], tooth, np.abs(table["mesh Fy"]).max())
            compare("tooth", table["mesh Fx"][k], outward, np.abs(table["mesh Fy"]).max())
            force[:4] += outward, tooth, -outward, -tooth
        size = max(np.abs(table[f"{pin[0]} Fx"]).max() + np.abs(table[f"{pin[0]} Fy"]).max() for pin in case.pins)
        for number, (pin, *_) in enumerate(case.pins):
            compare("pin", table[f"{pin} Fx"][k], force[2 * number], size)
            compare("pin", table[f"{pin} Fy"][k], force[2 * number + 1], size)
        compare("torque", table[f"{first} drive torque"][k], force[-1], np.abs(table[f"{first} drive torque"]).max())
    assert max(worst.values()) < 1e-10, worst
