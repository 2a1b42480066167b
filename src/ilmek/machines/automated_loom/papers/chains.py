"""The tolerance chains of a loom as a paper: their links with deviations and ratios, both closures, and the room."""

from collections.abc import Iterator

from ilmek.elements.tolerance_chains import ToleranceStack
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.tolerance_chains import tolerance_stacks
from ilmek.machines.shedding.tolerance_chain import tolerance_chain
from ilmek.report import Column, Paper, PaperSection, Table
from ilmek.sentences import Sentence


def tolerance_paper(loom: LoomDesign) -> Paper:
    """A section for each chain of the loom, then the stacks of sheets on the cam shafts."""
    return Paper(
        "tolerances",
        Sentence("chain.title"),
        Sentence("chain.lead"),
        (*(_chain(number, stack) for number, stack in enumerate(tolerance_stacks(loom), 1)), _sheets(loom)),
    )


def _chain(number: int, stack: ToleranceStack) -> PaperSection:
    heads = (
        Column(Sentence("chain.link")),
        Column(Sentence("chain.kind")),
        Column(Sentence("chain.deviation"), "mm", 3),
        Column(Sentence("chain.ratio"), "", 3),
        Column(Sentence("chain.share"), "mm", 3),
    )
    kinds = {True: Sentence("chain.play"), False: Sentence("chain.size")}
    links = ((link.name, kinds[link.play], link.deviation, link.ratio, link.share) for link in stack.links)
    sums = (
        (Sentence("chain.worst"), stack.worst),
        (Sentence("chain.statistical"), stack.statistical),
        (Sentence("chain.room"), stack.room),
    )
    closures = ((title, "", value, 1.0, value) for title, value in sums)
    kept = Sentence("chain.kept" if stack.worst <= stack.room else "chain.measured")
    table = Table(f"chain-{number}", stack.title, heads, (*links, *closures))
    return PaperSection(stack.title, (Sentence("chain.how"), kept), table)


def _sheets(loom: LoomDesign) -> PaperSection:
    """Sheets of each cam shaft between two piles of shims."""
    heads = (
        Column(Sentence("chain.shaft")),
        Column(Sentence("chain.interval")),
        Column(Sentence("chain.worst"), "mm", 3),
        Column(Sentence("chain.shims"), "mm", 3),
        Column(Sentence("chain.statistical"), "mm", 3),
        Column(Sentence("chain.offset"), "mm", 3),
        Column(Sentence("chain.groove"), "mm", 3),
        Column(Sentence("chain.warp"), "mm", 3),
    )

    def rows() -> Iterator[tuple[float | str, ...]]:
        for number, shaft in enumerate(loom.shedding.shafts, 1):
            own, params = tolerance_chain(shaft.params, shaft.stack.shares), shaft.params
            offset = params.offset_limit * params.cloth.warp_pitch
            yield number, own.interval, own.worst, own.shims, own.statistical, offset, own.groove, params.diameter

    title = Sentence("chain.sheets")
    return PaperSection(title, (Sentence("chain.sheets-how"),), Table("sheets", title, heads, tuple(rows())))
