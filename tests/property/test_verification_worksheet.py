"""The steps of the papers: every row follows as its verdict states, whatever is put right in it."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache

import pytest

from ilmek.verification import PAPERS, reproduce
from ilmek.verification.claim import MISPRINT, ROUNDED_INPUT, Claim, last_digit, near, read_printed
from ilmek.verification.judgement import Verdict
from ilmek.verification.slips import SLIPS
from ilmek.verification.worksheet import Worksheet


@cache
def sheet(paper: str) -> Worksheet:
    return Worksheet(PAPERS[paper]())


@cache
def verdicts(paper: str) -> tuple[Verdict, ...]:
    return reproduce([paper])


def stepped(paper: str) -> list[Claim]:
    return [claim for claim in sheet(paper).claims.values() if claim.follows]


def rows(name: str) -> list[tuple[str, Verdict]]:
    return [(paper, verdict) for paper in PAPERS for verdict in verdicts(paper) if verdict.verdict == name]


def digit(claim: Claim) -> float:
    return last_digit(read_printed(claim.printed)[1])


@pytest.mark.parametrize("paper", PAPERS)
def test_steps_without_slips_and_roundings_give_the_computed_numbers(paper: str) -> None:
    """The paper's own way, put right at every step, ends at the engine's number, which knows nothing of the steps."""
    for claim in stepped(paper):
        right = sheet(paper).put_right(claim.item, (claim.item, *sheet(paper).before(claim.item)))
        assert right == pytest.approx(claim.compute(), rel=1e-9, abs=1e-12), claim.item


@pytest.mark.parametrize("paper", PAPERS)
def test_steps_with_their_slips_give_the_printed_numbers(paper: str) -> None:
    strange = [
        claim.item
        for claim in stepped(paper)
        if not near(read_printed(claim.printed)[1], sheet(paper).by_step(claim.item))
    ]
    assert strange == (["Δ", "λ2", "m2 a of G2, x"] if paper == "knotting" else [])


def test_there_are_as_many_rows_of_rounded_input_as_were_found_by_hand() -> None:
    assert len(rows(ROUNDED_INPUT)) == 41


def test_the_rounding_of_the_named_inputs_covers_the_miss() -> None:
    """|d output/d input| times half a unit of the input's last digit, a unit where it was truncated."""
    for _, verdict in rows(ROUNDED_INPUT):
        covered = sum(origin.bound for origin in verdict.origins)
        assert abs(verdict.difference or 0.0) <= covered + digit(verdict.claim), verdict.claim.item


def third_speed(theta_s: float) -> float:
    """ω3/ω1 of the quoted pose [report 3] for a direction of the diagonal [deg]."""
    th3 = theta_s + math.degrees(math.acos((74.464**2 + 65.426**2 - 78.105**2) / (2 * 74.464 * 65.426)))
    return 82.345 / 65.426 * math.sin(math.radians(125)) / math.sin(math.radians(th3 - 10))


def least_transmission(a: float) -> float:
    """μ_min [deg] of case V: the coupler's angle to the rocker where the crank lies along the ground."""
    b, c = 0.5708, 1.122
    return math.degrees(math.acos((b**2 + c**2 - (1 - a) ** 2) / (2 * b * c)))


@pytest.mark.parametrize(
    ("paper", "item", "name", "value", "formula"),
    [
        ("knotting", "ω3/ω1", "θs", 125.0622499, third_speed),
        ("knotting", "θ3", "θs", 125.0622499, lambda angle: angle + 67.52367),
        ("knotting", "moment of inertia of link 1", "mass of link 1", 3.4977686, lambda m: m * 1e-9 * 6816.699 / 12),
        ("knotting", "G1 from O1, x", "O2 from O1, x", -58.226708, lambda x: x / 2),
        ("knotting", "mass by place of link 2, holder", "mass of link 2, holder", 0.113272, lambda m: m * 33.637),
        ("beat-up", "φ=210° β=75°: μ_min", "φ=210° β=75°: a", 0.258819045, least_transmission),
    ],
)
def test_the_named_input_is_the_cause_by_a_formula_of_ours(
    paper: str, item: str, name: str, value: float, formula: Callable[[float], float]
) -> None:
    """From the input as printed the printed number follows; more digits of the input move it as the origin states."""
    verdict = next(one for one in verdicts(paper) if one.claim.item == item)
    origin = verdict.origins[0]
    assert origin.name == name
    printed = float(origin.printed)
    assert near(read_printed(verdict.claim.printed)[1], formula(printed))
    assert formula(value) - formula(printed) == pytest.approx(origin.change, rel=0.02)
    slope = (formula(value) - formula(printed)) / (value - printed)
    assert origin.sensitivity == pytest.approx(slope, rel=0.02)
    half = 0.5 * 10.0 ** -len(origin.printed.partition(".")[2])
    assert abs(value - printed) <= 2 * half
    assert origin.bound == pytest.approx(abs(slope) * half * (2 if abs(value - printed) > half else 1), rel=0.02)


def test_every_misprint_has_a_root_and_a_root_is_a_slip_or_a_row() -> None:
    for paper, verdict in rows(MISPRINT):
        assert verdict.roots, verdict.claim.item
        assert all(root in SLIPS or root in sheet(paper).claims for root in verdict.roots)


def test_every_slip_is_the_root_of_a_row() -> None:
    assert set(SLIPS) <= {root for _, verdict in rows(MISPRINT) for root in verdict.roots}


def test_few_slips_explain_the_misprints() -> None:
    first = {(paper, verdict.roots[0]) for paper, verdict in rows(MISPRINT)}
    assert (len(rows(MISPRINT)), len(first)) == (116, 46)


@pytest.mark.parametrize("paper", PAPERS)
def test_a_slip_put_into_the_right_steps_leads_to_the_printed_number(paper: str) -> None:
    """Nothing is rounded, the slips alone are there: the number comes nearer to the printed one than the right one."""
    slipped = Worksheet(replace(claim, right=None) for claim in PAPERS[paper]())

    def has_steps(item: str) -> bool:
        claims = (slipped.claims[name] for name in (item, *slipped.before(item)))
        return all(claim.follows for claim in claims if claim.slips)

    grouped = [
        verdict
        for verdict in verdicts(paper)
        if verdict.verdict == MISPRINT and verdict.claim.follows and set(verdict.roots) <= SLIPS.keys()
    ]
    assert len(grouped) >= {"thesis": 7, "knotting": 60}.get(paper, 0)
    for verdict in filter(lambda verdict: has_steps(verdict.claim.item), grouped):
        item = verdict.claim.item
        number = slipped.put_right(item, (item, *slipped.before(item)))
        printed, right = slipped.printed(item), float(verdict.computed or 0.0)
        rounding = sum(origin.bound for origin in verdict.origins) + digit(verdict.claim)
        assert abs(number - printed) < max(0.25 * abs(right - printed), rounding), (item, number, printed, right)


@pytest.mark.parametrize("paper", PAPERS)
def test_without_the_slips_a_grouped_row_misses_by_rounding_alone(paper: str) -> None:
    """All slips are put right, the roundings stay: the row is no longer the printed one."""
    for verdict in verdicts(paper):
        if verdict.verdict == MISPRINT and verdict.claim.follows and verdict.roots[0] in SLIPS:
            item = verdict.claim.item
            slips = [name for name in (item, *sheet(paper).before(item)) if sheet(paper).slips(name)]
            mended = sheet(paper).put_right(item, slips)
            assert abs(mended - sheet(paper).printed(item)) > digit(verdict.claim), item
