"""Strength of a link as a flat bar: stress, fatigue, buckling, and natural frequency, from its internal forces.

    σ = N / A ± M / W,   σv = max(|σ|, sqrt((N/A)² + 3 (1.5 V/A)²))        net section within d/2 of a joint, else full
    1 / n = σa / Se + max(σm, 0) / Rm                        each edge over the cycle; at a hole N / A counts Kf times
    n_k = π² E I / (k l)² / |N|                              smaller I; k = 1 between nodes, 2 of a part with a free end

The mean stress σm counts where it is tension [Goodman]. The natural frequency is that of bending in the plane, with all
joints held, as by rigid neighbours: a straight link is one beam on its joints, a bent one is taken beam by beam,
clamped at the bend where its end is free. Links that are short against their width are stiffer than a beam.
                    [Shigley's Mechanical Engineering Design, 9th ed., 6-12; Euler; Rao, Mechanical Vibrations, 8.5]
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import BoolArray, FloatArray
from ilmek.dynamics.link_forces import BeamForces, LinkForces
from ilmek.elements.beam.model import Beam
from ilmek.elements.flat_section import FlatSection, euler_load, flat_endurance, hole_notch
from ilmek.elements.materials import Material
from ilmek.elements.whirl import Mass, frequencies
from ilmek.records import record

RESONANCE = 10.0
"""Least lowest natural frequency of a link over the frequency of the driving crank.

