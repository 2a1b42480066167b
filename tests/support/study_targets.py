"""Functions with known indices, fronts and optima as targets of studies."""

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

    def numbers(self, values: Mapping[str, Value]) -> Numbers:
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
