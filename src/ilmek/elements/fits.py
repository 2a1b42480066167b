"""Limits and fits of ISO 286 for sizes up to 500 mm: tolerance grades, fundamental deviations, clearance of a fit.

    shaft a to h    es = -(deviation),    ei = es - IT          shaft k to zc   ei = deviation,   es = ei + IT
    hole A to H     EI = -es of the shaft of the same letter    js, JS          ± IT / 2
    hole K, M, N to IT8, P to ZC to IT7     ES = -ei + Δ,   Δ = IT(n) - IT(n - 1) above 3 mm, else 0
    hole N above IT8    ES = 0 above 3 mm                       P to ZC above IT7   ES = -ei
    IT12 to IT18 = 10 IT7 to IT13

    clearance = (EI - es) to (ES - ei);   below 0 it is an interference

Source: ISO 286-1:2010, tables 1 to 5. Widths of keys and slots are sizes as well as diameters.
"""

import bisect
import re
from functools import lru_cache

from ilmek.errors import ParameterError
from ilmek.records import record
from ilmek.units import format_quantity, mm, um

_STEPS = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
_FINE = (3, 6, 10, 14, 18, 24, 30, 40, 50, 65, 80, 100, 120, 140, 160, 180, 200, 225, 250, 280, 315, 355, 400, 450, 500)
"""Upper ends of the ranges of sizes [mm]: of the grades and of most letters, and of the others."""

_GRADES = ("01", *(str(number) for number in range(19)))

_IT = tuple(
    tuple(map(float, row.split()))
    for row in """
0.3 0.4 0.4 0.5 0.6 0.6 0.8 1 1.2 2 2.5 3 4
0.5 0.6 0.6 0.8 1 1 1.2 1.5 2 3 4 5 6
0.8 1 1 1.2 1.5 1.5 2 2.5 3.5 4.5 6 7 8
1.2 1.5 1.5 2 2.5 2.5 3 4 5 7 8 9 10
2 2.5 2.5 3 4 4 5 6 8 10 12 13 15
3 4 4 5 6 7 8 10 12 14 16 18 20
4 5 6 8 9 11 13 15 18 20 23 25 27
6 8 9 11 13 16 19 22 25 29 32 36 40
10 12 15 18 21 25 30 35 40 46 52 57 63
14 18 22 27 33 39 46 54 63 72 81 89 97
25 30 36 43 52 62 74 87 100 115 130 140 155
40 48 58 70 84 100 120 140 160 185 210 230 250
60 75 90 110 130 160 190 220 250 290 320 360 400
""".strip().splitlines()
)
"""IT01 to IT11 by the range of size [µm]."""

