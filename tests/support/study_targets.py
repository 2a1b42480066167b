"""Functions with known indices, fronts and optima as targets of studies."""

import cmath
import math
import os
import time
from collections.abc import Mapping

from ilmek.errors import MechanismError
from ilmek.params import Value
from ilmek.records import record
from ilmek.report import at_most
from ilmek.studies.outcome import Numbers


def _numbers(values: Mapping[str, Value]) -> list[float]:
    return [float(value) for value in values.values() if isinstance(value, int | float)]


@record
class FunctionTarget:
    """A function of the values, by name; a fault file makes a design hang or end its process once."""

    function: str
    fault: str = ""

    @property
    def identity(self) -> Mapping[str, object]:
        """Its name."""
        return {"function": self.function}

    together = 1

    def numbers_together(self, _designs: object, _results: object) -> dict[int, Numbers]:
        """None: each design is evaluated alone."""
        return {}

    def numbers(self, values: Mapping[str, Value], _only: object = None) -> Numbers:
        """Results f, g, and a check."""
        x = _numbers(values)
        return globals()[f"{self.function}_of"](x)  # type: ignore[no-any-return]


def _of(results: dict[str, float], *limits: tuple[str, float, float]) -> Numbers:
    checks = tuple(at_most(name, value, limit, "1", "test") for name, value, limit in limits)
    return Numbers(results, dict.fromkeys(results, ""), checks)


def ishigami_of(x: list[float]) -> Numbers:
    """Ishigami and Homma, a = 7, b = 0.1."""
    return _of({"f": math.sin(x[0]) + 7 * math.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * math.sin(x[0])})


G_FACTORS = (0.0, 1.0, 4.5, 9.0)


def sobol_g_of(x: list[float]) -> Numbers:
    """Sobol's G function."""
    return _of({"f": math.prod((abs(4 * v - 2) + a) / (1 + a) for v, a in zip(x, G_FACTORS, strict=True))})


def zdt1_of(x: list[float]) -> Numbers:
    """ZDT1: front g = 1 - sqrt(f)."""
    g = 1 + 9 * sum(x[1:]) / (len(x) - 1)
    return _of({"f": x[0], "g": g * (1 - math.sqrt(x[0] / g))})


def dtlz2_of(x: list[float]) -> Numbers:
    """DTLZ2 with three goals: the front is an eighth of the unit sphere [Deb, Thiele, Laumanns, Zitzler 2002]."""
    radius = 1 + sum((v - 0.5) ** 2 for v in x[2:])
    a, b = x[0] * math.pi / 2, x[1] * math.pi / 2
    return _of(
        {
            "f": radius * math.cos(a) * math.cos(b),
            "g": radius * math.cos(a) * math.sin(b),
            "h": radius * math.sin(a),
        }
    )


def mw1_of(x: list[float]) -> Numbers:
    """MW1: a line of which a constraint leaves five pieces [Ma and Wang, IEEE Trans. Evol. Comput. 23 (2019) 972]."""
    count = len(x)
    g = 1.0
    for number in range(1, count):
        z = x[number] ** (count - 2 if count > 2 else 1)
        g += 1 - math.exp(-10 * (z - 0.5 - number / (2 * count)) ** 2)
    f, h = x[0], g * (1 - 0.85 * x[0] / g)
    wave = math.sin(2 * math.pi * (math.sqrt(2) * h - math.sqrt(2) * f)) ** 8
    return _of({"f": f, "g": h}, ("front", f + h - 1 - 0.5 * wave, 0.0))


ANGLES = (0.49015573, 0.25282647, -0.08481436, -0.36314529), (-1.32567047, -1.34665426, -1.30359637, -1.15010036)
"""Angles of both links of the thesis' knotting dyad at its four timed points [rad]."""


def dyad_of(x: list[float]) -> Numbers:
    """Greatest error of the end of a knotting dyad at its timed points, by errors of its links and its pivot [m]."""
    ends = (
        abs(x[0] * cmath.exp(1j * a) + x[1] * cmath.exp(1j * b) + complex(x[2], x[3]))
        for a, b in zip(*ANGLES, strict=True)
    )
    error = max(ends)
    return _of({"error": error}, ("error of the end", error, 0.08e-3))


def truss_of(x: list[float]) -> Numbers:
    """Three-bar truss of least volume: 263.8958434 at (0.78868, 0.40825) [Nowacki 1974; Ray and Saini 2001]."""
    a, b, root = x[0], x[1], math.sqrt(2)
    below = root * a * a + 2 * a * b
    stresses = (2 * (root * a + b) / below, 2 * b / below, 2 / (a + root * b))
    return _of({"f": (2 * root * a + b) * 100}, *((f"bar {n}", s, 2.0) for n, s in enumerate(stresses)))


def spring_of(x: list[float]) -> Numbers:
    """Spring of least weight: 0.0126652 at (0.05169, 0.35675, 11.287) [Belegundu 1982; Arora 1989]."""
    d, mean, turns = x
    shear = (4 * mean**2 - d * mean) / (12566 * (mean * d**3 - d**4)) + 1 / (5108 * d**2)
    return _of(
        {"f": (turns + 2) * mean * d**2},
        ("deflection", -(mean**3) * turns / (71785 * d**4), -1.0),
        ("shear", shear, 1.0),
        ("surge", -140.45 * d / (mean**2 * turns), -1.0),
        ("diameter", (mean + d) / 1.5, 1.0),
    )


