"""Strength of a machine's links and pins over a cycle: what is loaded, stresses, and the checks of all machines alike.

Links are flat bars with pins in forks. A pin's bush is as long as the thinner of its links is thick, and each cheek of
its fork half as thick; pins between links of the same size have one diameter. The formulas are those of
`ilmek.dynamics.link_strength` and `pin_strength`.
"""

import math
from bisect import bisect_left
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from types import MappingProxyType

from ilmek.arrays import FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces
from ilmek.dynamics.link_forces import LinkForces, internal_forces
from ilmek.dynamics.link_strength import LinkStrength, link_strength
from ilmek.dynamics.loads import Load
from ilmek.dynamics.pin_strength import PinDuty, PinStrength, pin_duty, pin_strength
from ilmek.elements.flat_section import FlatSection
from ilmek.elements.pin_joints import PIN_DIAMETERS
from ilmek.machines.strength_params import StrengthParams
from ilmek.records import computed, record
from ilmek.report import Alternative, Check, Choice, at_least, at_most, choose
from ilmek.units import MPa, format_quantity, mm, turn

FLAT_BARS = tuple(
    (width * mm, thickness * mm)
    for width, thickness in (
        (30, 10), (40, 12), (50, 15), (60, 20), (80, 25), (100, 30), (120, 40), (150, 50), (200, 60), (250, 80),
    )
)  # fmt: skip
"""Width and thickness of links to choose from [m]: flat steel."""

EQUILIBRIUM = 1e-9
"""Greatest remainder of a link's loads over their magnitudes."""

WIDEST_PIN = 0.6
"""Largest diameter of a pin over the width of its links; assumed by this project."""


@record
class LinkageLoads:
    """What links and pins of a machine bear over a cycle.

    links  internal forces of each link      pins  load of each pin      speed  of the driving crank [rad/s]
    share  of the time for which the machine moves
    forces, masses  by which the forces and masses of `links` are to be multiplied
    """

    links: tuple[LinkForces, ...]
    pins: tuple[PinDuty, ...]
    speed: float
    share: float = 1.0
    forces: float = 1.0
    masses: float = 1.0

    def scaled(self, mass: float, speed: float, share: float = 1.0) -> "LinkageLoads":
        """The loads with masses and speed of the crank multiplied, without gravity: forces go with m w²."""
        force = mass * speed**2
        return LinkageLoads(
            self.links,
            tuple(replace(pin, force=pin.force * force, omega=pin.omega * speed) for pin in self.pins),
            self.speed * speed,
            share,
            self.forces * force,
            self.masses * mass,
        )


def linkage_loads(
    forces: Forces,
    inertias: Mapping[str, Inertia],
    loads: Sequence[Load],
    links: Mapping[str, Sequence[str]],
    pins: Iterable[str],
    *,
    speed: float,
    line_mass: float = 0.0,
    share: float = 1.0,
    times: FloatArray | None = None,
) -> LinkageLoads:
    """What links and pins bear over the motion of the forces, a whole cycle.

    inertias, loads  as given to `inverse`      links  body -> names of its points beside its joints      pins  names
    speed  of the driving crank [rad/s]         line_mass  of the links [kg/m]
    share  of the time for which the machine moves      times  of the samples [s]; default: equal steps

    Raises MechanismError for an unknown body, point or pin.
    """
    return LinkageLoads(
        tuple(
            internal_forces(forces, body, inertias, loads, line_mass=line_mass, points=tuple(points))
            for body, points in links.items()
        ),
        tuple(pin_duty(forces, pin, times) for pin in pins),
        speed,
        share,
    )