Assumed by this project: harmonics of the motion up to the fifth are then raised by 1 / (1 - 0.5²) = 1.33 or less, so
that forces computed for rigid links hold; beyond the fifth they are small in crank mechanisms without dwell.
"""


@record
class LinkStrength:
    """Strength of a link.

    body       its name
    stress     greatest stress σv [Pa], nominal          position  beam (start, end), from its start [m]
    fatigue    least safety against fatigue              buckling  least safety against buckling
    frequency  lowest natural frequency [rad/s]; inf without mass or beam
    """

    body: str
    stress: float
    position: tuple[str, str, float]
    fatigue: float
    buckling: float
    frequency: float

    def scaled(self, force: float, mass: float) -> "LinkStrength":
        """With all forces and all masses multiplied."""
        return replace(
            self,
            stress=self.stress * force,
            fatigue=self.fatigue / force,
            buckling=self.buckling / force,
            frequency=self.frequency / math.sqrt(mass),
        )


@lru_cache(maxsize=128)
def link_strength(found: LinkForces, section: FlatSection, material: Material) -> LinkStrength:
    """Strength of a link with a flat section over a cycle. A link without beams has no stress, and infinite safeties.

    found  of `link_forces.internal_forces`, over a whole cycle; samples with NaN are left out
    Without a known fatigue limit of the material the safety against fatigue is infinite.
    """
    stress, position, fatigue, buckling = 0.0, ("", "", 0.0), math.inf, math.inf
    for beam in found.beams:
        solved = np.isfinite(beam.moment).all(axis=0)
        if not solved.any():
            return LinkStrength(found.body, math.nan, position, math.nan, math.nan, math.nan)
        weak = _weakened(beam, found.joints, section)
        highest = _stress(beam, section, weak)[:, solved].max(axis=1)
        row = int(np.argmax(highest))
        if highest[row] > stress:
            stress, position = float(highest[row]), (beam.start, beam.end, float(beam.at[row]))
        if material.fatigue is not None:
            fatigue = min(fatigue, _fatigue(beam, section, material, weak, solved))
        buckling = min(buckling, _buckling(beam, found, section, material, solved))
    return LinkStrength(found.body, stress, position, fatigue, buckling, natural_frequency(found, section, material))


def _weakened(beam: BeamForces, joints: frozenset[str], section: FlatSection) -> BoolArray:
    """Which stations of a beam are in a hole; where it has no joint at an end there is none."""
    reach = section.hole / 2
    near = (beam.start in joints) & (beam.at <= reach)
    return np.asarray((near | ((beam.end in joints) & (beam.at >= beam.length - reach))) & (section.hole > 0))


def _areas(section: FlatSection, weak: BoolArray) -> tuple[FloatArray, FloatArray]:
    """Area and section modulus at each station, as columns."""
    area = np.where(weak, section.net_area, section.area)
    return area[:, None], np.where(weak, section.net_modulus, section.modulus)[:, None]


def _stress(beam: BeamForces, section: FlatSection, weak: BoolArray) -> FloatArray:
    area, modulus = _areas(section, weak)
    pulled = np.abs(beam.axial) / area
    sheared = np.sqrt(pulled**2 + 3 * (1.5 * beam.shear / area) ** 2)
    return np.asarray(np.maximum(pulled + np.abs(beam.moment) / modulus, sheared))


def _fatigue(beam: BeamForces, section: FlatSection, material: Material, weak: BoolArray, solved: BoolArray) -> float:
    area, modulus = _areas(section, weak)
    notch = np.where(weak, hole_notch(section, material), 1.0)[:, None]
    worst = 0.0
    for side in (1.0, -1.0):
        stress = (notch * beam.axial / area + side * beam.moment / modulus)[:, solved]
        highest, lowest = stress.max(axis=1), stress.min(axis=1)
        used = (highest - lowest) / 2 / flat_endurance(section, material)
        used = used + np.maximum(highest + lowest, 0) / 2 / material.tensile
        worst = max(worst, float(used.max()))
    return 1 / worst if worst > 0 else math.inf


def _buckling(
    beam: BeamForces, found: LinkForces, section: FlatSection, material: Material, solved: BoolArray
) -> float:
    pushed = float(np.max(-beam.axial[:, solved]))
    if pushed <= 0:
        return math.inf
    length = (2 if _is_free(beam, found) else 1) * beam.length
    return euler_load(length, section.least_inertia, material.modulus) / pushed


def _is_free(beam: BeamForces, found: LinkForces) -> bool:
    """Whether one end of a beam is held neither by a joint nor by another beam."""
    ends = [name for other in found.beams for name in (other.start, other.end)]
    return any(ends.count(name) == 1 and name not in found.joints for name in (beam.start, beam.end))


def natural_frequency(found: LinkForces, section: FlatSection, material: Material) -> float:
    """Lowest natural frequency of bending in the plane [rad/s], with all joints held; inf without mass.

    The line mass is that of the section, or less where the body's mass is less; a massless body has no frequency.
    """
    rigidity = section.inertia * material.modulus
    straight = _straight(found)
    spans = (straight,) if straight else tuple(_alone(beam, found) for beam in found.beams)
    return min((_lowest(*span, rigidity, found.line_mass) for span in spans), default=math.inf)


def _straight(found: LinkForces) -> tuple[Beam, list[Mass]] | None:
    """The whole link as one beam on its joints, where its nodes are on a line and two or more are joints."""
    names, nodes = list(found.points), np.array(list(found.points.values()))
    if len(names) < 2 or len(found.joints) < 2:
        return None
    reach = nodes[np.argmax(np.abs(nodes - nodes[0]))] - nodes[0]
    turned = (nodes - nodes[0]) / reach
    if np.max(np.abs(turned.imag)) > 1e-6:
        return None
    at = (turned.real - turned.real.min()) * abs(reach)
    length = float(at.max())
    held = tuple(sorted(float(x) for x, name in zip(at, names, strict=True) if name in found.joints))
    loose = [(float(x), name) for x, name in zip(at, names, strict=True) if name not in found.joints]
    return Beam(length, held), [Mass(x, found.masses[name]) for x, name in loose if found.masses[name]]


def _alone(beam: BeamForces, found: LinkForces) -> tuple[Beam, list[Mass]]:
    """One beam of a bent link: hinged at its ends, or clamped where the other end is free."""
    if not _is_free(beam, found):
        return Beam(beam.length, (0.0, beam.length)), []
    tip = beam.end if beam.end not in found.joints else beam.start
    mass = found.masses[tip]
    return Beam(beam.length, (0.0,), clamped=(0.0,)), [Mass(beam.length, mass)] if mass else []


def _lowest(beam: Beam, masses: Sequence[Mass], rigidity: float, line_mass: float) -> float:
    if line_mass <= 0 and not masses:
        return math.inf
    return float(frequencies(beam, rigidity, line_mass, masses, count=1)[0])
