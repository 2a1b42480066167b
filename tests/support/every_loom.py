"""Every loom of a table of choices designed one by one: the loom that is chosen is the least of them.

    python -m every_loom --seed 7                  the usual carpet (seed 0), else a random one; minutes

No bound has a part in it. For every aim the value of the chosen loom is the least of all that keep every check; the
price, to a cent: quicker knots that change it by less are not offered for it. Beside it stands how near a bound of the
search comes to the value of its loom, and by how much, if any, it is above it.
"""

import argparse
import itertools
import math
import random
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace

from ilmek.errors import IlmekError
from ilmek.machines import WEFT_CARRIERS
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.automated_loom.design import ready_loom, with_beat
from ilmek.machines.automated_loom.knotting import KNOTTING
from ilmek.machines.automated_loom.offers import CYCLES, value_of
from ilmek.machines.automated_loom.params import AIMS, AUTO, COST, PRICE, TIME
from ilmek.machines.automated_loom.report import all_checks, analyse

CENT = 0.01
SAME = 1e-12
KEPT = 1e-9


@dataclass(frozen=True)
class Tried:
    """A loom of the table: knotting, time of a knot, weft, beat and heads; what it has by aim; whether it weaves."""

    key: tuple[str, float, str, str, int]
    values: dict[str, float]
    weaves: bool


def carpet(seed: int) -> AutomatedLoomParams:
    """The usual carpet, or a random one with other rates."""
    usual = AutomatedLoomParams()
    if not seed:
        return usual
    chance = random.Random(seed)
    width, knots = round(chance.uniform(0.5, 1.6), 2), round(chance.uniform(200, 420))
    rates = replace(
        usual.cost, wage=usual.cost.wage * chance.uniform(0.3, 3), rent=usual.cost.rent * chance.uniform(0, 5)
    )
    length = round(width * chance.uniform(1, 1.6), 2)
    return replace(usual, width=width, length=length, knots_across=float(knots), knots_along=float(knots), cost=rates)


def every_loom(params: AutomatedLoomParams) -> Iterator[Tried]:
    """All looms with heads, quick and slow: those whose knots are tied in their time."""
    for knotting, weft in itertools.product(KNOTTING, WEFT_CARRIERS):
        for cycle in CYCLES:
            try:
                ready = ready_loom(replace(params, knotting=knotting, weft=weft, knot_cycle=cycle))
            except IlmekError:
                continue
            assert ready.head.weaver is not None
            if ready.head.weaver.cycle > cycle * (1 + KEPT):
                break
            most = ready.head.most(ready.task.columns, ready.task.cloth.knot_pitch)
            for heads, option in itertools.product(range(1, most + 1), ready.options):
                try:
                    loom = with_beat(replace(ready, params=replace(ready.params, heads=heads)), option)
                    found = analyse(loom)
                except IlmekError:
                    continue
                values = {aim: value_of(found, aim) for aim in AIMS}
                weaves = all(check.ok for check in all_checks(loom))
                yield Tried((knotting, cycle, weft, option.kind, heads), values, weaves)


def shown(line: str) -> None:
    """A line, at once: the campaign takes minutes."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def findings(params: AutomatedLoomParams, table: list[Tried], aim: str) -> Iterator[str]:
    """What contradicts the choice by an aim; a line of figures first."""
    search = design(replace(params, aim=aim)).search
    assert search is not None
    good = {tried.key: tried.values[aim] for tried in table if tried.weaves}
    best = min(good, key=good.__getitem__)
    of_all: dict[tuple[object, ...], float] = {tried.key: tried.values[aim] for tried in table}
    for tried in table:  # the least of all carriers, where an offer leaves it open
        knotting, cycle, _, *rest = tried.key
        key = (knotting, cycle, AUTO, *rest)
        of_all[key] = min(of_all.get(key, math.inf), tried.values[aim])
    over = [offer.value / of_all[offer.key] - 1 for offer in search.offers if offer.key in of_all]
    shown(
        f"{aim}: {len(table)} looms, {len(good)} weave; least {good[best]:.6f} by {best}; chosen {search.value:.6f} by "
        f"{search.chosen.key}, {len(search.costs)} of {len(search.offers)} designed; bounds of {len(over)} offers over "
        f"their looms {min(over):+.2%} to {max(over):+.4%}"
    )
    allowed = CENT if aim == PRICE else SAME * good[best]
    if not math.isclose(search.value, good[best], rel_tol=0.0, abs_tol=allowed):
        yield f"{aim}: {search.value} was chosen, and {best} has {good[best]}"
    if max(over) > SAME:
        yield f"{aim}: a bound is {max(over):.2e} above what its loom has"


def main() -> int:
    """0: the least was chosen for every aim; 1: findings."""
    parser = argparse.ArgumentParser(prog="every_loom")
    parser.add_argument("--seed", type=int, default=0)
    params = carpet(parser.parse_args().seed)
    size = f"{params.width:g} x {params.length:g} m, {params.quality.across:g} x {params.quality.along:g} knots/m"
    shown(f"carpet of {size}")
    wrong: list[str] = []
    for aims in ((COST, PRICE), (TIME,)):  # for the least time shuttles have larger bobbins
        table = list(every_loom(replace(params, aim=aims[0])))
        wrong += [finding for aim in aims for finding in findings(params, table, aim)]
    shown("\n".join(wrong) or "the least of all looms was chosen for every aim")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
