"""What a head chose of what its parameters left open: its width, the tiers of its tubes, the teeth of its opener."""

from collections.abc import Iterator
from dataclasses import replace

from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.magazine import tier_width
from ilmek.machines.weaver.opener import TEETH
from ilmek.report import Check, Choice, at_most, failing
from ilmek.units import format_quantity


def choices(weaver: Weaver) -> tuple[Choice, ...]:
    """The choices of a head, each with the check that decided it and what the next smaller one fails."""
    return tuple(_choices(weaver))


def _choices(weaver: Weaver) -> Iterator[Choice]:
    params, magazine, opener = weaver.params, weaver.magazine, weaver.opener
    if params.head_width is None:
        widest = max(weaver.needs, key=lambda name: weaver.needs[name])
        yield Choice("head_width", format_quantity(weaver.width, "mm", 4), f"width of the {widest}")
    if params.tube_tiers is None:
        fewer = magazine.tiers - 1
        wide = tier_width(magazine.kind, -(-magazine.tubes // fewer), magazine.pitch) if fewer else 0.0
        check = at_most("tubes on the head", wide, weaver.width, "mm", "head_width")
        yield _choice("tube_tiers", str(magazine.tiers), str(fewer) if fewer else "", check)
    if params.opener.wall is None:
        thinner = max((wall for wall in TEETH if wall < opener.wall), default=None)
        bend = opener.bend if thinner is None else replace(opener, wall=thinner).bend
        check = at_most("opener: bend of its teeth", bend, params.opener.bend_limit, "mm", "opener.bend_limit")
        before = "" if thinner is None else format_quantity(thinner, "mm")
        yield _choice("opener.wall", format_quantity(opener.wall, "mm"), before, check)


def _choice(name: str, chosen: str, before: str, check: Check) -> Choice:
    return Choice(name, chosen, check.name, before, failing(check) if before and not check.ok else "")
