"""Thesis 3.1 and 3.2: the warp cylinders and the square shaft as beams under a uniform load."""

import math
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial

from ilmek.carpet.sizes import STANDARD_SIZES
from ilmek.elements import shafts
from ilmek.elements.beam import uniform
from ilmek.elements.materials import GRAVITY
from ilmek.elements.motors import Reducer
from ilmek.units import GPa, N, kN, m, mm
from ilmek.verification.claim import RESIDUAL, Claim, Computation, residual

PULL = 600 * 15 * N
"""All warps on a cylinder."""

SLOPE, SAG = 0.004, 1 * mm
"""The limits of section 3.1: deep-groove bearings, even tension."""


class Steel(NamedTuple):
    """Length [m] and modulus [Pa], which the thesis does not state for its cylinders."""

    length: float
    modulus: float


FITS = Steel(1.25 * m, 210 * GPa), Steel(1.22 * m, 200 * GPa), Steel(1.2 * m, 193 * GPa)
"""Assumptions that reproduce column 2 of Table 3.1; they have the same l²/E, which decides there."""

LIKELY = Steel(1.2 * m, 210 * GPa)
"""Assumptions that reproduce column 4 with its lost factor of 5."""

SHAFT = Steel(1.2 * m, 200 * GPa)
"""Assumptions that reproduce Table 3.2; length and load are stated, and both columns determine the modulus."""

TUBE_RADII = 70 * mm, 65 * mm
_claim = partial(Claim, "thesis")


def claims() -> tuple[Claim, ...]:
    """Sections 1.3, 3.1, 3.2."""
    return (_taban(), _months(), *_beam(), *_cylinders(), *_tube(), *_drive(), *_shaft_table(), *_shaft_load())


def _taban() -> Claim:
    kelle = STANDARD_SIZES["kelle"].area
    return _claim(
        "size above which a carpet is a taban: that of the largest named one, kelle",
        "6",
        "m²",
        lambda: kelle,
        "Table 1.1",
    )


def _months() -> Claim:
    """Time of an experienced weaver for a seccade."""
    note = "no density is printed: 90 days of 8 h at 25 knots a minute would be 5.0e5 knots/m² of 120 x 180 cm"
    return _claim("time of a prayer rug by hand", "3", "months", lambda: None, "2.1.3", note)


def _beam() -> tuple[Claim, ...]:
    """Eqs 3.1 to 3.7, from the beam's differential equation: E I y'''' = load, nothing bends or sinks at the ends."""
    w, span, stiffness = 7500.0, 1.2, 6.7e5
    y = Polynomial([0, -(span**3), 0, 2 * span, -1]) * (w / (24 * stiffness))
    bent = y.deriv(2)
    ends = max(abs(float(y(span))), abs(float(y(0))), abs(float(bent(0))), abs(float(bent(span))) * span**2) / abs(
        float(y(span / 2))
    )
    moment = bent * stiffness

    def equation(number: str, printed: str, compute: Computation) -> Claim:
        return _claim(f"Eq {number}", printed, RESIDUAL, compute, f"3.1, Eq {number}")

    return (
        equation("3.1", "R1 = R2 = ω l/2", lambda: residual(float(moment.deriv()(0)), w * span / 2)),
        equation("3.2", "V = ω l/2 - ω x", lambda: residual(moment.deriv().coef, np.array([w * span / 2, -w]))),
        equation(
            "3.3",
            "y = ω x (2 l x² - x³ - l³)/(24 E I)",
            lambda: max(ends, residual(float(y.deriv(4)(0)) * stiffness, -w)),
        ),
        equation(
            "3.4",
            "y_max = -5 ω l⁴/(384 E I)",
            lambda: residual(float(y(span / 2)), -5 * w * span**4 / (384 * stiffness)),
        ),
        equation("3.5", "θ_A = -ω l³/(24 E I)", lambda: residual(float(y.deriv()(0)), -w * span**3 / (24 * stiffness))),
        equation(
            "3.6, 3.7",
            "ω = τ n/l,  θ_A = -τ n l²/(24 E I)",
            lambda: residual(uniform.slope_max(PULL / span, span, 1.0, stiffness), PULL * span**2 / (24 * stiffness)),
        ),
    )


def _cylinders() -> tuple[Claim, ...]:
    """Table 3.1: least outer radius for the slope, and sag of the chosen one."""
    lost = "5/384 of Eq 3.4 was taken as 1/384, with l = 1.2 m, E = 210 GPa: 5 times as much; below 1 mm still"
    of_row = "with the l²/E of the other rows"
    rows = {50: ("51.69", 60, "0.037"), 75: ("75.52", 85, "0.012"), 100: ("100.22", 110, "0.005")}
    rows |= {125: ("125.12", 135, "0.0028"), 150: ("150.066", 160, "0.0016")}
    at = "Table 3.1"
    return (
        *(
            _claim(f"R_inner {inner} mm: least R_outer", least, "mm", partial(_least_radius, inner), at, of_row)
            for inner, (least, _, _) in rows.items()
        ),
        *(
            _claim(f"R_inner {inner} mm, R_outer {chosen} mm: y_max", sag, "mm", partial(_sag, chosen, inner), at, lost)
            for inner, (_, chosen, sag) in rows.items()
        ),
    )


