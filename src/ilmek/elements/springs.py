"""Helical compression springs of round wire: rate, stress, buckling, surge, geometry; selection.

    k = G d⁴ / (8 D³ n),   τ = Kw 8 F D / (π d³),   Kw = (4 C - 1) / (4 C - 4) + 0.615 / C,   C = D / d
    f = sqrt(k / m) / 2,   no buckling for α L0 / D < π sqrt(2 (E - G) / (2 G + E)), about 2.6

D mean diameter of the coil, d of the wire, n active coils, m their mass, α 0.5 between parallel plates. Ends are closed
and ground: two coils more, solid length (n + 2) d.   [EN 13906-1; Shigley, 10-1 to 10-5, eq. 10-9, 10-12, 10-25; Wahl]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.catalogue import pick
from ilmek.errors import ParameterError
from ilmek.units import GPa, MPa, format_quantity, mm


@dataclass(frozen=True, slots=True)
class Wire:
    """Spring wire, its standard: tensile strength A / d^power [Pa, d in mm], its allowed share in shear, G, E,
    density [kg/m³].
    """

    name: str
    standard: str
    strength: float
    power: float
    share: float
    shear_modulus: float
    modulus: float
    density: float

    def allowed(self, diameter: float) -> float:
        """Allowed static shear stress [Pa] of a wire of a diameter [m]."""
        return self.share * self.strength * math.exp(-self.power * math.log(diameter / mm))


WIRES: dict[str, Wire] = {
    wire.name: wire
    for wire in (
        Wire("music wire", "EN 10270-1 SH", 2211 * MPa, 0.145, 0.45, 81.7 * GPa, 203.4 * GPa, 7850.0),
        Wire("oil-tempered wire", "EN 10270-2 FD", 1855 * MPa, 0.187, 0.50, 77.2 * GPa, 196.5 * GPa, 7850.0),
        Wire("chrome-vanadium wire", "EN 10270-2 FDCrV", 2005 * MPa, 0.168, 0.50, 77.2 * GPa, 203.4 * GPa, 7850.0),
        Wire("chrome-silicon wire", "EN 10270-2 FDSiCr", 1974 * MPa, 0.108, 0.50, 77.2 * GPa, 203.4 * GPa, 7850.0),
        Wire("stainless wire", "EN 10270-3 1.4310", 1867 * MPa, 0.146, 0.35, 69.0 * GPa, 193.0 * GPa, 7900.0),
    )
}
"""By name [Shigley, tables 10-4 to 10-6; ASTM A228, A229, A232, A401, A313]; for wires of about 0.5 to 6 mm."""

WIRE_DIAMETERS = tuple(
    size * mm
    for size in (
        0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 1.0, 1.1, 1.2, 1.25, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 2.0, 2.2,
        2.25, 2.4, 2.5, 2.8, 3.0, 3.2, 3.5, 3.6, 3.8, 4.0, 4.5, 5.0, 5.5, 6.0,
    )
)  # fmt: skip
"""Preferred diameters of EN 10270-1 [m]."""


@dataclass(frozen=True, slots=True)
class CompressionSpring:
    """A spring: wire's material and diameter, mean coil diameter [m], active coils, free length [m].

    >>> inch = 0.0254
    >>> spring = CompressionSpring("music wire", 0.037 * inch, 0.400 * inch, 10.5, 2.06 * inch)
    >>> round(spring.rate / 175.1268, 2), round(spring.solid_length / inch, 4)
    (4.13, 0.4625)
    """

    wire: str
    wire_diameter: float
    diameter: float
    coils: float
    free_length: float

    @property
    def designation(self) -> str:
        """As ordered, with the symbols of EN 13906-1: D is the mean diameter of the coil, sizes are in mm.

        >>> CompressionSpring("music wire", 0.001, 0.0075, 51.5, 0.14).designation
        'spring EN 15800, d 1, D 7.5 mean, De 8.5, L0 140, nt 53.5 coils, closed and ground, R 0.47 N/mm, EN 10270-1 SH'
        """
        sizes = {
            "d": self.wire_diameter,
            "D": self.diameter,
            "De": self.diameter + self.wire_diameter,
            "L0": self.free_length,
        }
        d, mean, outer, long = (f"{name} {format_quantity(size / mm, '', 3)}" for name, size in sizes.items())
        coils = f"nt {self.coils + 2:.3g} coils, closed and ground"
        rate = format_quantity(self.rate, "N/mm", 3)
        return f"spring EN 15800, {d}, {mean} mean, {outer}, {long}, {coils}, R {rate}, {WIRES[self.wire].standard}"

    @property
    def index(self) -> float:
        """C = D / d."""
        return self.diameter / self.wire_diameter

    @property
    def rate(self) -> float:
        """Rate k [N/m]."""
        return WIRES[self.wire].shear_modulus * self.wire_diameter**4 / (8 * self.diameter**3 * self.coils)

    @property
    def wahl(self) -> float:
        """Wahl's factor of the coil's curvature and the direct shear."""
        return (4 * self.index - 1) / (4 * self.index - 4) + 0.615 / self.index

    def stress(self, force: float) -> float:
        """Largest shear stress τ in the wire [Pa] under a force [N]."""
        return self.wahl * 8 * force * self.diameter / (math.pi * self.wire_diameter**3)

    @property
    def allowed(self) -> float:
        """Allowed static shear stress of the wire [Pa]."""
        return WIRES[self.wire].allowed(self.wire_diameter)

    @property
    def solid_length(self) -> float:
        """Length with all coils touching [m]."""
        return (self.coils + 2) * self.wire_diameter

    @property
    def solid_stress(self) -> float:
        """Shear stress at the solid length [Pa]."""
        return self.stress(self.rate * (self.free_length - self.solid_length))

    @property
    def mass(self) -> float:
        """Mass of the active coils [kg]; a third of it moves with the load."""
        return WIRES[self.wire].density * math.pi**2 / 4 * self.wire_diameter**2 * self.diameter * self.coils

    @property
    def surge(self) -> float:
        """Lowest natural frequency between plates [Hz]; should be 15 to 20 times the frequency of the motion."""
        return math.sqrt(self.rate / self.mass) / 2

    def fatigue_safety(self, least: float, most: float, *, peened: bool = False) -> float:
        """Safety against fatigue between two forces [N]: Zimmerli's amplitude over that of the stress.

        241 MPa, 398 MPa shot-peened, for all spring steels below 10 mm and any mean stress [Shigley, eq. 10-28, 10-29]
        """
        amplitude = self.stress(abs(most - least) / 2)
        return (ZIMMERLI_PEENED if peened else ZIMMERLI) / amplitude if amplitude > 0 else math.inf

    def buckling_deflection(self, end: float = 0.5) -> float:
        """Deflection at which it buckles [m]; inf for a stable spring. `end` α: 0.5 parallel plates, 1 pivoted, 2 free.

        y = L0 C1 (1 - sqrt(1 - C2 (D / α L0)²)), C1 = E / 2 (E - G), C2 = 2 π² (E - G) / (2 G + E) [Shigley, 10-10]
        """
        wire = WIRES[self.wire]
        stiffness_difference = wire.modulus - wire.shear_modulus
        inside = (
            1
            - 2
            * math.pi**2
            * stiffness_difference
            / (2 * wire.shear_modulus + wire.modulus)
            * (self.diameter / (end * self.free_length)) ** 2
        )
        return (
            self.free_length * wire.modulus / (2 * stiffness_difference) * (1 - math.sqrt(inside))
            if inside > 0
            else math.inf
        )


INDICES = tuple(half / 2 for half in range(8, 33))
"""Indices of springs that can be wound well: 4 to 16."""

ZIMMERLI, ZIMMERLI_PEENED = 241 * MPa, 398 * MPa

CLASH = 0.15
"""Remaining travel to the solid length over the whole deflection [Shigley, 10-3]."""


def choose_spring(
    rate: float,
    preload: float,
    travel: float,
    *,
    wire: str = "music wire",
    outer: float = math.inf,
    inner: float = 0.0,
    length: float = math.inf,
    surge: float = 0.0,
    end: float = 0.5,
    fatigue: float = 0.0,
) -> CompressionSpring | None:
    """The lightest spring of a rate [N/m] with a preload [N] and a further travel [m]; None if none fits.

    outer, inner  greatest and least diameter [m]     length  greatest length at the preload [m]
    surge         least natural frequency [Hz]        end     as for `buckling_deflection`
    fatigue       least safety against fatigue over the travel
    The spring is safe at its solid length, has three active coils or more, an index of `INDICES`, and does not buckle.
    Raises ParameterError for a wire that is not in the table.

    >>> spring = choose_spring(2000.0, 20.0, 0.02, inner=0.01)
    >>> spring.wire_diameter, round(spring.rate, 6), spring.solid_stress <= spring.allowed
    (0.0016, 2000.0, True)
    """
    kind = pick(WIRES, wire, "spring wire")
    if not (rate > 0 and preload >= 0 and travel >= 0):
        raise ParameterError(
            f"a spring of rate {rate:g} N/m, preload {preload:g} N and travel {travel:g} m",
            allowed="a rate above 0, preload and travel 0 or more",
        )
    deflection = preload / rate + travel
    thick, mean, coils, used = _wound(kind, rate, deflection)
    strong = used <= 1 + _ROUNDING
    wound = (coils >= 3) & (mean + thick <= outer) & (mean - thick >= inner) & strong
    light = thick**2 * mean * coils
    for at in np.flatnonzero(wound)[np.argsort(light[wound], kind="stable")].tolist():
        wire_diameter, turns = float(thick[at]), float(coils[at])
        free = (turns + 2) * wire_diameter + (1 + CLASH) * deflection
        spring = CompressionSpring(kind.name, wire_diameter, float(mean[at]), turns, free)
        if (
            spring.free_length - preload / rate <= length
            and spring.solid_stress <= spring.allowed
            and spring.surge >= surge
            and spring.fatigue_safety(preload, preload + rate * travel) >= fatigue
            and spring.buckling_deflection(end) > deflection
        ):
            return spring
    return None


def least_stress_share(rate: float, deflection: float, wire: str = "music wire") -> float:
    """Least stress at the solid length over that allowed, of all springs of a rate [N/m] with three coils or more.

    deflection  [m], beyond which `CLASH` is left     wire  of the table; inf where no spring has three coils

    >>> least_stress_share(2000.0, 0.03) < 1 < least_stress_share(2000.0, 1.0)
    True
    """
    _, _, coils, used = _wound(pick(WIRES, wire, "spring wire"), rate, deflection)
    return float(np.min(used, where=coils >= 3, initial=np.inf))


def _wound(wire: Wire, rate: float, deflection: float) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Springs of a rate [N/m]: diameters of wire and coil [m], active coils, stress at the solid length over allowed.

    The stress is that of `CompressionSpring.solid_stress`, for all at once.
    """
    thick, index = (grid.ravel() for grid in np.meshgrid(WIRE_DIAMETERS, INDICES, indexing="ij"))
    mean = thick * index
    coils = wire.shear_modulus * thick**4 / (8 * mean**3 * rate)
    wahl = (4 * index - 1) / (4 * index - 4) + 0.615 / index
    stress = wahl * 8 * (1 + CLASH) * deflection * rate * mean / (np.pi * thick**3)
    return thick, mean, coils, stress / (wire.share * wire.strength * (thick / mm) ** -wire.power)


_ROUNDING = 1e-9
"""Relative difference in stress that counts as rounding where springs are only sorted out."""
