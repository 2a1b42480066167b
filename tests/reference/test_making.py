"""What made parts cost against computations on their meshes, with rates copied here, and the price of a whole loom."""

import math
from functools import cache

import numpy as np
import pytest
from default_machines import default_design, default_report

from ilmek.elements.making import RATES
from ilmek.elements.materials import MATERIALS
from ilmek.elements.prices import PRICES, batch_price, piece_price
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.part.bill import bill
from ilmek.part.making import ROUTES, steps_of
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.shapes import Placed, Sum, box, tube
from ilmek.report import BillLine

_SHAFT = 12e-3
"""Radius within which a cam's walls are those of its bore [m]."""

STEEL, ALLOY, CM2, CM3 = 7850.0, 2700.0, 1e4, 1e6


@cache
def made() -> dict[str, tuple[Part, BillLine]]:
    tree = loom_tree(default_design("automated-loom"))
    parts = dict(tree.occurrences())
    lines = {line.part: line for line in bill(tree)}
    return {part.id: (part, lines[part.id]) for part in parts if part.material is not None}


class Measured:
    """A part by its mesh: sides of its box in ascending order [m], volume [m³], surface, walls near the axis [m²]."""

    def __init__(self, name: str) -> None:
        part, self.line = made()[name]
        assert part.shape is not None
        solid = part.shape.mesh(2e-6)
        a, b, c = (solid.points[solid.triangles[:, k]] for k in range(3))
        self.sides = sorted(np.ptp(solid.points, axis=0).tolist())
        self.volume = float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)
        areas = np.linalg.norm(normals := np.cross(b - a, c - a), axis=1) / 2
        upright = np.abs(normals[:, 2]) < areas  # walls along z
        near = np.hypot(*((a + b + c) / 3)[:, :2].T) < _SHAFT
        self.surface, self.bore = float(areas.sum()), float(areas[upright & near].sum())


def money(hour: float, seconds: float) -> float:
    return hour * seconds / 3600


def laser(part: Measured, contours: int, density: float = STEEL, price: float = 1.3) -> float:
    """A flat plate: its edge is what its surface has beside both faces."""
    thick, wide, long = part.sides
    cut = (part.surface - 2 * part.volume / thick) / thick
    blank = density * price * thick * (wide + 8e-3) * (long + 8e-3)
    return blank + money(95, 15 + contours + 1.5 * cut + 0.25 * cut * thick * CM2)


def tapped(holes: int, diameter: float, deep: float) -> float:
    """Holes machined after the cut."""
    return money(55, 240 + holes * (25 + math.pi * diameter * deep * CM2))


def folded(part: Measured, folds: int) -> float:
    """A strip s wide, t thick, L long: V = s t L, and the surface 2 (s t + s L + t L), solved by halving.

    Its middle is longer than what it is cut from: a quarter turn of inner radius t keeps its length at 0.325 t
    [DIN 6935].
    """
    long = part.sides[2]
    low, high = 0.0, math.sqrt(part.volume / long)
    for _ in range(100):
        t = (low + high) / 2
        s = part.volume / (t * long)
        low, high = (t, high) if 2 * (s * t + s * long + t * long) > part.surface else (low, t)
    s -= folds * math.pi / 2 * (0.5 - 0.325) * t
    cut = 2 * (s + long)
    blank = STEEL * 1.3 * t * (s + 8e-3) * (long + 8e-3)
    return blank + money(95, 16 + 1.5 * cut + 0.25 * cut * t * CM2) + money(50, 20 + 20 * folds)


def milled(part: Measured, holes: int, density: float, price: float) -> float:
    thick, wide, long = part.sides[0], part.sides[1] + 4e-3, part.sides[2] + 4e-3
    blank = thick * wide * long
    finished = part.surface - 2 * part.volume / part.sides[0]
    cut = 240 + 25 * holes + finished * CM2 + 3 * (blank - part.volume) * CM3
    return density * price * 1.05 * blank + money(35, 45 + thick * wide * CM2) + money(55, cut)


def turned(part: Measured, price: float, bar: float, finished: float | None = None) -> float:
    """About z: the two equal sides of its box are its diameter; bar  of which it is turned, 2 mm longer."""
    x, y, z = part.sides
    long = (z if y - x < z - y else x) + 2e-3
    section = math.pi / 4 * bar**2
    area = part.surface if finished is None else finished
    cut = 60 + 0.6 * area * CM2 + 3 * (section * long - part.volume) * CM3
    return STEEL * price * 1.05 * section * (long + 3e-3) + money(50, cut)


def counterbored(holes: int) -> float:
    """Clamped once more, and each hole widened to its depth."""
    return money(45, 45 + 20 * holes)


def finished(part: Measured) -> float:
    """Turned again, once it is welded on."""
    return money(50, 60 + 0.6 * part.surface * CM2)


def welded(part: Measured) -> float:
    """A square tube: perimeter of its outside from its widest sides, section from its volume."""
    side, long = part.sides[0], part.sides[2]
    section = part.volume / long
    stock = STEEL * 1.3 * 1.05 * section * (long + 3e-3) + money(35, 45 + 2 * section * CM2)
    return stock + money(45, 300 + 500 * 8 * side) + 15 * 4 * side * long


