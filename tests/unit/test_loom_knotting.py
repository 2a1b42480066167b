"""What ties the knots of a loom: cams or arms, one face for both; the choice, the proofs, the cyclogram, the parts."""

from functools import cache

import numpy as np
import pytest
from default_machines import loom_report

from ilmek.errors import LoomError
from ilmek.machines import weaver
from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, LoomDesign, cyclograms, design
from ilmek.machines.automated_loom.knotting import ARMS, CAMS
from ilmek.machines.knotting_dyad.section import NEIGHBOURS
from ilmek.machines.weaver import mass_of
from ilmek.machines.weaver.knot import PAIR
from ilmek.machines.weaver.motions import CENTRE_ARM, HANDLER, LEFT_ARM, OPENER, RIGHT_ARM, SIDE_MOTION, SLEY
from ilmek.timing.cyclogram import check_all, check_apart
from ilmek.timing.track import sample
from ilmek.units import mm, turn
from ilmek.weaving.knots.word import knot


@cache
def loom(kind: str = "symmetric", knotting: str = "auto", pitch: float = 2 * mm, **others: str) -> LoomDesign:
    settings = dict(
        knot=kind, knotting=knotting, warp_pitch=f"{pitch} m", width="0.6m", length="0.9m", beat="comb", **others
    )
    return design(AutomatedLoomParams.read({"aim": "price", **settings}))


@pytest.mark.parametrize(
    ("kind", "knotting", "tied_by"),
    [
        ("symmetric", "auto", CAMS),
        ("asymmetric", "auto", ARMS),
        ("symmetric", "arms", ARMS),
        ("asymmetric", "arms", ARMS),
        ("symmetric", "cams", CAMS),
    ],
)
def test_exactly_one_ties_the_knots_and_its_proof_has_the_word_of_the_knot(
    kind: str, knotting: str, tied_by: str
) -> None:
    """The crossing word of the yarn among the warps is that of the required knot, on the pair."""
    made = loom(kind, knotting)
    assert made.head.kind == made.params.knotting == tied_by
    assert ("knotting-dyad" in made.machines) == (tied_by == ARMS)
    if tied_by == ARMS:
        tied = made.machines["knotting-dyad"].design.head.tied
        assert tied.word == knot(kind, NEIGHBOURS + 1, opens="left").word
    else:
        tied = made.weaver.tied
        assert tied.knot.warps == PAIR
        assert tied.word == knot(kind, PAIR[0]).word
    assert tied.knot.kind == kind
    assert all(check.ok for check in made.head.checks)


def test_the_choice_names_what_the_cams_failed() -> None:
    (choice,) = [one for one in loom("asymmetric").choices if one.name == "knotting"]
    assert (choice.chosen, choice.next_cheaper, choice.decided_by) == (ARMS, CAMS, "asymmetric knot tied")
    (choice,) = [one for one in loom("symmetric").choices if one.name == "knotting"]
    assert (choice.chosen, choice.decided_by) == (CAMS, "price")


def test_cams_for_the_asymmetric_knot_are_refused_by_name_at_the_head_of_the_reasons() -> None:
    report = loom_report(loom("asymmetric", "cams"))
    assert report.reasons[0].name == "weaver: asymmetric knot tied"
    assert "knotting=arms" in report.reasons[0].cure


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("kind", ["symmetric", "asymmetric"])
@pytest.mark.parametrize("pitch", [0.25, 0.5, 0.7, 1, 2, 4])
@pytest.mark.parametrize("knotting", ["cams", "arms"])
def test_every_pitch_and_knot_has_a_head_with_all_its_checks(pitch: float, kind: str, knotting: str) -> None:
    """Never an exception, never a check less than at the usual pitch; 12.5 to 100 knots/dm keep them all."""

    def names(one: LoomDesign) -> list[str]:
        return sorted(check.name.split(",")[0].replace("asymmetric", "symmetric") for check in one.head.checks)

    made = loom(kind, knotting, pitch * mm)
    assert names(made) == names(loom("symmetric", knotting))
    failed = [check.name for check in made.head.checks if not check.ok]
    expected = ["asymmetric knot tied"] if (kind, knotting) == ("asymmetric", "cams") else []
    if pitch >= 0.5:
        assert failed == expected
    else:
        assert "opener: points between two warps" in failed
        finest = ("opener: ", "sag of the head at its tools", "room of the side grippers")  # a tenth of the pitch
        assert [name for name in failed if not name.startswith(finest)] == expected
    assert all(check.cure for check in made.head.checks if not check.ok)


