"""Thesis 3.1 and 3.2: the warp cylinders and the square shaft as beams under a uniform load."""

import math
from collections.abc import Mapping
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial

from ilmek.elements import shafts
from ilmek.elements.beam import uniform
from ilmek.elements.materials import GRAVITY
from ilmek.units import GPa, N, kN, m, mm
from ilmek.verification.claim import RESIDUAL, UNSOUND, Claim, Computation, residual

PULL = 600 * 15 * N
"""All warps on a cylinder."""

SLOPE, SAG = 0.004, 1 * mm
"""The limits of section 3.1: deep-groove bearings, even tension."""


class Steel(NamedTuple):
    """Length [m] and modulus [Pa] of a beam."""

    length: float
    modulus: float

    def text(self) -> str:
        """Both, as a row reports them."""
        return f"l = {self.length:g} m, E = {self.modulus / GPa:g} GPa"


WIDE = Steel(1.25 * m, 210 * GPa)
"""A beam that fits column 2 of Table 3.1. Only l²/E counts there: 1.22 m and 200 GPa fit as well."""

CYLINDER = Steel(1.2 * m, 210 * GPa)
"""A beam that fits column 4 of Table 3.1 with its lost factor of 5; 600 warps 2 mm apart are 1.2 m wide."""

SHAFT = Steel(1.2 * m, 200 * GPa)
"""A beam that fits both columns of Table 3.2, whose length and load are stated."""

LOCKS_ITSELF = 0.5
"""Greatest efficiency of a reducer that locks itself."""

TUBE_RADII = 70 * mm, 65 * mm
_claim = partial(Claim, "thesis")


def claims() -> tuple[Claim, ...]:
    """Sections 1.3, 3.1, 3.2."""
    return (*_unjudged(), *_beam(), *_cylinders(), *_tube(), *_drive(), *_shaft_table(), *_shaft_load())


def _unjudged() -> tuple[Claim, ...]:
    """Data from which nothing follows."""
    months = "no density is printed: 90 days of 8 h at 25 knots a minute would be 5.0e5 knots/m² of 120 x 180 cm"
    data = "data; nothing else in the text follows from them, or leads to them"
    absent = (
        ("time of a prayer rug by hand", "3", "months", "2.1.3", months),
        ("names and sizes of carpets", "data", "cm", "Table 1.1", data),
        ("densities of the Pazyryk carpet and of silk carpets", "data", "", "1.2, 1.3.2", data),
        ("given: tension, pitch, opening, thickness of a cam, limits of slope", "data", "", "3.1, 3.2", data),
    )
    return tuple(_claim(item, text, unit, lambda: None, at, note) for item, text, unit, at, note in absent)


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
    rows = {50: ("51.69", 60, "0.037"), 75: ("75.52", 85, "0.012"), 100: ("100.22", 110, "0.005")}
    rows |= {125: ("125.12", 135, "0.0028"), 150: ("150.066", 160, "0.0016")}
    at = "Table 3.1"
    return (
        *(
            _claim(
                f"R_inner {inner} mm: least R_outer",
                least,
                "mm",
                partial(_least_radius, inner, WIDE),
                at,
                fitted=f"{WIDE.text()}; on the beam of y_max, {CYLINDER.length:g} m, it is "
                f"{_least_radius(inner, CYLINDER):.3f} mm",
            )
            for inner, (least, _, _) in rows.items()
        ),
        *(
            _claim(
                f"R_inner {inner} mm, R_outer {chosen} mm: y_max",
                sag,
                "mm",
                partial(_sag, chosen, inner),
                at,
                "5 times as much; below 1 mm still",
                follows=partial(_slipped_sag, chosen, inner, 5),
                right=partial(_slipped_sag, chosen, inner, 1),
                slips=("lost 5",),
                fitted=CYLINDER.text(),
            )
            for inner, (_, chosen, sag) in rows.items()
        ),
        _claim(
            "one beam in columns 2 and 4",
            "l of column 2 = l of column 4, at one E",
            RESIDUAL,
            partial(_lengths_apart, 1 / 384),
            at,
            "one table, two lengths: 4 % apart, with the right 5/384 in column 4 44 %",
            fitted="1/384 for 5/384 in column 4",
            missed=UNSOUND,
        ),
    )


def _least_radius(inner: float, beam: Steel) -> float:
    """The outer radius [mm] for the limit of the slope."""
    inertia = shafts.inertia_for_slope(PULL / beam.length, beam.length, beam.modulus, SLOPE)
    return shafts.tube_outer_radius(inertia, inner * mm) / mm


def _sag(outer: float, inner: float) -> float:
    span, E = CYLINDER
    return float(uniform.deflection_max(PULL / span, span, E, uniform.tube_inertia(outer * mm, inner * mm))) / mm


def _slipped_sag(outer: float, inner: float, factor: float, _: Mapping[str, float]) -> float:
    """The sag [mm], too small by a factor."""
    return _sag(outer, inner) / factor