@record
class LinkageStrength:
    """Stresses and safeties of links and pins; limits: those in force.

    links, pins  by name      sections  of the links      speed  of the driving crank [rad/s]
    equilibrium  greatest remainder of the loads of a link, over their magnitudes [1]
    """

    limits: StrengthParams
    links: Mapping[str, LinkStrength]
    pins: Mapping[str, PinStrength]
    sections: Mapping[str, FlatSection]
    speed: float
    equilibrium: float
    choices: tuple[Choice, ...] = ()

    pin_diameter = computed(
        "mm", "diameter of the pins: as given, or chosen; the largest", lambda it: it.worst_pin("diameter"), least=0.0
    )
    link_stress = computed(
        "MPa", "greatest nominal stress of each link", lambda it: {name: link.stress for name, link in it.links.items()}
    )

    @computed("1", "least safety of each loaded link against fatigue, with the notch of its holes")
    def link_fatigue(self) -> dict[str, float]:
        return self.of_links("fatigue")

    link_buckling = computed(
        "1", "least safety against buckling of each link that is pushed", lambda it: it.of_links("buckling")
    )

    @computed("Hz", "lowest natural frequency of each link with a mass in its plane, its joints held")
    def link_frequency(self) -> dict[str, float]:
        return {name: value / turn for name, value in self.of_links("frequency").items()}

    pin_shear = computed("MPa", "greatest shear stress of a pin, in a fork", lambda it: it.worst_pin("shear"))
    pin_bending = computed("MPa", "greatest bending stress of a pin, in a fork", lambda it: it.worst_pin("bending"))
    pin_pressure = computed("MPa", "greatest pressure of a pin on its bush", lambda it: it.worst_pin("pressure"))

    @computed("1", "greatest mean of pressure times sliding speed of a pin over the time, in MPa m/s")
    def pin_wear(self) -> float:
        return self.worst_pin("wear") / MPa

    def of_links(self, name: str) -> dict[str, float]:
        """A safety or frequency of each link that has one."""
        values = {link: float(getattr(one, name)) for link, one in self.links.items()}
        return {link: value for link, value in values.items() if value < math.inf}

    def worst_pin(self, name: str) -> float:
        """Greatest diameter, stress, pressure or wear of a pin [SI]; 0 without pins."""
        return float(getattr(_most(self.pins, name), name)) if self.pins else 0.0


def _most(pins: Mapping[str, PinStrength], name: str) -> PinStrength:
    return max(pins.values(), key=lambda one: float(getattr(one, name)))


def linkage_strength(
    loads: LinkageLoads, limits: StrengthParams, sections: Mapping[str, tuple[float, float]], *, name: str = "strength"
) -> LinkageStrength:
    """Strength of links of given sections; of the stock pins the first that is enough, else the largest that fits.

    sections  width and thickness of each link [m]      name  of the limits' parameters
    """
    pins: dict[str, PinStrength] = {}
    choices: list[Choice] = []
    for (width, thickness), duties in _seats(loads, sections).items():
        chosen, choice = _pins_for(duties, limits, width, thickness, loads.share, name)
        pins |= chosen
        choices += choice
    holes = {
        body: max((pins[pin.name].diameter for pin in loads.pins if body in pin.bodies), default=0.0)
        for body in sections
    }
    made = {body: FlatSection(*size, bore_for(holes[body], size[0])) for body, size in sections.items()}
    links = {
        link.body: link_strength(link, made[link.body], limits.of_links).scaled(loads.forces, loads.masses)
        for link in loads.links
    }
    balance = max((link.equilibrium_error for link in loads.links), default=0.0)
    return LinkageStrength(limits, links, pins, made, loads.speed, balance, tuple(choices))


def pins_of(
    loads: LinkageLoads, limits: StrengthParams, sections: Mapping[str, tuple[float, float]]
) -> dict[str, PinStrength]:
    """The pins of `linkage_strength` alone, with the same arguments."""
    seats = _seats(loads, sections).items()
    tried = (_pins_tried(duties, limits, *seat, loads.share)[-1] for seat, duties in seats)
    return {name: pin for pins in tried for name, pin in pins.items()}


def pins_bear(loads: LinkageLoads, limits: StrengthParams, sections: Mapping[str, tuple[float, float]]) -> bool:
    """Whether pins of stock are strong enough; arguments as of `linkage_strength`."""
    return all(check.ok for check in pin_checks(pins_of(loads, limits, sections), limits))