def vessel_of(x: list[float]) -> Numbers:
    """Pressure vessel of least cost, plates by sixteenths of an inch: 6059.714 [Sandgren 1990]."""
    shell, head, radius, length = 0.0625 * x[0], 0.0625 * x[1], x[2], x[3]
    cost = 0.6224 * shell * radius * length + 1.7781 * head * radius**2
    cost += 3.1661 * shell**2 * length + 19.84 * shell**2 * radius
    volume = math.pi * radius**2 * length + 4 / 3 * math.pi * radius**3
    return _of(
        {"f": cost},
        ("shell", -shell, -0.0193 * radius),
        ("head", -head, -0.00954 * radius),
        ("volume", -volume, -1_296_000.0),
    )


def beam_of(x: list[float]) -> Numbers:
    """Welded beam of least cost: 1.724852 at (0.205730, 3.470489, 9.036624, 0.205730) [Ragsdell and Phillips 1976]."""
    weld, length, height, thick = x
    force, arm, modulus, shear = 6000.0, 14.0, 30e6, 12e6
    moment, radius = force * (arm + length / 2), math.hypot(length / 2, (weld + height) / 2)
    polar = 2 * math.sqrt(2) * weld * length * (length**2 / 12 + ((weld + height) / 2) ** 2)
    first, second = force / (math.sqrt(2) * weld * length), moment * radius / polar
    stress = math.sqrt(first**2 + first * second * length / radius + second**2)
    buckling = 4.013 * modulus * math.sqrt(height**2 * thick**6 / 36) / arm**2
    buckling *= 1 - height / (2 * arm) * math.sqrt(modulus / (4 * shear))
    return _of(
        {"f": 1.10471 * weld**2 * length + 0.04811 * height * thick * (arm + length)},
        ("shear", stress, 13_600.0),
        ("bending", 6 * force * arm / (thick * height**2), 30_000.0),
        ("weld", weld, thick),
        ("deflection", 4 * force * arm**3 / (modulus * height**3 * thick), 0.25),
        ("buckling", -buckling, -force),
    )


def cantilever_of(x: list[float]) -> Numbers:
    """Stepped cantilever of least weight: 1.339956 [Fleury and Braibant 1986; Chickermane and Gea 1996]."""
    bending = sum(k / h**3 for k, h in zip((61, 37, 19, 7, 1), x, strict=True))
    return _of({"f": 0.0624 * sum(x)}, ("deflection", bending, 1.0))


def gears_of(x: list[float]) -> Numbers:
    """Gear train nearest to the ratio 1 / 6.931, teeth 12 to 60: 2.7e-12 by 16, 19, 43, 49 [Sandgren 1990]."""
    return _of({"f": (1 / 6.931 - x[0] * x[1] / (x[2] * x[3])) ** 2})


def stack_of(x: list[float]) -> Numbers:
    """A chain of lengths: gap = a - b - c, which must not be negative."""
    return _of({"gap": x[0] - sum(x[1:])}, ("interference", -(x[0] - sum(x[1:])), 0.0))


def corner_of(x: list[float]) -> Numbers:
    """Least x + y above the hyperbola x y = 1: 2 at (1, 1), multiplier of the limit 2."""
    return _of({"f": x[0] + x[1], "g": x[0] * x[1]}, ("hyperbola", -x[0] * x[1], -1.0))


def whole_of(x: list[float]) -> Numbers:
    """Least (x - 3)^2 + (y - 0.25)^2 with x whole, choice of three for y: 0, 0.5, 1 in their numbers."""
    return _of({"f": (x[0] - 3.2) ** 2 + (x[1] - 0.3) ** 2})


def bad_of(x: list[float]) -> Numbers:
    """Refused below 0.2, a fault of ours below 0.3, hanging below 0.4, ending its process below 0.5."""
    if x[0] < 0.2:
        raise MechanismError("cannot close")
    if x[0] < 0.3:
        raise ZeroDivisionError("a fault")
    if x[0] < 0.4:
        end = time.monotonic() + 60
        while time.monotonic() < end:
            pass
    if x[0] < 0.5 and os.environ.get("ILMEK_STUDY_DIES"):
        os._exit(9)
    return _of({"f": x[0]}, ("limit", x[0], 0.8))


FOUR_BAR = """
name = "four-bar"
gravity = "9.81m/s^2"

[values]
a = "60mm"
b = "200mm"
weight = "0.4kg"

[bodies]
ground.points = { A0 = [0, 0], B0 = ["300mm", 0] }
crank = { length = "a", mass = "0.1kg" }
coupler = { length = "b", mass = "0.3kg" }
rocker = { length = "230mm", mass = "weight" }

[joints]
A0.pin = ["ground", "crank"]
A.pin = ["crank", "coupler"]
B.pin = ["coupler", "rocker"]
B0.pin = ["ground", "rocker"]

[inputs]
A0 = "crank"

[motions]
A0 = "150rpm"

[branches]
B = 1
"""
"""A mechanism file with values."""
