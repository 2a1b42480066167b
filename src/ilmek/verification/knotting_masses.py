"""Knotting report, section 5: volumes, masses, centres and moments of inertia of the links, against the machine."""

from collections.abc import Mapping
from functools import cache, partial

from ilmek.dynamics.inertia import Inertia, bar_moment
from ilmek.elements.materials import GRAVITY
from ilmek.machines.knotting_four_bar.links import inertias, parts
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.units import g, mm
from ilmek.verification.claim import Claim, Computation

PARAMS = KnottingFourBarParams()
LINKS = {"1": "crank", "2": "coupler", "3": "rocker"}
PARTS = {"link": "coupler bar", "holder": "holder", "gripper": "gripper"}

NANO = 1e-9
CENTRE = "mass centre of link 2 from O2"
AT = "5, masses"
_claim = partial(Claim, "knotting")


def claims() -> tuple[Claim, ...]:
    """The masses, in the report's order."""
    return (*_link_2(), *_inertia_2(), *_others("1"), *_others("3"))


@cache
def part(name: str) -> Inertia:
    """A part of link 2, or another link, by the report's name."""
    return {**parts(PARAMS), **inertias(PARAMS, hole=0.0)}[{**PARTS, **LINKS}[name]]


def _of(name: str, power: int, unit: float) -> Computation:
    """Mass times a power of its distance from O2, in a unit."""
    return lambda: part(name).mass * part(name).centre.real ** power / unit


def _link_2() -> tuple[Claim, ...]:
    printed = {
        "link": ("979.11", "1.386", "22.61"),
        "holder": ("80", "0.113", "3.80"),
        "gripper": ("100", "0.142", "5.27"),
    }
    cubic = PARAMS.density * mm**3

    def by_place(of: Mapping[str, float], name: str) -> float:
        return of[f"mass of link 2, {name}"] * part(name).centre.real / mm

    def centre(of: Mapping[str, float]) -> float:
        return sum(of[f"mass by place of link 2, {name}"] for name in printed) / of["mass of link 2"]

    return (
        *(
            _claim(f"volume of link 2, {name}", texts[0], "mm³", _of(name, 0, cubic), AT)
            for name, texts in printed.items()
        ),
        *(_claim(f"mass of link 2, {name}", texts[1], "g", _of(name, 0, g), AT) for name, texts in printed.items()),
        *(
            _claim(
                f"mass by place of link 2, {name}",
                texts[2],
                "g mm",
                _of(name, 1, g * mm),
                AT,
                follows=partial(by_place, name=name),
            )
            for name, texts in printed.items()
        ),
        _claim("mass of link 2", "1.641", "g", _of("2", 0, g), AT),
        _claim(CENTRE, "19.30", "mm", lambda: part("2").centre.real / mm, AT, follows=centre),
        _claim("weight of link 2", "16.1e-2", "N", _of("2", 0, 1 / GRAVITY), AT, "16.1e-3 N, as used afterwards"),
        _claim("weight of link 2, as used", "16.1e-3", "N", _of("2", 0, 1 / GRAVITY), "5, link 2", repeated=True),
    )


def _inertia_2() -> tuple[Claim, ...]:
    """Parallel axes about the common centre; the report goes on from its rounded masses and its 19.30 mm."""
    printed = {"link": ("127.1e-9", "12.32e-9"), "holder": ("0.64e-9", "23.22e-9"), "gripper": ("0.49e-9", "45.17e-9")}
    whole = "moment of inertia of link 2"

    def own_moment(of: Mapping[str, float], name: str) -> float:
        return part(name).moment / part(name).mass * of[f"mass of link 2, {name}"] * g

    def moved_moment(of: Mapping[str, float], name: str) -> float:
        return of[f"mass of link 2, {name}"] * (part(name).centre.real / mm - of[CENTRE]) ** 2 * NANO

    terms = [
        _claim(item, text, "kg m²", partial(compute, name), AT, follows=partial(follows, name=name))
        for name, (own, moved) in printed.items()
        for item, text, compute, follows in (
            (f"{whole}, {name}", own, _moment, own_moment),
            (f"{whole}, {name} away from the centre", moved, _moved, moved_moment),
        )
    ]

    def added(of: Mapping[str, float]) -> float:
        return sum(of[term.item] for term in terms)

    return (*terms, _claim(whole, "208.94e-9", "kg m²", partial(_moment, "2"), AT, follows=added))


def _moment(name: str) -> float:
    return part(name).moment


def _moved(name: str) -> float:
    return part(name).mass * abs(part(name).centre - part("2").centre) ** 2


def _others(number: str) -> tuple[Claim, ...]:
    """A plain link."""
    printed = {"1": ("2470.35", "3.5", "34.31e-3", "1988.20e-9"), "3": ("1962.78", "2.78", "27.26e-3", "1000e-9")}
    volume, mass, weight, moment = printed[number]
    length = {"1": PARAMS.crank, "3": PARAMS.rocker}[number]

    def from_mass(of: Mapping[str, float]) -> float:
        return float(bar_moment(of[f"mass of link {number}"] * g, length, PARAMS.width))

    return (
        _claim(f"volume of link {number}", volume, "mm³", _of(number, 0, PARAMS.density * mm**3), AT),
        _claim(f"mass of link {number}", mass, "g", _of(number, 0, g), AT),
        _claim(f"weight of link {number}", weight, "N", _of(number, 0, 1 / GRAVITY), AT),
        _claim(f"moment of inertia of link {number}", moment, "kg m²", partial(_moment, number), AT, follows=from_mass),
    )
