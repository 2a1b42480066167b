"""The verification manual: the numbers, equations and statements of four papers, with a verdict on each.

A paper is one entry of `PAPERS`: the function that lists its claims. Nothing is computed before `reproduce` is called.
"""

from collections.abc import Callable, Iterable, Iterator

from ilmek.verification import (
    beat_up,
    knotting_forces,
    knotting_masses,
    knotting_pose,
    knotting_steps,
    knotting_synthesis,
    thesis_approximation,
    thesis_cams,
    thesis_dyad,
    thesis_loom,
    tufting,
)
from ilmek.verification.claim import VERDICTS, Claim
from ilmek.verification.judgement import Verdict, judge
from ilmek.verification.worksheet import Worksheet

__all__ = ["PAPERS", "TITLES", "VERDICTS", "Claim", "Verdict", "reproduce"]

PAPERS: dict[str, Callable[[], tuple[Claim, ...]]] = {
    "beat-up": beat_up.claims,
    "thesis": lambda: (
        *thesis_approximation.claims(),
        *thesis_dyad.claims(),
        *thesis_cams.claims(),
        *thesis_loom.claims(),
    ),
    "tufting": tufting.claims,
    "knotting": lambda: (
        *knotting_synthesis.claims(),
        *knotting_pose.claims(),
        *knotting_masses.claims(),
        *knotting_forces.claims(),
        *knotting_steps.claims(),
    ),
}
"""The claims of each paper, by its short name."""

TITLES = {
    "beat-up": "Topalbekiroglu and Celik, Kinematic analysis of beat-up mechanism used for handmade carpet looms",
    "thesis": "Design of parallel micromechanisms for knotting operation (thesis, Izmir 2009)",
    "tufting": "Xu et al., Dynamic characteristic analysis of the needle multi-linkage mechanism in a tufting machine",
    "knotting": "Planar knotting mechanisms for Turkish hand woven carpet (student report, theory of machines)",
}
"""Titles of the papers."""


def reproduce(papers: Iterable[str] = tuple(PAPERS)) -> tuple[Verdict, ...]:
    """The verdicts on all claims of the papers, in the order of the papers and of their pages."""
    return tuple(verdict for paper in papers for verdict in _judged(PAPERS[paper]()))


def _judged(claims: tuple[Claim, ...]) -> Iterator[Verdict]:
    sheet = Worksheet(claims)
    return (judge(claim, sheet) for claim in claims if not claim.repeated)
