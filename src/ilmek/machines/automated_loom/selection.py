"""The loom for a carpet, with what its parameters leave open chosen so that every check holds.

Kinds of beat are tried in ascending order of what the aim makes least: first by the checks of the drive alone, then in
the whole loom, until one keeps every limit.
"""

from dataclasses import replace

from ilmek.arrays import Indices
from ilmek.errors import LoomError
from ilmek.loom.programme import Programme, heads_for, make_programme
from ilmek.machines.automated_loom.design import LoomDesign, ready_loom, with_beat
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.automated_loom.report import analyse, checks
from ilmek.report import Alternative, choose


def design(params: AutomatedLoomParams) -> LoomDesign:
    """The loom for a carpet. Where no beat keeps every limit, the loom with the one that misses them least.

    Raises LoomError where more heads are given than fit, or the shed leaves no time for the weft; CarpetError for a
    carpet without knots; the errors of the machines where their parameters contradict each other.
    """
    ready = ready_loom(params)
    if len(ready.options) == 1:
        return with_beat(ready, ready.options[0])
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


def programme_for(
    knots: Indices, yarns: int, params: AutomatedLoomParams, deadline: float | None = None
) -> tuple[LoomDesign, Programme]:
    """The loom and the programme for a chart of indices below `yarns`, row 0 = top.

    With a deadline [s] the loom gets the smallest number of heads that meets it. Raises LoomError where none does, and
    where the chart is not the knots of the loom's carpet; and the errors of `design`.
    """
    loom = design(replace(params, heads=None) if deadline is not None else params)
    if knots.shape != (loom.rows, loom.columns):
        raise LoomError(
            f"a chart of {knots.shape[1]} x {knots.shape[0]} knots",
            allowed=f"the carpet of this loom has {loom.columns} x {loom.rows}",
            do="give the loom the size and quality of the chart",
        )
    if deadline is not None:
        loom = design(
            replace(params, heads=heads_for(knots, yarns, deadline, loom.times, loom.heads_max, bobbins=loom.bobbins))
        )
    return loom, make_programme(knots, yarns, loom.heads, loom.times, bobbins=loom.bobbins)