def test_the_heads_cyclogram_shows_the_phases_of_the_arms_between_opener_and_sley() -> None:
    made = loom("asymmetric")
    knotting, _ = cyclograms(made)
    names = [track.name for track in knotting.tracks]
    assert names == [OPENER, LEFT_ARM, RIGHT_ARM, CENTRE_ARM, HANDLER, SLEY, "carriage"]
    assert SIDE_MOTION not in names
    opened = knotting.track(OPENER).segment("open warps").end
    down = knotting.track(SLEY).segment("down").start
    arms = [part for name in (LEFT_ARM, RIGHT_ARM, CENTRE_ARM) for part in knotting.track(name).segments]
    assert min(part.start for part in arms) == pytest.approx(opened)
    assert max(part.end for part in arms) <= down
    assert all(check.ok for check in check_all(knotting, knotting.relations))
    assert all(check_apart(knotting, one).ok for one in knotting.exclusions)
    grasps = [event for event in knotting.track(RIGHT_ARM).events if event.name.startswith("grasp")]
    assert grasps[0].angle <= knotting.track(HANDLER).segment("home").start + 1e-9


def test_the_phases_last_as_long_as_the_arms_need() -> None:
    made = loom("asymmetric")
    arms = made.machines["knotting-dyad"]
    period = float(str(arms.component.report(arms.design)["cycle_time"]))
    knotting, _ = cyclograms(made)
    parts = [part for name in (LEFT_ARM, RIGHT_ARM, CENTRE_ARM) for part in knotting.track(name).segments]
    spent = (max(part.end for part in parts) - min(part.start for part in parts)) / turn * knotting.period
    assert period - 0.06 <= spent <= period
    angle = np.linspace(0.0, turn, 3601)
    both = sum(
        sample(knotting.track(name), angle).position / knotting.track(name).stroke for name in (LEFT_ARM, RIGHT_ARM)
    )
    assert both.max() <= 1 + 1e-6


def test_slow_arms_lengthen_the_knot() -> None:
    slow = loom("asymmetric", **{"knotting-dyad.grasp_time": "300ms"})
    assert slow.weaver.cycle > 2.0
    assert slow.times.knot == pytest.approx(slow.weaver.cycle)


def test_the_arms_are_parts_of_every_head_and_weighed_once() -> None:
    made = loom("asymmetric", heads="2")
    assert made.machines["knotting-dyad"].number == made.machines["weaver"].number == 2
    parts = {part.name: part for part in MACHINE.parts(made)}
    assert parts["link 1 of an arm"].number == 4
    masses = mass_of(made.weaver)
    own = {line.name: line for line in weaver.MACHINE.parts(made.weaver)}
    assert {name: parts[name].number for name in own} == {name: 2 * line.number for name, line in own.items()}
    assert sum(masses.values()) - masses["arms"] == pytest.approx(sum(line.mass_all for line in own.values()))
    assert masses["arms"] > 0


def test_the_loom_hands_its_yarns_to_both() -> None:
    for knotting in (CAMS, ARMS):
        made = loom("symmetric", knotting, **{"yarns.pile_density": "0.5g/m", "yarns.warp_diameter": "0.9mm"})
        yarns = made.task.yarns
        assert made.weaver.params.yarn == yarns.pile.diameter
        assert made.weaver.params.pressed == yarns.pressed
        assert made.weaver.params.warp == pytest.approx(0.9 * mm)
        if knotting == ARMS:
            section = made.machines["knotting-dyad"].design.head.section
            assert (section.yarn, section.warp) == (yarns.pressed, pytest.approx(0.9 * mm))
            assert made.weaver.opener.pair == section.pair


def test_200_colours_choose_tiers_and_a_given_width_that_is_too_small_fails() -> None:
    assert all(check.ok for check in loom(colours="200").head.checks)
    failed = [check.name for check in loom(colours="200", head_width="30mm").head.checks if not check.ok]
    assert "cams beside each other" in failed
    assert "tubes on the head" not in failed or loom(colours="200", head_width="30mm").weaver.magazine.tiers > 13


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"weaver.knot": "symmetric", "knot": "asymmetric"}, "weaver.knot=symmetric in a loom for asymmetric knots"),
        ({"knotting-dyad.knot": "symmetric", "knot": "asymmetric"}, "knotting-dyad.knot=symmetric in a loom"),
        ({"weaver.arms.time": "0.5s", "knotting": "cams"}, "set knotting=arms"),
        (
            {
                "knotting": "arms",
                "knotting-dyad.points": "(12mm,4mm) (18.5mm,9.5mm) (24mm,8mm) (27mm,3mm)",
                "knotting-dyad.angles": "20deg 65deg 100deg 150deg",
            },
            "leave knotting-dyad.points and angles out",
        ),
    ],
)
def test_settings_of_the_machines_that_contradict_the_loom_are_refused(settings: dict[str, str], words: str) -> None:
    with pytest.raises(LoomError, match=words):
        design(AutomatedLoomParams.read({"aim": "price", **settings}))


def test_warps_thicker_than_their_pitch_are_a_failed_check_of_a_head_of_usual_size() -> None:
    for knotting in (CAMS, ARMS):
        made = loom("symmetric", knotting, 0.5 * mm, **{"yarns.warp": "wool"})
        failed = {check.name for check in made.head.checks if not check.ok}
        assert "opener: points between two warps" in failed
        assert made.head.width <= 0.31
