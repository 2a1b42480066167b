"""Every part: its blank is sold in that size and has it in it, by its mesh; its steps hold its tolerances; its mass."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from default_machines import default_design

from ilmek.elements.columns import SECTIONS
from ilmek.elements.fits import tolerance_grade
from ilmek.elements.making import DRAWN, FINEST, GRINDING, MILLING, TURNING
from ilmek.elements.stock_sizes import PLATES, ROUNDS, SQUARES
from ilmek.elements.tubes import TUBES
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.catalogue import MACHINES
from ilmek.part.bill import line_of
from ilmek.part.blanks import BAR, HOLLOW, PLATE, ROUND, SQUARE, TUBE, Blank, blanks_of, size_of
from ilmek.part.folding import folded_sheet
from ilmek.part.making import steps_of
from ilmek.part.part import Part
from ilmek.part.tolerances import FeatureKind, ToleratedFeature
from ilmek.part.tolerancing import tolerances_of
from ilmek.part.tree import Tree
from ilmek.units import mm

LOOMS: dict[str, dict[str, str]] = {
    "default": {},
    "linkage": {"beat": "linkage"},
    "arms": {"knotting": "arms"},
    "shuttle": {"weft": "shuttle"},
}
ALONE = [name for name, machine in MACHINES.items() if machine.tree is not None]
NEAR = 1e-6
CAPILLARIES = [(outer * mm, wall * mm) for outer, wall in ((1, 0.25), (1.6, 0.4), (2, 0.5), (3, 0.75), (4, 1))]


@cache
def whole(name: str) -> Tree:
    """The tree of a loom, or of a machine alone."""
    if name in LOOMS:
        loom = MACHINES["automated-loom"]
        return loom_tree(loom.designed(loom.params.read(LOOMS[name])))
    tree_of = MACHINES[name].tree
    assert tree_of is not None
    made_tree: Tree = tree_of(default_design(name))
    return made_tree


@cache
def parts(name: str) -> tuple[Part, ...]:
    """Its parts."""
    return tuple(part for part, _ in whole(name).occurrences())


def made(name: str) -> tuple[Part, ...]:
    """Those that are made."""
    return tuple(part for part in parts(name) if part.material is not None)


@pytest.mark.parametrize("name", [*LOOMS, *ALONE])
def test_every_part_is_weighed(name: str) -> None:
    assert [part.id for part in parts(name) if not part.mass > 0] == []


def test_a_part_without_a_row_weighs_as_its_class() -> None:
    axis = next(part for part in parts("weft") if part.process == "linear axis")
    assert axis.purchase is not None
    assert np.isnan(axis.purchase.mass)
    assert axis.mass == pytest.approx(1.5 + 5.0 * axis.purchase.length)
    assert axis.moments is not None
    assert axis.moments.zeroth == pytest.approx(axis.mass)


def among(size: float, series: tuple[float, ...]) -> bool:
    return any(abs(size - one) < NEAR for one in series)


def sold(blank: Blank, part: Part) -> bool:
    """Whether the section is one of the tables; beyond the largest bar it is forged, a carbon tube pultruded."""
    section = blank.section
    if blank.form == ROUND:
        return among(section[0], ROUNDS) or section[0] > ROUNDS[-1]
    if blank.form == SQUARE:
        return among(section[0], SQUARES)
    if blank.form in {PLATE, BAR}:
        return among(section[0], PLATES)
    if blank.form == TUBE:
        stock = [*((tube.outer, tube.wall) for tube in TUBES.values()), *CAPILLARIES]
        return section[0] > ROUNDS[-1] or any(np.allclose(section, one, atol=NEAR) for one in stock)
    assert blank.form == HOLLOW
    listed = (*SECTIONS, (100 * mm, 6 * mm))
    return part.process == "carbon tube" or any(np.allclose(section[1:], one, atol=NEAR) for one in listed)


def sides_of(blank: Blank) -> list[float]:
    """Sides of the box about a blank, the least first [m]."""
    if blank.form == PLATE:
        return sorted((blank.section[0], *blank.sides))
    across = blank.section[:2] if blank.form in {BAR, HOLLOW} else blank.section[:1] * 2
    return sorted((*across, *blank.sides))


@pytest.mark.parametrize("name", [*LOOMS, *ALONE])
def test_every_blank_is_sold_and_has_its_part_in_it(name: str) -> None:
    faults = []
    for part in made(name):
        blanks = blanks_of(part)
        assert part.shape is not None
        if not all(sold(blank, part) for blank in blanks):
            faults.append(f"{part.id}: {size_of(part)} is not sold")
        bent = folded_sheet(part.shape) is not None  # its flat pattern is stretched where it is bent [DIN 6935]
        least = part.shape.volume * (0.97 if bent else 1 - NEAR)
        if blanks and sum(blank.volume for blank in blanks) < least:
            faults.append(f"{part.id}: {size_of(part)} has less volume than the part")
        sides = np.sort(np.ptp(part.shape.mesh().points, axis=0))
        if len(blanks) == 1 and not bent and np.any(np.array(sides_of(blanks[0])) < sides - NEAR):
            faults.append(f"{part.id}: {size_of(part)} for {np.round(sides / mm, 3)}")
        assert line_of(part).description == size_of(part)
    assert not faults
    assert made(name)


def test_a_blank_that_is_too_small_is_seen() -> None:
    """A round of 25 under a flange of 80 mm, as the hand loom's crank shaft was listed."""
    (flanged,) = (part for part in made("hand-loom") if part.id == "warp-tension/crank-shaft")
    (blank,) = blanks_of(flanged)
    assert blank.section[0] >= 80 * mm
    thin = Blank(ROUND, (25 * mm,), blank.sides, 0.0)
    assert sides_of(thin)[0] < np.ptp(flanged.shape.mesh().points, axis=0)[0]
    assert not sold(Blank(ROUND, (13.54 * mm,), (1.0,), 0.0), flanged)


