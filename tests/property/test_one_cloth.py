"""A cloth is declared once: every machine of a loom has that of the loom, and no other parameters of the warps."""

import math
from typing import Any

import pytest
from cloths import cloth
from effort import examples
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.yarns import COTTON, usual_warp_density
from ilmek.errors import ParameterError
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.catalogue import MACHINES
from ilmek.params import declared, reachable
from ilmek.units import dm, mm
from ilmek.weaving import Cloth

_LOOMS = st.fixed_dictionaries(
    {
        "width": st.floats(0.3, 2.0),
        "length": st.floats(0.3, 1.0),
        "selvedge_warps": st.integers(0, 20),
        "knotting": st.sampled_from(["cams", "arms"]),
        "beat": st.sampled_from(["travelling", "comb", "linkage"]),
        "weft": st.sampled_from(["shuttle", "rapier"]),
        "yarns.warp": st.sampled_from(["cotton", "wool"]),
        "yarns.friction": st.floats(0.1, 0.4),
    },
    optional={"tension": st.floats(5.0, 25.0), "knots_across": st.floats(15 / dm, 40 / dm), "heads": st.just(1)},
)


@examples(18, 3)
@given(_LOOMS)
def test_every_machine_of_a_loom_weaves_the_same_cloth(asked: dict[str, Any]) -> None:
    loom = design(AutomatedLoomParams.read(asked))
    woven = loom.task.cloth
    assert {child.component.name for child in loom.children} > {"weaver", "weft", "shedding", "warp-tension"}
    assert all(child.design.params.cloth == woven for child in loom.children)
    across = asked.get("knots_across", 25 / dm)
    assert woven.warps == 2 * round(asked["width"] * across) + asked["selvedge_warps"]
    assert woven.width == pytest.approx(woven.warps / (2 * across))
    assert woven.row_distance == pytest.approx((1 + woven.warp_strain) / 0.99 / across)  # 1 % of it goes in washing
    assert woven.yarns.friction == asked["yarns.friction"]
    assert woven.warp_tension == asked.get("tension", woven.warp_tension)


@given(st.floats(0.2 * mm, 8 * mm), st.integers(2, 5000), st.sampled_from(["cotton", "wool", "silk"]))
def test_a_cloth_follows_from_its_pitch_warps_and_yarn(pitch: float, warps: int, material: str) -> None:
    woven = cloth(warp_pitch=pitch, warps=warps, warp=material)
    assert woven.width / warps == pytest.approx(pitch)
    assert woven.knot_pitch == woven.row_distance == pytest.approx(2 * pitch)
    mass = usual_warp_density(pitch, material) / usual_warp_density(2 * mm, COTTON.name)
    assert woven.warp_tension == pytest.approx(15.0 * mass)
    assert woven.pull == pytest.approx(warps * 15.0 * mass)


def test_what_is_given_is_kept() -> None:
    woven = cloth(row_pitch=3 * mm, tension=7.0, warp_strength=40.0)
    assert (woven.row_distance, woven.warp_tension) == (3 * mm, 7.0)
    assert woven.carpet_yarns.warp.breaking_force == 40.0
    assert math.isclose(cloth().carpet_yarns.pile.linear_density, 0.8e-3)


def test_no_machine_declares_a_parameter_of_a_cloth_again() -> None:
    """A loom has names of its own, because it derives the cloth from a carpet; two hands tie on warps held apart."""
    names = {parameter.name for parameter in declared(Cloth)} | {"yarns", "pitch", "warp_diameter", "warp_stiffness"}
    found = {
        (name, last)
        for name, component in MACHINES.items()
        for dotted in reachable(component.params, machines=False)
        if (last := dotted.rpartition(".")[2]) in names and not dotted.removeprefix("task.").startswith("cloth.")
    }
    assert {one for one in found if one[0] not in ("automated-loom", "hand-loom")} == {
        ("knotting-four-bar", "warp_pitch")
    }
    own = {last for name, last in found if name == "automated-loom"}
    assert own == {"warp_pitch", "tension", "warp_diameter", "warp_stiffness"}


def test_no_machine_of_a_loom_can_have_another_cloth() -> None:
    """What is set for the warps of one machine is that of the loom; the error says under which name."""
    assert not [name for name in reachable(AutomatedLoomParams) if "cloth." in name]
    for wrong, message in (
        (
            "shedding.cloth.tension",
            r"shedding.cloth.tension is that of all machines of the loom; did you mean tension\?",
        ),
        ("weaver.cloth.yarns.friction", r"did you mean yarns.friction\?"),
        ("weft.cloth.warps", "set it for the loom"),
        ("cloth.tension", r"did you mean tension\?"),
    ):
        with pytest.raises(ParameterError, match=message):
            AutomatedLoomParams.read({wrong: "10"})


@pytest.mark.parametrize(
    "machine", [name for name in MACHINES if "cloth.warp_pitch" in reachable(MACHINES[name].params)]
)
def test_bad_cloths_are_refused_with_their_dotted_name(machine: str) -> None:
    read = MACHINES[machine].params.read
    for given_settings, message in (
        ({"cloth.warp_pitch": "2"}, "cloth.warp_pitch=2000 mm is out of bounds; .*did you mean 2mm"),
        ({"cloth.warps": "1"}, "cloth.warps=1 is out of bounds; allowed: at least 2"),
        ({"cloth.tension": "15kg"}, "cloth.tension"),
        ({"cloth.yarns.warp": "nylon"}, "cloth.yarns.warp"),
        ({"warp_pitch": "2mm"}, "did you mean cloth.warp_pitch"),
    ):
        with pytest.raises(ParameterError, match=message):
            read(given_settings)