def smallest_pin(limits: StrengthParams, width: float) -> float:
    """The diameter of pins that is tried first between links of a width [m]."""
    return _sizes(limits, width)[0]


def bore_for(pin: float, width: float) -> float:
    """Diameter of the hole for a pin in a link of a width [m]: the pin's, where it leaves anything of the link."""
    return min(pin, 0.99 * width)


def _seats(
    loads: LinkageLoads, sections: Mapping[str, tuple[float, float]]
) -> dict[tuple[float, float], list[PinDuty]]:
    """The pins by the least width and thickness of the links that they join [m]."""
    seats: dict[tuple[float, float], list[PinDuty]] = {}
    for pin in loads.pins:
        joined = [sections[body] for body in pin.bodies if body in sections]
        seat = min(width for width, _ in joined), min(thickness for _, thickness in joined)
        seats.setdefault(seat, []).append(pin)
    return seats


def _pins_tried(
    duties: Sequence[PinDuty], limits: StrengthParams, width: float, thickness: float, share: float
) -> list[dict[str, PinStrength]]:
    """The pins with the first diameter of stock that is enough, or the largest, after those of the next smaller one.

    A thicker pin bears more, and wears no more.
    """

    @cache
    def of_size(index: int) -> dict[str, PinStrength]:
        return {duty.name: pin_strength(duty, sizes[index], thickness, share=share) for duty in duties}

    def bears(index: int) -> bool:
        return all(check.ok for check in pin_checks(of_size(index), limits))

    sizes = _sizes(limits, width)
    first = bisect_left(range(len(sizes) - 1), True, key=bears)
    return [of_size(index) for index in range(max(first - 1, 0), first + 1)]


def _sizes(limits: StrengthParams, width: float) -> list[float]:
    """Diameters of pins to try between links of a width, ascending [m]: the given one, or those of stock."""
    if limits.pin_diameter:
        return [limits.pin_diameter]
    return [size for size in PIN_DIAMETERS if size <= WIDEST_PIN * width] or [WIDEST_PIN * width]


def _pins_for(  # noqa: PLR0917
    duties: Sequence[PinDuty], limits: StrengthParams, width: float, thickness: float, share: float, name: str
) -> tuple[dict[str, PinStrength], list[Choice]]:
    """The pins between links of one size, and the choice of their diameter where there is one."""
    tried = _pins_tried(duties, limits, width, thickness, share)
    if len(tried) == 1:
        return tried[0], []
    sizes = (format_quantity(next(iter(one.values())).diameter, "mm") for one in tried)
    last = [Alternative(size, pin_checks(one, limits)) for size, one in zip(sizes, tried, strict=True)]
    return tried[-1], [choose(f"{name}.pin_diameter", last)[1]]


def largest_bar(mass: float, length: float, density: float) -> tuple[float, float]:
    """Width and thickness [m] of the largest flat bar of stock that is not heavier than a link of a mass [kg].

    length  of the link [m]      density  [kg/m³]. The smallest of stock where even that is heavier.

    >>> largest_bar(2.0, 0.14, 7850.0)
    (0.06, 0.02)
    """
    light = [size for size in FLAT_BARS if size[0] * size[1] * length * density <= mass * (1 + 1e-9)]
    return light[-1] if light else FLAT_BARS[0]


def equilibrium_test(strength: LinkageStrength) -> Check:
    """The test that all that acts on each link is in equilibrium."""
    return at_most("equilibrium of the links' loads", strength.equilibrium, EQUILIBRIUM, "1", "d'Alembert")


