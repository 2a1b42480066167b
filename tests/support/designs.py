"""Random designs: settings of any machine of the catalogue, drawn from the declarations of its parameters.

    settings = random_settings("cam", random.Random(7))     # {"lift": "23.1 mm", "kind": "barrel"}

The same seed gives the same settings. Most lie near the defaults, some anywhere within the bounds, at a bound or
beyond; a new parameter or machine takes part without a word here.
"""

import math
import random
from collections.abc import Sequence

from ilmek.machines.catalogue import find_machine
from ilmek.params import Parameter, reachable
from ilmek.units import from_si

MOST_SET = 6
"""Parameters that are set at once: with more nearly every design is refused."""

_TYPICAL = {
    "": (0.01, 10.0),
    "mm": (1e-3, 1.0),
    "m": (0.1, 5.0),
    "deg": (0.05, 6.3),
    "rpm": (0.1, 300.0),
    "s": (0.01, 10.0),
    "1/dm": (100.0, 2000.0),
    "MPa": (1e7, 1e9),
    "GPa": (1e9, 1e12),
    "N/mm": (1e2, 1e6),
}
"""Usual values [SI] of a parameter without a default, by its unit; of other units _USUAL."""

_USUAL = (1e-3, 1e3)

_TEXTS: dict[str, Sequence[str]] = {
    "law_parameters": ("", "b=0.25 c=0.5 d=0.25", "v=0.5", "u=0.3,0.7 s=0.2,0.8", "share=0.2", "b=0"),
    "roller": ("CF 10", "CF 30", "CF 6", "none"),
    "bearing": ("6205", "6004", "UCP205", "16100", "none"),
    "tube": ("140x5", "lightest", "60x2", "20x12", "none"),
    "points": (
        "(12mm,4mm) (18.5mm,9.5mm) (25mm,4mm) (18mm,1mm)",
        "(20mm,20mm) (20mm,25mm) (20mm,30mm) (20mm,35mm)",
        "(0,0) (1mm,0) (2mm,0) (3mm,0) (4mm,0)",
        "(0,0) (0,0) (0,0) (0,0)",
    ),
    "angles": ("20deg 65deg 90deg 120deg", "0 0 0 0", "10deg 400deg -20deg 1rad"),
    "timing": ("30deg 45deg 60deg 75deg 90deg 105deg", "0deg 90deg 180deg 270deg", "10deg 5deg 3deg"),
    "poses": (
        "(0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)",
        "(0,0,0) (10mm,0,0) (20mm,0,0)",
        "(0,0,0) (0,0,40deg) (0,0,80deg)",
        "(0,0,0) (0,0,0) (0,0,0)",
        "(0,0,0) (5mm,4mm,10deg) (9mm,7mm,25deg) (14mm,7mm,30deg)",
    ),
    "pivots": ("(0,0) (40mm,0)", "(0,0) (0,0)", "(-10mm,5mm) (60mm,-20mm)"),
    "pins": ("(0,0) (10mm,0)", "(5mm,5mm) (20mm,-3mm)"),
    "function": ("log10", "exp", "sqrt", "1/x", "tan", "x^2", "x^0.5", "sin"),
    "samples": ("(1,0) (2,0.301) (3,0.477) (4,0.6)", "(0,0) (1,1) (2,4)", "(1,1) (1,2)", "(0,0) (1,0) (2,0)"),
    "front": ("transmission_angle force_at_beat", "size drive_torque ratio", "size", "size size"),
    "prices": ("bearing each = 9", "servo per W = 1", "bearing each = -1"),
}
"""Texts of parameters by the last part of their name, and of names that end with it."""

_BOUNDS = ("10mm..60mm", "..60mm", "10mm..", "40mm", "0..0mm", "60mm..10mm", "-20deg..20deg", "1e-9mm..1km")
_POISON = ("", "nan", "inf", "-1", "1e308", "1 mm mm", "\x1b[31m", "0x10", "none")
"""Texts that hardly any parameter takes."""


def random_settings(machine_name: str, rng: random.Random, most: int = MOST_SET) -> dict[str, str]:
    """Settings of up to `most` parameters of a machine, those of machines in it included, as texts with units."""
    known = reachable(find_machine(machine_name).params)
    own = [name for name in known if "." not in name]
    chosen = [rng.choice(own if rng.random() < 0.7 else list(known)) for _ in range(rng.randint(1, most))]
    return {name: random_setting(name, known[name], rng) for name in chosen}


def random_setting(name: str, parameter: Parameter, rng: random.Random) -> str:
    """A text for one parameter: seldom one that it can not take."""
    if rng.random() < 0.01:
        return rng.choice(_POISON)
    if parameter.kind is bool:
        return rng.choice(("yes", "no"))
    if parameter.choices:
        return rng.choice(parameter.choices)
    if parameter.kind is str:
        last = name.rpartition(".")[2]
        found = [texts for ending, texts in _TEXTS.items() if last.endswith(ending)]
        return rng.choice(found[0] if found else _BOUNDS)
    value = _number(parameter, rng)
    if parameter.kind is int:
        return str(round(value))
    return f"{from_si(value, parameter.unit):.6g}{' ' if parameter.unit else ''}{parameter.unit}"


def _number(parameter: Parameter, rng: random.Random) -> float:
    """A number near the default, anywhere within the bounds, at a bound, or beyond it."""
    low = parameter.above if parameter.at_least is None else parameter.at_least
    high = parameter.below if parameter.at_most is None else parameter.at_most
    least, most = (-math.inf if low is None else low), (math.inf if high is None else high)
    draw = rng.random()
    if draw < 0.55:
        value = _near_default(parameter, rng)
        return min(max(value, least), most)
    usual = _TYPICAL.get(parameter.unit, _USUAL)
    first = least if math.isfinite(least) else -usual[1]
    last = most if math.isfinite(most) else usual[1]
    if draw < 0.75:
        return rng.uniform(first, last)
    if draw < 0.88:
        return _log_uniform(max(first, last * 1e-9, 1e-30), max(last, 1e-30), rng)
    if draw < 0.97:
        inside = rng.choice((0.0, 1e-12, 1e-6, 1e-3))
        return rng.choice((first + inside * (last - first), last - inside * (last - first)))
    return rng.choice((first - 1e-3 * (last - first), last * 1.001, -1.0, 0.0, last * 1e6))


def _near_default(parameter: Parameter, rng: random.Random) -> float:
    """About the default, or about usual values of the unit; 0 often where 0 is the default."""
    default = parameter.default
    if isinstance(default, int | float) and default != 0:
        return default * math.exp(rng.gauss(0.0, 1.0))
    if default == 0 and rng.random() < 0.2:
        return 0.0
    return _log_uniform(*_TYPICAL.get(parameter.unit, _USUAL), rng)


def _log_uniform(low: float, high: float, rng: random.Random) -> float:
    return math.exp(rng.uniform(math.log(low), math.log(high))) if low < high else low
