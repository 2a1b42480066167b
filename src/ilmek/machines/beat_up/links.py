"""Links of a beat-up, of one or of a whole family: their holes, moments of mass, and what moves with them.

As made they are flat links with a hole at each pin [`part.flat_link`]; crank and rocker carry a pin each, the rocker
the beater, whose mass counts as a point in E. The rocker ends in front of the warps, where the beater's bar is. As
bars, the paper's, they are rectangles from pin to pin without pins, the rocker to E.

Rocker, coupler and crank run in planes next to each other along the width, so that no shaft crosses a link.
"""

import math
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import RealField
from ilmek.dynamics.inertia import Inertia, bar_mass, bar_moment
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.machines.link_tree import BRIDGE, GAP, PIN_STEEL
from ilmek.part.flat_link import LinkMoments, PinHole, flat_link_moments

LINKS = ("crank", "coupler", "rocker")

PART_IDS = {
    **{name: f"beat-up/{name}" for name in LINKS},
    **dict.fromkeys("BCD", "beat-up/pin"),
    "A": "beat-up/pivot-pin",
}
"""Ids of the parts of links and pins."""

LAYERS = {"rocker": 0, "coupler": 1, "crank": 2, "plate": 3}
"""Planes of the links and of the plate that carries crank and rocker, from the beater's side on."""


def layer(name: str, thickness: float) -> float:
    """Middle of a link's plane from that of the rocker's, along the pins [m]."""
    return LAYERS[name] * (1 + GAP) * thickness


CARRIED = {"crank": "crank", "rocker": "rocker"}
"""Links that carry the pin at the end of a length: C of the crank, B of the rocker."""


def spans(lengths: Mapping[str, RealField], short: float = 0.0) -> dict[str, RealField]:
    """Distance of the centres of the round ends of each link [m]; the rocker's reaches beyond B towards the beater.

    lengths  of the links and of the beater from A [m], any shape      short  of the beater's edge [m]
    """
    rocker = np.maximum(lengths["rocker"], np.asarray(lengths["beater"]) - short)
    return {**{name: lengths[name] for name in LINKS}, "rocker": rocker}


def pin_holes(lengths: Mapping[str, RealField], diameter: float) -> dict[str, dict[str, PinHole]]:
    """Holes of each link by its pins; those without a bridge between them are not bored.

    diameter  of all [m]
    """
    least = BRIDGE * diameter

    def pair(first: str, second: str, length: RealField) -> dict[str, PinHole]:
        bored = np.where(np.asarray(length) >= least, diameter, 0.0)
        return {first: PinHole(0.0, bored), second: PinHole(length, bored)}

    return {
        "crank": pair("D", "C", lengths["crank"]),
        "coupler": pair("C", "B", lengths["coupler"]),
        "rocker": pair("A", "B", lengths["rocker"]),
    }


def link_masses(params: BeatUpParams, lengths: Mapping[str, RealField], hole: float) -> dict[str, LinkMoments]:
    """Moments of mass of each link about its first pin; hole: diameter of its holes [m]."""
    width, thickness, density = params.width, params.thickness, params.link_material.density
    if params.link_mass == "made":
        holes = pin_holes(lengths, hole)
        return {
            name: flat_link_moments(span, width, thickness, holes[name].values()).of_density(density)
            for name, span in spans(lengths, params.before_beater).items()
        }
    masses = {name: bar_mass(span, width, thickness, density) for name, span in spans(lengths).items()}
    nothing = LinkMoments(0.0, 0.0, 0.0)
    return {
        name: nothing.with_mass(masses[name], span / 2, bar_moment(masses[name], span, width))
        for name, span in spans(lengths).items()
    }


def moving_masses(params: BeatUpParams, lengths: Mapping[str, RealField], hole: float) -> dict[str, LinkMoments]:
    """Moments of mass of what moves with each link: the link, its pin, on the rocker the beater."""
    links = link_masses(params, lengths, hole)
    if params.link_mass == "made":
        mass = pin_mass(params.thickness, hole)
        for name, length in CARRIED.items():
            links[name] = links[name].with_mass(mass, lengths[length], mass * hole**2 / 8)
    return {**links, "rocker": links["rocker"].with_mass(params.beater_mass, lengths["beater"])}


def pin_length(thickness: float) -> float:
    """Length of a pin through two links side by side [m]."""
    return (2 + GAP) * thickness


def pin_mass(thickness: float, diameter: float) -> float:
    """Mass of a pin [kg]."""
    return PIN_STEEL.density * math.pi * diameter**2 / 4 * pin_length(thickness)


def inertia_of(moments: LinkMoments) -> Inertia:
    """The inertia of one link in its own frame, x from its first pin along it."""
    return Inertia(float(moments.zeroth), complex(moments.centre), float(moments.about_centre))