def too_fine(part: Part, feature: ToleratedFeature) -> str:
    """Why no step in the making of a part holds a tolerance; empty: one does."""
    steps = {step.kind for step in steps_of(part)}
    if feature.kind is FeatureKind.FACE:
        return "" if steps & {MILLING, GRINDING} else "no face is machined"
    if feature.kind in {FeatureKind.THREAD, FeatureKind.OUTER_THREAD}:
        return "" if steps & {MILLING, TURNING} else "no thread is cut"
    if feature.depth:
        return "" if MILLING in steps else "no keyway is milled"
    as_sold = [DRAWN] if part.process == "steel bar" else []
    grade = min([FINEST[kind] for kind in steps & set(FINEST)] + as_sold, default=18)
    width, least = feature.upper - feature.lower, tolerance_grade(grade, feature.nominal)
    return "" if width >= least - 1e-9 else f"IT{grade} is {least / mm:.3f} mm, {width / mm:.3f} mm is asked"


@pytest.mark.parametrize("name", [*LOOMS, *ALONE])
def test_every_tolerance_is_one_that_a_step_of_the_making_holds(name: str) -> None:
    own = {part.id: part for part in parts(name)}
    faults = {
        f"{part} {feature.label}: {why}"
        for part, features in tolerances_of(whole(name)).items()
        for feature in features
        if (why := too_fine(own[part], feature))
    }
    assert sorted(faults) == []


def test_a_fit_of_a_laser_cut_bore_is_too_fine() -> None:
    (lug,) = (part for part in parts("tension-compensator") if part.id == "tension-compensator/pivot-lug")
    (bore,) = tolerances_of(whole("tension-compensator"))[lug.id]
    assert too_fine(lug, bore) == ""
    assert too_fine(replace(lug, machined=False), bore).startswith("IT12")