_DEVIATIONS = {
    letters: tuple(None if value == "-" else int(value) for value in row.split())
    for letters, row in (
        line.split(maxsplit=1)
        for line in """
a 270 270 280 290 290 300 300 310 320 340 360 380 410 460 520 580 660 740 820 920 1050 1200 1350 1500 1650
b 140 140 150 150 150 160 160 170 180 190 200 220 240 260 280 310 340 380 420 480 540 600 680 760 840
c 60 70 80 95 95 110 110 120 130 140 150 170 180 200 210 230 240 260 280 300 330 360 400 440 480
cd 34 46 56 - - - - - - - - - -
d 20 30 40 50 65 80 100 120 145 170 190 210 230
e 14 20 25 32 40 50 60 72 85 100 110 125 135
ef 10 14 18 - - - - - - - - - -
f 6 10 13 16 20 25 30 36 43 50 56 62 68
fg 4 6 8 - - - - - - - - - -
g 2 4 5 6 7 9 10 12 14 15 17 18 20
h 0 0 0 0 0 0 0 0 0 0 0 0 0
k 0 1 1 1 2 2 2 3 3 4 4 4 5
m 2 4 6 7 8 9 11 13 15 17 20 21 23
n 4 8 10 12 15 17 20 23 27 31 34 37 40
p 6 12 15 18 22 26 32 37 43 50 56 62 68
r 10 15 19 23 23 28 28 34 34 41 43 51 54 63 65 68 77 80 84 94 98 108 114 126 132
s 14 19 23 28 28 35 35 43 43 53 59 71 79 92 100 108 122 130 140 158 170 190 208 232 252
t - - - - - - 41 48 54 66 75 91 104 122 134 146 166 180 196 218 240 268 294 330 360
u 18 23 28 33 33 41 48 60 70 87 102 124 144 170 190 210 236 258 284 315 350 390 435 490 540
v - - - - 39 47 55 68 81 102 120 146 172 202 228 252 284 310 340 385 425 475 530 595 660
x 20 28 34 40 45 54 64 80 97 122 146 178 210 248 280 310 350 385 425 475 525 590 660 740 820
y - - - - - 63 75 94 114 144 174 214 254 300 340 380 425 470 520 580 650 730 820 920 1000
z 26 35 42 50 60 73 88 112 136 172 210 258 310 365 415 465 520 575 640 710 790 900 1000 1100 1250
za 32 42 52 64 77 98 118 148 180 226 274 335 400 470 535 600 670 740 820 920 1000 1150 1300 1450 1600
zb 40 50 67 90 108 136 160 200 242 300 360 445 525 620 700 780 880 960 1050 1200 1300 1500 1650 1850 2100
zc 60 80 97 130 150 188 218 274 325 405 480 585 690 800 900 1000 1150 1250 1350 1550 1700 1900 2100 2400 2600
""".strip().splitlines()
    )
}
"""Fundamental deviations of shafts without their sign, by the range of size [µm]: of a to h that of the upper limit,
which lies below the nominal size, of k to zc that of the lower limit; of k for the grades 4 to 7."""

_ZONE = re.compile(r"([a-zA-Z]{1,2})(01|\d{1,2})")


@record
class ToleranceZone:
    """Where a size may lie: nominal size, lower and upper limit deviation [m], and its class: `H7`."""

    name: str
    nominal: float
    lower: float
    upper: float

    @property
    def width(self) -> float:
        """The tolerance [m]."""
        return self.upper - self.lower

    @property
    def stated(self) -> dict[str, str]:
        """The size with its class, and its limits, for a note [mm]."""
        sizes = {"least": self.nominal + self.lower, "most": self.nominal + self.upper}
        return {"size": f"{self.nominal / mm:.3f} {self.name}"} | {key: f"{own / mm:.3f}" for key, own in sizes.items()}


@record
class IsoFit:
    """A hole on a shaft of the same nominal size."""

    hole: ToleranceZone
    shaft: ToleranceZone

    @property
    def name(self) -> str:
        """As on a drawing: `H7/g6`."""
        return f"{self.hole.name}/{self.shaft.name}"

    @property
    def least_clearance(self) -> float:
        """Least clearance [m]; below 0: the largest interference."""
        return self.hole.lower - self.shaft.upper

    @property
    def largest_clearance(self) -> float:
        """Largest clearance [m]; below 0: the least interference."""
        return self.hole.upper - self.shaft.lower


def tolerance_grade(grade: str | int, size: float) -> float:
    """Standard tolerance IT of a grade, `01` and 0 to 18, at a nominal size [m]: [m].

    Raises ParameterError for another grade, and for a size that is not above 0 or beyond 500 mm.

    >>> round(tolerance_grade(7, 0.020) * 1e6)
    21
    """
    if str(grade) not in _GRADES:
        raise ParameterError(f"tolerance grade IT{grade}", allowed="IT01, IT0, IT1, ..., IT18")
    return _grade(str(grade), size) * um


