"""The verdicts of `ilmek reproduce` against an independent re-computation of the papers.

The lists name every claim that does not come out as printed; all others are reproduced.
"""

from collections import Counter

import pytest

from ilmek.verification import PAPERS, reproduce
from ilmek.verification.claim import Verdict

EXPECTED = {
    "beat-up": {
        "rounding": """φ=160° β=65°: a; φ=160° β=55°: b; φ=180° β=67°: a; φ=180° β=55°: c; φ=200° β=67°: a;
            φ=210° β=75°: a; φ=210° β=75°: μ_min""",
        "misprint": """Eq 6; Eq 9; φ=160° β=55°: c; φ=180° β=35°: c; solutions in all; crank rotation angles tried;
            β of the least deviation of μ_min from 90°; moment of inertia DC;
            crank angle of the greatest speed, 'at about beating point'""",
        "not reproducible": "greatest forces in joints B and C",
    },
}


@pytest.fixture(scope="module")
def verdicts() -> dict[str, tuple[Verdict, ...]]:
    return {paper: reproduce([paper]) for paper in PAPERS}


@pytest.mark.parametrize("paper", PAPERS)
def test_what_is_not_reproduced(paper: str, verdicts: dict[str, tuple[Verdict, ...]]) -> None:
    found: dict[str, list[str]] = {}
    for verdict in verdicts[paper]:
        found.setdefault(verdict.verdict, []).append(verdict.claim.item)
    expected = {name: [" ".join(item.split()) for item in text.split(";")] for name, text in EXPECTED[paper].items()}
    assert {name: items for name, items in found.items() if name != "reproduced"} == expected


def test_all_165_numbers_of_the_beat_up_table_are_claims(verdicts: dict[str, tuple[Verdict, ...]]) -> None:
    cells = [verdict for verdict in verdicts["beat-up"] if verdict.claim.source.startswith("Table 1")]
    assert Counter(verdict.verdict for verdict in cells) == {"reproduced": 156, "rounding": 7, "misprint": 2}
