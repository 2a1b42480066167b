"""The loom for a carpet, with what its parameters leave open chosen so that every check holds.

Kinds of beat are tried in ascending order of what the aim makes least: first by the checks of the drive alone, then in
the whole loom, until one keeps every limit. With a deadline a quicker beat may save heads: then the price of the whole
loom decides.
"""

from functools import lru_cache

from ilmek.machines.automated_loom.design import LoomDesign, ReadyLoom, ready_loom, with_beat
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.automated_loom.report import analyse, checks
from ilmek.report import Alternative, choose


@lru_cache(maxsize=8)
def design(params: AutomatedLoomParams) -> LoomDesign:
    """The loom for a carpet. Where no beat keeps every limit, the loom with the one that misses them least.

    The last looms are kept: commands and reports that begin with the same parameters share the design.

    Raises LoomError where more heads are given than fit, or the shed leaves no time for the weft; CarpetError for a
    carpet without knots; the errors of the machines where their parameters contradict each other.
    """
    ready = ready_loom(params)
    if len(ready.options) == 1:
        return with_beat(ready, ready.options[0])
    if params.deadline is not None and params.heads is None and params.aim == "price":
        return _by_whole_price(ready)
    alternatives = [Alternative(one.kind, one.checks) for one in ready.options]
    looms: dict[int, LoomDesign] = {}
    for index, option in enumerate(ready.options):
        if alternatives[index].failed:
            continue
        looms[index] = with_beat(ready, option, (choose("beat", alternatives, params.aim)[1],))
        alternatives[index] = Alternative(option.kind, (*option.checks, *checks(analyse(looms[index]))))
        if not alternatives[index].failed:
            break
    index, choice = choose("beat", alternatives, params.aim)
    return looms.get(index) or with_beat(ready, ready.options[index], (choice,))


def _by_whole_price(ready: ReadyLoom) -> LoomDesign:
    """The cheapest loom of those with each kind of beat, each with the heads that its deadline needs."""
    whole = sorted(
        (
            (analyse(loom).listed.price, option.kind, option, loom)
            for option in ready.options
            for loom in [with_beat(ready, option)]
        ),
        key=lambda one: one[:2],
    )
    found = [Alternative(kind, (*option.checks, *checks(analyse(loom)))) for _, kind, option, loom in whole]
    index, choice = choose("beat", found)
    return with_beat(ready, whole[index][2], (choice,))