def cam(part: Measured) -> float:
    """Cut of sheet; of the cut, what lies about the shaft is milled, the outline ground."""
    walls = part.surface - 2 * part.volume / part.sides[0]
    ground = 240 + 12 * (walls - part.bore) * CM2
    hardened = 4 * STEEL * part.volume
    return laser(part, 2, price=1.8) + money(55, 265 + part.bore * CM2) + money(60, ground) + hardened


@pytest.mark.parametrize(
    ("name", "price"),
    [
        ("shedding/guide-cam", lambda part: laser(part, 2)),
        ("automated-loom/upper-bracket", lambda part: laser(part, 6) + tapped(4, 12e-3, 20e-3)),
        ("hammer/leaf", lambda part: laser(part, 1)),
        ("automated-loom/chain-trough", lambda part: folded(part, 3)),
        ("weaver/left-side-plate", lambda part: milled(part, 1, ALLOY, 6.0) + counterbored(1)),
        ("tension-compensator/lever", lambda part: milled(part, 2, STEEL, 1.3)),
        ("warp-tension/upper-end", lambda part: turned(part, 1.6, 160e-3) + finished(part)),
        ("tension-compensator/pin", lambda part: turned(part, 1.3, 16e-3, math.pi / 2 * 16e-3**2)),
        ("automated-loom/column", welded),
        ("automated-loom/creel-rail", welded),
        ("weaver/pile-handler-cam", cam),
    ],
)
def test_a_piece_costs_what_its_mesh_says(name: str, price: object) -> None:
    assert callable(price)
    part = Measured(name)
    assert piece_price(part.line, PRICES) == pytest.approx(price(part), rel=2e-3)


def test_plates_are_welded_along_the_edges_of_what_touches() -> None:
    """A plate of 40 x 6 on end on another: a seam of 2 (40 + 6) mm, once on each of two."""
    upright = Placed(box(40e-3, 6e-3, 50e-3), (placement(x=-50e-3), placement(x=50e-3)))
    shape = Sum((Placed(box(200e-3, 60e-3, 10e-3), (placement(z=-10e-3),)), upright))
    part = Part("a", "a", "laser-cut part", shape=shape, material=MATERIALS["structural steel"])
    (seam,) = [step for step in steps_of(part) if step.kind == "welding"]
    assert seam.length == pytest.approx(2 * 2 * 46e-3)


def test_a_bush_is_drilled_of_the_bar_and_a_tube_is_cut_of_stock() -> None:
    shape, steel = tube(30e-3, 5e-3, 40e-3), MATERIALS["structural steel"]
    bush, cut = (steps_of(Part("a", "a", kind, shape=shape, material=steel)) for kind in ("pin or bush", "steel tube"))
    assert bush[0].mass == pytest.approx(STEEL * 1.05 * math.pi / 4 * 30e-3**2 * 45e-3)
    assert bush[1].volume == pytest.approx(math.pi / 4 * (30e-3**2 * 42e-3 - (30e-3**2 - 20e-3**2) * 40e-3))
    assert cut[0].mass == pytest.approx(STEEL * 1.05 * math.pi / 4 * (30e-3**2 - 20e-3**2) * 43e-3)
    assert len(cut) == 2


def test_every_made_part_has_its_steps_and_no_quantity_is_below_0() -> None:
    for part, line in made().values():
        assert (part.process in ROUTES) == bool(line.steps) == (line.kind not in PRICES)
        assert all(min(s.mass, s.length, s.area, s.volume, s.features) >= 0 for s in line.steps)
        if line.steps:
            bought = sum(step.mass for step in line.steps if step.kind == line.material)
            assert bought >= part.mass * (1 - 1e-9), part.id
            assert ("hardening" in {step.kind for step in line.steps}) == (
                line.material in ("induction-hardened steel", "bearing steel")
            )


def test_each_rate_is_usual_and_every_material_has_one() -> None:
    assert all(rate.usual[0] <= rate.value <= rate.usual[1] for rate in RATES)
    assert set(MATERIALS) <= {rate.kind for rate in RATES}
    assert len({(rate.kind, rate.label) for rate in RATES}) == len(RATES)


def test_price_of_the_loom_from_its_numbers() -> None:
    report = default_report("automated-loom")
    found = {result.name: result.value for result in report.results}
    shares, fitted, price = found["price_shares"], found["fitted"], found["machine_price"]
    minutes = {"pieces": 40 / 60, "screws": 1.5, "pins": 5, "slides": 10, "contacts": 5}
    assembly = 35 / 60 * sum(fitted[name] * time for name, time in minutes.items())
    electrics = 35 * (24 + 6 * fitted["axes"] + fitted["sensors"] / 4)
    assert shares["assembly"] == pytest.approx(assembly)
    assert shares["electrics"] == pytest.approx(electrics)
    assert price["made"] == pytest.approx(price["parts"] + assembly + electrics + 80 * 35)
    assert price["sold"] == pytest.approx(1.35 * price["made"]) == pytest.approx(sum(shares.values()))
    lines = [line for line in report.parts if line.steps]
    workshop = sum(line.number * piece_price(line, PRICES) + batch_price(line, PRICES) for line in lines)
    work = {"assembly", "electrics", "commissioning", "margin", "bought parts"}
    assert sum(value for cause, value in shares.items() if cause not in work) == pytest.approx(workshop)