def strength_checks(
    strength: LinkageStrength,
    *,
    name: str = "strength",
    stronger: str = "",
    drive: str = "the crank's",
    parts: Mapping[str, str] = MappingProxyType({}),
) -> tuple[Check, ...]:
    """Whether links and pins bear the cycle, and the links are stiff enough for the speed.

    name  of the parameters in the sources      stronger  what makes links stronger; default: wider or thicker links
    drive  whose frequency is `found.speed`      parts  ids of the parts of links and pins by name
    """
    limits = strength.limits
    cure = stronger or "set wider or thicker links, or a lower speed"
    return (
        *(
            at_most(_stress_of(link), one.stress, limits.allowed_stress, "MPa", f"parameter {name}.stress").with_cure(
                cure, *_ids(parts, link)
            )
            for link, one in strength.links.items()
        ),
        *_link_checks(strength, name, cure, drive, parts),
        *_hole_check(strength, parts),
        *pin_checks(strength.pins, limits, name=name, parts=parts),
    )


def _ids(parts: Mapping[str, str], *names: str) -> tuple[str, ...]:
    """The ids of named links and pins that are parts of a tree."""
    return tuple(dict.fromkeys(parts[name] for name in names if name in parts))


def _stress_of(link: str) -> str:
    return f"stress of {link}" if link[-1].isdigit() else f"stress of the {link}"


def _link_checks(
    strength: LinkageStrength, name: str, cure: str, drive: str, parts: Mapping[str, str]
) -> tuple[Check, ...]:
    limits = strength.limits
    rows = (
        ("safety of the links against fatigue", "fatigue", 1.0, "Goodman, notch of the holes"),
        ("safety of the links in buckling", "buckling", 1.0, "Euler, hinged; assumed by this project"),
        (
            f"lowest natural frequency of the links, over {drive}",
            "frequency",
            abs(strength.speed),
            "bending in the plane; assumed by this project",
        ),
    )
    checks = []
    for title, quantity, unit, source in rows:
        values = strength.of_links(quantity)
        if values and unit > 0:
            link, limit = min(values, key=values.__getitem__), "resonance" if quantity == "frequency" else quantity
            given = f"{link}: {source}: parameter {name}.{limit}"
            least, ids = getattr(limits, limit), _ids(parts, link)
            checks.append(at_least(title, values[link] / unit, least, "1", given).with_cure(cure, *ids))
    return tuple(checks)


def _hole_check(found: LinkageStrength, parts: Mapping[str, str]) -> tuple[Check, ...]:
    """Whether the pins leave enough of their links."""
    if not found.sections:
        return ()
    value = max(section.hole / section.width for section in found.sections.values())
    return (
        at_most(
            "diameter of the pins, over the width of their links", value, WIDEST_PIN, "1", "assumed by this project"
        ).with_cure("set wider links, or leave the pins' diameter open", *_ids(parts, *found.sections, *found.pins)),
    )


def pin_checks(
    pins: Mapping[str, PinStrength],
    limits: StrengthParams,
    *,
    name: str = "strength",
    parts: Mapping[str, str] = MappingProxyType({}),
) -> tuple[Check, ...]:
    """Whether the pins bear the cycle; parts: ids of the parts by the pins' names."""
    if not pins:
        return ()
    cure = "set a lower speed, or wider and thicker links for larger pins; or fit rolling bearings there"
    assumed = f"assumed by this project: parameter {name}."
    shear, bent, pressed, worn = (_most(pins, one) for one in ("shear", "bending", "pressure", "wear"))
    rows = (
        ("shear of the pins", shear.shear, limits.pin_shear, "MPa", shear, "pin_shear"),
        ("bending of the pins", bent.bending, limits.pin_bending, "MPa", bent, "pin_bending"),
        ("pressure of the pins", pressed.pressure, limits.pin_pressure, "MPa", pressed, "pin_pressure"),
        ("wear of the pins, p v", worn.wear / MPa, limits.pin_wear, "1", worn, "pin_wear, in MPa m/s"),
    )
    return tuple(
        at_most(title, value, limit, unit, f"pin {pin.name}; {assumed}{parameter}").with_cure(
            cure, *_ids(parts, pin.name)
        )
        for title, value, limit, unit, pin, parameter in rows
    )