def tolerance_zone(name: str, size: float) -> ToleranceZone:
    """The zone of a tolerance class, `H7` of a hole or `g6` of a shaft, at a nominal size [m].

    Raises ParameterError for an unknown class, for a letter that the standard does not have at this size, and for a
    size as `tolerance_grade`. j and J are not among the letters: js and JS are.

    >>> zone = tolerance_zone("P9", 0.008)
    >>> round(zone.lower * 1e6), round(zone.upper * 1e6)
    (-51, -15)
    """
    parts = _ZONE.fullmatch(name)
    letters = parts.group(1) if parts else ""
    if parts is None or parts.group(2) not in _GRADES or not (letters.islower() or letters.isupper()):
        raise ParameterError(f"tolerance class {name!r}", allowed="letters and a grade, as in H7 or g6")
    lower, upper = _limits(letters, parts.group(2), size)
    return ToleranceZone(name, size, lower * um, upper * um)


def fit(name: str, size: float) -> IsoFit:
    """The fit of a hole and a shaft, `H7/g6`, at their nominal size [m]. Raises ParameterError as `tolerance_zone`.

    >>> running = fit("H7/g6", 0.020)
    >>> round(running.least_clearance * 1e6), round(running.largest_clearance * 1e6)
    (7, 41)
    """
    hole, _, shaft = name.partition("/")
    if not (hole[:1].isupper() and shaft[:1].islower()):
        raise ParameterError(f"fit {name!r}", allowed="a hole and a shaft, as in H7/g6")
    return IsoFit(tolerance_zone(hole, size), tolerance_zone(shaft, size))


@lru_cache(maxsize=1024)
def _limits(letters: str, grade: str, size: float) -> tuple[float, float]:
    """Lower and upper limit deviation [µm]."""
    width = _grade(grade, size)
    shaft = letters.lower()
    if shaft == "js":
        return -width / 2, width / 2
    level = -1 if grade == "01" else int(grade)
    deviation = _deviation(shaft, size)
    if letters == "k" and not _OF_K[0] <= level <= _OF_K[1]:
        deviation = 0
    if shaft <= "h":  # the letters of clearance
        return (deviation, deviation + width) if letters.isupper() else (-deviation - width, -deviation)
    if letters.islower():
        return deviation, deviation + width
    upper = float(-deviation)
    above = size > _STEPS[0] * mm
    if shaft == "n" and level > _TO_IT8 and above:
        upper = 0.0
    elif shaft == "k" and level > _TO_IT8 and above:
        raise ParameterError(f"the class K{grade}", allowed="K to grade 8 above 3 mm")
    elif level <= (_TO_IT8 if shaft in {"k", "m", "n"} else _TO_IT7) and above and level > 0:
        upper += width - _grade(str(level - 1), size)
    if (letters, level) == ("M", 6) and 250 * mm < size <= 315 * mm:
        upper = -9.0  # the standard's exception
    return upper - width, upper


_TO_IT7, _TO_IT8 = 7, 8
"""Last grades of holes with the rule of Δ."""

_OF_K = 4, 7
"""Grades of shafts k with a deviation."""


def _deviation(shaft: str, size: float) -> int:
    row = _DEVIATIONS.get(shaft)
    value = None if row is None else row[_range(_STEPS if len(row) == len(_STEPS) else _FINE, size)]
    if value is None:
        raise ParameterError(
            f"the letter {shaft!r} at {format_quantity(size, 'mm')}", allowed=f"js, {', '.join(_DEVIATIONS)} by size"
        )
    return value


def _grade(grade: str, size: float) -> float:
    """Tolerance of a grade [µm]."""
    row, power = _GRADES.index(grade), 1
    while row >= len(_IT):
        row, power = row - 5, 10 * power
    return _IT[row][_range(_STEPS, size)] * power


def _range(ends: tuple[int, ...], size: float) -> int:
    """Number of the range that a size is in."""
    if not 0 < size <= ends[-1] * mm * (1 + _ROUNDING):
        allowed = f"above 0, to {format_quantity(ends[-1] * mm, 'mm')} (ISO 286)"
        raise ParameterError(f"a tolerance at {format_quantity(size, 'mm')}", allowed=allowed)
    return bisect.bisect_left(ends, size / mm * (1 - _ROUNDING))


_ROUNDING = 1e-9
