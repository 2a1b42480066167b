"""A share of `make fuzz`, the reduced cases of what it found, and the harness itself."""

from pathlib import Path

import pytest
from effort import first, number, share_of
from fuzz.case import Case, read_case
from fuzz.corpus import make_corpus
from fuzz.inputs import make_case
from fuzz.pool import Limits, outcomes
from fuzz.reduction import reduced
from kept import kept

CASES = Path(__file__).parents[1] / "fuzz_cases"
LIMITS = Limits(hang=300.0, timing=False)
"""No test of time: the machine may be busy, and kernels may have to be compiled."""

FIRST, NUMBER = 1_000_000, number(3, 2000)
"""The first input of the share, not those of `make fuzz`; and how many."""


@pytest.fixture(autouse=True)
def checked_indices(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ILMEK_BOUNDS_CHECK", number("0", "1"))  # kernels of its own, which take minutes to compile
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")


def test_what_was_found_once_stays_repaired_and_a_share_of_the_inputs_has_no_finding() -> None:
    found = [read_case(path.read_text(encoding="utf-8")) for path in sorted(CASES.glob("*.json"))]
    cases = share_of(found, 3, "found once")
    assert cases
    run = list(outcomes([*cases, *range(FIRST + first(), FIRST + first() + NUMBER)], 1, LIMITS))
    assert len(run) == len(cases) + NUMBER
    findings = [(outcome.name, finding) for outcome in run for finding in outcome.findings]
    assert not findings, "\n".join(f"{name}: {one.kind}: {one.key}\n{one.detail}" for name, one in findings)


def test_an_input_follows_from_its_number() -> None:
    corpus = kept(make_corpus)
    first, second = ([make_case(corpus, seed) for seed in range(20)] for _ in range(2))
    assert first == second
    assert len({case.command for case in first}) > 6


def test_a_case_is_read_as_written() -> None:
    case = Case(("knot", "p.csv"), {"p.csv": b"x,y\n", "raw": b"\xff\0"}, {"TERM": "dumb"}, terminal=True)
    assert read_case(case.as_json()) == case


def test_a_case_is_reduced_to_what_matters() -> None:
    lines = b"name,srgb,nm\nred,#800000,2\n=1+1,#000080,two\ngreen,#008000,2\n"
    case = Case(("inspect", "p.ilmek", "--json", "-"), {"p.ilmek": lines, "more.csv": b"more"})
    (outcome,) = outcomes([case], 1, LIMITS)
    assert (outcome.code, outcome.findings) == (2, [])
    assert reduced(case, "no such finding", LIMITS) == case