def _least_radius(inner: float) -> float | None:
    """The radius [mm], if it is the same for all possible lengths and moduli."""
    found = [
        shafts.tube_outer_radius(shafts.inertia_for_slope(PULL / span, span, E, SLOPE), inner * mm) / mm
        for span, E in FITS
    ]
    return found[0] if max(found) - min(found) < 0.05 else None


def _sag(outer: float, inner: float) -> float:
    span, E = LIKELY
    return float(uniform.deflection_max(PULL / span, span, E, uniform.tube_inertia(outer * mm, inner * mm))) / mm


def _tube() -> tuple[Claim, ...]:
    """The chosen tube, 140 x 5 mm."""
    at = "3.1, before Fig 3.8"

    def slope() -> float | None:
        inertia = uniform.tube_inertia(*TUBE_RADII)
        found = [float(uniform.slope_max(PULL / span, span, E, inertia)) for span, E in (*FITS, LIKELY)]
        return found[-1] if max(found) - min(found) < 1e-6 else None

    return (
        _claim(
            "tube 140 x 5 mm: y_max",
            "0.0025",
            "mm",
            partial(_sag, TUBE_RADII[0] / mm, TUBE_RADII[1] / mm),
            at,
            "diameters taken as radii (1/16) and the 5 of Eq 3.4 lost; below 1 mm still",
        ),
        _claim(
            "tube 140 x 5 mm: slope",
            "0.000052",
            "rad",
            slope,
            at,
            "length and modulus are not stated: 5.3e-4 to 5.8e-4 with those that fit the tables, perhaps a lost zero",
        ),
    )


def _drive() -> tuple[Claim, ...]:
    torque = PULL * TUBE_RADII[0]
    return (
        _claim("torque on a cylinder", "630", "N m", lambda: torque, "3.1, Eq 3.8"),
        _claim(
            "motor torque that is enough behind a self-locking 1:100 reducer",
            "7",
            "N m",
            lambda: Reducer(100, 0.5).motor_torque(torque),
            "3.1",
            "a reducer that locks itself has an efficiency of 1/2 at most; 7 N m would need 0.9",
        ),
        _claim("length of the shaft for 600 warps 2 mm apart", "1.2", "m", lambda: 600 * 2 * mm, "3.2"),
    )


def _shaft_table() -> tuple[Claim, ...]:
    """Table 3.2: sides of the square shaft for slope and sag, at 7 kN/m times the factor of safety."""
    of_row = "with the load, length and modulus of the other rows"
    rows = {"1": ("58.01", "52.44"), "1.5": ("64.22", "58.03"), "2": ("69.01", "62.36"), "3": ("76.37", "69.01")}
    at = "Table 3.2"
    return (
        *(
            _claim(
                f"SF {factor}: B_ec, taken for the sag", text, "mm", partial(_side_for_sag, float(factor)), at, of_row
            )
            for factor, (text, _) in rows.items()
        ),
        *(
            _claim(f"SF {factor}: B_def, taken for the slope", text, "mm", partial(_side_for_slope, float(factor)), at)
            for factor, (_, text) in rows.items()
        ),
        _claim(
            "SF 2: B_ec, the side for eccentricity as its heading says",
            "69.01",
            "mm",
            partial(_side_for_slope, 2.0),
            at,
            "the columns are exchanged: B_ec holds the sides for the sag, B_def those for the slope",
        ),
        _claim(
            "allowed deflection of the shaft",
            "0.1",
            "mm",
            _allowed_sag,
            "3.2",
            "the table keeps 1 mm; 0.1 mm would ask for sides of 103 to 136 mm",
        ),
        _claim("safety of the chosen 80 mm shaft", "> 3", "", _safety, "3.2"),
    )


def _side_for_sag(factor: float) -> float:
    span, E = SHAFT
    return shafts.square_side(shafts.inertia_for_deflection(7 * kN * factor, span, E, SAG)) / mm


def _side_for_slope(factor: float) -> float:
    span, E = SHAFT
    return shafts.square_side(shafts.inertia_for_slope(7 * kN * factor, span, E, SLOPE)) / mm


def _allowed_sag() -> float:
    """The sag [mm] of the tabulated sides B_ec under their loads, at the factor 2."""
    span, E = SHAFT
    return float(uniform.deflection_max(14 * kN, span, E, uniform.square_inertia(69.01 * mm))) / mm


def _safety() -> float:
    """Of slope and sag at 7 kN/m."""
    span, E = SHAFT
    inertia = uniform.square_inertia(80 * mm)
    slope, sag = uniform.slope_max(7 * kN, span, E, inertia), uniform.deflection_max(7 * kN, span, E, inertia)
    return float(min(SLOPE / slope, SAG / sag))


def _shaft_load() -> tuple[Claim, ...]:
    weight, across = 550 * GRAVITY, 600 * 10 * N
    return (
        _claim(
            "weight of cams of 550 kg", "5489", "N", lambda: weight, "3.2", "550 kg weigh 5395.5 N; 5489 N are 559.5 kg"
        ),
        _claim(
            "resultant of weight and 600 warps of 10 N",
            "8200",
            "N",
            lambda: math.hypot(5489 * N, across),
            "3.2",
            "the sum is 11489 N; weight and warps are at a right angle, and with 5589 N 8200 is exact",
        ),
        _claim("load on the shaft at a safety of 2", "14", "kN/m", lambda: 8200 * N / (1.2 * m) * 2 / kN, "3.2"),
    )