def _lengths_apart(factor: float) -> float:
    """From the first row, 51.69 mm and 0.037 mm, with y_max = factor W l³/(E I)."""
    E = CYLINDER.modulus
    of_slope = math.sqrt(SLOPE * 24 * E * uniform.tube_inertia(51.69 * mm, 50 * mm) / PULL)
    of_sag = math.cbrt(0.037 * mm * E * uniform.tube_inertia(60 * mm, 50 * mm) / (factor * PULL))
    return residual(of_slope, of_sag)


def _tube() -> tuple[Claim, ...]:
    """The chosen tube, 140 x 5 mm."""
    at = "3.1, before Fig 3.8"
    span, E = CYLINDER
    outer, inner = TUBE_RADII
    return (
        _claim(
            "tube 140 x 5 mm: y_max",
            "0.0025",
            "mm",
            partial(_sag, outer / mm, inner / mm),
            at,
            "below 1 mm still",
            follows=partial(_slipped_sag, outer / mm, inner / mm, 5 * 16),
            right=partial(_slipped_sag, outer / mm, inner / mm, 1),
            slips=("diameters as radii", "lost 5"),
            fitted=CYLINDER.text(),
        ),
        _claim(
            "tube 140 x 5 mm: slope",
            "0.000052",
            "rad",
            lambda: float(uniform.slope_max(PULL / span, span, E, uniform.tube_inertia(outer, inner))),
            at,
            "on the beam of y_max ten times as much; below 0.004 still",
            fitted=CYLINDER.text(),
        ),
    )


def _drive() -> tuple[Claim, ...]:
    torque = PULL * TUBE_RADII[0]
    return (
        _claim("torque on a cylinder", "630", "N m", lambda: torque, "3.1, Eq 3.8"),
        _claim(
            "cylinder's torque from 7 N m by a self-locking 1:100 reducer, at most, 'sufficient' for 630 N m",
            "> 630",
            "N m",
            lambda: 7 * N * m * LOCKS_ITSELF * 100,
            "3.1",
            "a reducer that locks itself has an efficiency of 1/2 at most: 12.6 N m are needed at least, and 7 N m "
            "would need 0.9",
            missed=UNSOUND,
        ),
        _claim("length of the shaft for 600 warps 2 mm apart", "1.2", "m", lambda: 600 * 2 * mm, "3.2"),
    )


def _shaft_table() -> tuple[Claim, ...]:
    """Table 3.2: sides of the square shaft for slope and sag, at 7 kN/m times the factor of safety."""
    of_row = "with the load, length and modulus of the other rows"
    rows = {"1": ("58.01", "52.44"), "1.5": ("64.22", "58.03"), "2": ("69.01", "62.36"), "3": ("76.37", "69.01")}
    modulus, limit = f"E = {SHAFT.modulus / GPa:g} GPa", "y_max = 1 mm"
    on_shaft = partial(_claim, unit="mm", source="Table 3.2")
    return (
        *(
            on_shaft(
                f"SF {factor}: B_ec, taken for the sag",
                text,
                compute=partial(_side_for_sag, float(factor)),
                note=of_row,
                fitted=f"{modulus}, {limit}",
            )
            for factor, (text, _) in rows.items()
        ),
        *(
            on_shaft(
                f"SF {factor}: B_def, taken for the slope",
                text,
                compute=partial(_side_for_slope, float(factor)),
                fitted=modulus,
            )
            for factor, (_, text) in rows.items()
        ),
        on_shaft(
            "SF 2: B_ec, the side for eccentricity as its heading says",
            "69.01",
            compute=partial(_side_for_slope, 2.0),
            note="the columns are exchanged: B_ec holds the sides for the sag, B_def those for the slope",
            fitted=modulus,
        ),
        _claim(
            "allowed deflection of the shaft",
            "0.1",
            "mm",
            _allowed_sag,
            "3.2",
            "the table keeps 1 mm; 0.1 mm needs sides of 103 to 136 mm",
            fitted=modulus,
        ),
        _claim("safety of the chosen 80 mm shaft", "> 3", "", _safety, "3.2", fitted=f"{modulus}, {limit}"),
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
        _claim("weight of cams of 550 kg", "5489", "N", lambda: weight, "3.2", slips=("5489 for 5589",)),
        _claim(
            "resultant of weight and 600 warps of 10 N",
            "8200",
            "N",
            lambda: math.hypot(weight, across),
            "3.2",
            "weight and warps are at a right angle; from the printed 5489 N it is 8132 N",
            follows=lambda of: math.hypot(of["weight of cams of 550 kg"] + 100, across),
            right=lambda of: math.hypot(of["weight of cams of 550 kg"], across),
            slips=("5489 for 5589",),
        ),
        _claim("load on the shaft at a safety of 2", "14", "kN/m", lambda: 8200 * N / (1.2 * m) * 2 / kN, "3.2"),
    )
